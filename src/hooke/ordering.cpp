#include "hooke/ordering.h"

#include <algorithm>
#include <deque>
#include <numeric>

namespace hooke {
namespace {

template <class Neighbours, class Gone>
std::vector<int> order_by_clusters(int vertex_count, const Neighbours& neighbours, const Gone& gone) {
  constexpr size_t cluster_size = 256;  // vertices whose data stay in the first cache
  const auto n = static_cast<size_t>(vertex_count);
  std::vector<int> order;
  order.reserve(n);
  std::vector<bool> taken(n, false), waiting(n, false);
  std::deque<int> seeds;  // vertices next to finished clusters, oldest first

  const auto grow = [&](int seed) {
    const size_t begin = order.size();
    taken[static_cast<size_t>(seed)] = true;
    order.push_back(seed);
    for (size_t i = begin; i < order.size(); ++i)
      for (int w : neighbours(order[i])) {
        const auto u = static_cast<size_t>(w);
        if (taken[u]) continue;
        if (order.size() - begin < cluster_size) {
          taken[u] = true;
          order.push_back(w);
        } else if (!waiting[u]) {
          waiting[u] = true;
          seeds.push_back(w);
        }
      }
  };
  for (size_t start = 0; start < n; ++start) {
    if (taken[start] || gone(static_cast<int>(start))) continue;
    seeds.push_back(static_cast<int>(start));
    while (!seeds.empty()) {
      const int seed = seeds.front();
      seeds.pop_front();
      if (!taken[static_cast<size_t>(seed)]) grow(seed);
    }
  }
  return order;
}

}  // namespace

std::vector<int> locality_order(int vertex_count, const std::vector<Triangle>& faces) {
  const IntLists vertex_faces = invert(vertex_count, faces);
  std::vector<int> corners;  // of the faces about a vertex
  const auto neighbours = [&](int v) -> const std::vector<int>& {
    corners.clear();
    for (int f : vertex_faces[v])
      for (int w : faces[static_cast<size_t>(f)])
        if (w != v) corners.push_back(w);
    return corners;
  };
  return order_by_clusters(vertex_count, neighbours, [](int) { return false; });
}

std::vector<int> locality_order(int vertex_count, const std::function<ShortList(int)>& neighbours,
                                const std::function<bool(int)>& gone) {
  return order_by_clusters(vertex_count, neighbours, gone);
}

std::vector<int> Reordered::new_vertices(const std::vector<int>& old) const {
  if (old.empty()) return {};
  std::vector<int> fresh(old_vertex.size());
  for (size_t i = 0; i < old_vertex.size(); ++i)
    fresh[static_cast<size_t>(old_vertex[i])] = static_cast<int>(i);
  std::vector<int> result;
  for (int v : old) result.push_back(fresh[static_cast<size_t>(v)]);
  return result;
}

Reordered reorder(std::vector<Triangle> faces, const std::vector<int>& order) {
  std::vector<int> fresh(order.size());
  for (size_t i = 0; i < order.size(); ++i) fresh[static_cast<size_t>(order[i])] = static_cast<int>(i);
  std::vector<int> next(order.size() + 1, 0);  // where the faces of each smallest vertex go
  for (Triangle& t : faces) {
    for (int& v : t) v = fresh[static_cast<size_t>(v)];
    ++next[static_cast<size_t>(std::ranges::min(t)) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  Reordered r;
  r.old_vertex = order;
  r.old_face.resize(faces.size());
  r.faces.resize(faces.size());
  for (size_t f = 0; f < faces.size(); ++f) {
    const auto place = static_cast<size_t>(next[static_cast<size_t>(std::ranges::min(faces[f]))]++);
    r.old_face[place] = static_cast<int>(f);
    r.faces[place] = faces[f];
  }
  return r;
}

}  // namespace hooke
