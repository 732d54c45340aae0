#include "hooke/constraints/coincident_boundary.h"

#include <algorithm>
#include <tuple>

namespace hooke {

std::vector<int> coincident_boundary_vertices(const Mat3X& points, const Connectivity& c) {
  std::vector<int> boundary;
  for (size_t e = 0; e < c.edges.size(); ++e)
    if (c.is_boundary_edge(static_cast<int>(e))) boundary.push_back(c.edges[e][0]);
  const auto place = [&](int v) { return std::tuple(points(0, v), points(1, v), points(2, v)); };
  std::ranges::sort(boundary, [&](int a, int b) { return place(a) < place(b); });
  std::vector<int> coincident;
  for (size_t begin = 0, end = 0; begin < boundary.size(); begin = end) {
    while (end < boundary.size() && place(boundary[end]) == place(boundary[begin])) ++end;
    if (end - begin > 1)
      coincident.insert(coincident.end(), boundary.begin() + static_cast<std::ptrdiff_t>(begin),
                        boundary.begin() + static_cast<std::ptrdiff_t>(end));
  }
  std::ranges::sort(coincident);
  return coincident;
}

}  // namespace hooke
