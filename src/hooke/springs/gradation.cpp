#include "hooke/springs/gradation.h"

#include <cmath>
#include <queue>

namespace hooke {

void limit_gradation(const Mat3X& points, const Connectivity& c, double slope, std::vector<double>& length) {
  if (std::isinf(slope)) return;
  const auto at = [&](int v) -> double& { return length[static_cast<size_t>(v)]; };
  const auto limit = [&](int from, int to) {
    return at(from) + slope * (points.col(to) - points.col(from)).norm();
  };
  // The smallest first, as in Dijkstra's shortest paths: a vertex that comes up has its final length.
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (const auto& [a, b] : c.edges) {
    if (at(b) > limit(a, b)) queue.emplace(at(a), a);
    if (at(a) > limit(b, a)) queue.emplace(at(b), b);
  }
  while (!queue.empty()) {
    const auto [l, v] = queue.top();
    queue.pop();
    if (l > at(v)) continue;
    for (int w : c.vertex_neighbours[v])
      if (const double most = limit(v, w); at(w) > most) {
        at(w) = most;
        queue.emplace(most, w);
      }
  }
}

}  // namespace hooke
