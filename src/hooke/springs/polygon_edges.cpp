#include "hooke/springs/polygon_edges.h"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

#include "hooke/core/error.h"

namespace hooke {

std::vector<double> rest_ratios(const IntLists& polygons, const MemoryOrder& memory_order) {
  const Adjacency& c = *memory_order.adjacency;
  std::vector<int> polygon;  // of each triangle
  int squares = 0;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p) {
    polygon.insert(polygon.end(), polygons[p].size() - 2, p);
    squares += polygons[p].size() == 4;
  }
  if (polygon.size() != c.faces.size()) throw Error("polygons that are not the faces of the mesh");
  const double triangle = std::numbers::sqrt3 / 4, all = triangle * static_cast<double>(polygon.size());
  const double q = std::sqrt(all / (all + squares * (1 - 2 * triangle)));
  std::vector<double> ratios(c.edges.size(), q);
  for (std::size_t e = 0; e < ratios.size(); ++e) {
    const auto [left, right] = c.edge_faces[e];
    if (right < 0) continue;
    const int p = polygon[memory_order.order.old_face[left]];
    if (p == polygon[memory_order.order.old_face[right]] && polygons[p].size() == 4)
      ratios[e] = q * std::numbers::sqrt2;
  }
  return ratios;
}

}  // namespace hooke
