#include "hooke/mesh/memory_order.h"

#include <algorithm>
#include <deque>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr size_t order_block = 8192;

std::vector<int> order_by_clusters(int vertex_count, const IntLists& neighbours) {
  constexpr size_t cluster_size = 256;  // vertices whose data fit in the first-level cache
  const size_t n = vertex_count;
  std::vector<int> order;
  order.reserve(n);
  std::vector<bool> taken(n, false), waiting(n, false);
  std::deque<int> seeds;  // vertices next to finished clusters, oldest first

  const auto grow = [&](int seed) {
    const size_t begin = order.size();
    taken[seed] = true;
    order.push_back(seed);
    for (size_t i = begin; i < order.size(); ++i)
      for (int w : neighbours[order[i]]) {
        const size_t u = w;
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
    if (taken[start]) continue;
    seeds.push_back(static_cast<int>(start));
    while (!seeds.empty()) {
      const int seed = seeds.front();
      seeds.pop_front();
      if (!taken[seed]) grow(seed);
    }
  }
  return order;
}

/// The next corner of each face around a vertex. These are all its neighbours where faces are consistently
/// oriented, except for one at a boundary, which has the vertex among its own; elsewhere there may be fewer,
/// which only affects the order. Computed in parallel beforehand, not during the sequential search.
IntLists next_corners(int vertex_count, const std::vector<Triangle>& faces) {
  IntLists corners = inverse(vertex_count, faces);
  parallel_for(vertex_count, order_block, [&](size_t begin, size_t end) {
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v)
      for (int i = corners.first[v]; i < corners.first[v + 1]; ++i) {
        int& item = corners.items[i];
        const Triangle& t = faces[item];
        item = t[0] == v ? t[1] : t[1] == v ? t[2] : t[0];
      }
  });
  return corners;
}

/// Calls each(new id, old id).
template <class Each>
void for_each_vertex(const Permutation& order, const Each& each) {
  parallel_for(order.old_vertex.size(), order_block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) each(v, order.old_vertex[v]);
  });
}

/// The entry of a vertex in a matrix or a list.
template <class Values>
decltype(auto) item(Values& values, size_t vertex) {
  if constexpr (requires { values.cols(); })
    return values.col(static_cast<Eigen::Index>(vertex));
  else
    return (values[vertex]);
}

template <class Old, class New>
New gathered(const Permutation& order, const Old& old, New fresh) {
  for_each_vertex(order, [&](size_t v, size_t before) { item(fresh, v) = item(old, before); });
  return fresh;
}

template <class Values>
Values scattered(const Permutation& order, const Values& fresh, Values old) {
  for_each_vertex(order, [&](size_t v, size_t before) { item(old, before) = item(fresh, v); });
  return old;
}

}  // namespace

std::vector<int> bfs_cluster_order(int vertex_count, const std::vector<Triangle>& faces) {
  return order_by_clusters(vertex_count, next_corners(vertex_count, faces));
}

std::vector<int> Permutation::new_vertices(const std::vector<int>& old) const {
  if (old.empty()) return {};
  std::vector<int> fresh(old_vertex.size());
  for (size_t i = 0; i < old_vertex.size(); ++i) fresh[old_vertex[i]] = static_cast<int>(i);
  std::vector<int> result;
  for (int v : old) result.push_back(fresh[v]);
  return result;
}

std::vector<Edge> Permutation::new_edges(const std::vector<Edge>& old) const {
  std::vector<int> ends;
  ends.reserve(2 * old.size());
  for (const Edge& e : old) ends.insert(ends.end(), e.begin(), e.end());
  ends = new_vertices(ends);
  std::vector<Edge> fresh(old.size());
  for (size_t e = 0; e < fresh.size(); ++e) fresh[e] = {ends[2 * e], ends[2 * e + 1]};
  return fresh;
}

Mat3X Permutation::gather(const Eigen::Ref<const Mat3X>& old) const {
  return gathered(*this, old, Mat3X(3, old.cols()));
}

std::vector<double> Permutation::gather(const std::vector<double>& old) const {
  return gathered(*this, old, std::vector<double>(old.size()));
}

Mat3X Permutation::scatter(const Mat3X& fresh) const {
  return scattered(*this, fresh, Mat3X(3, fresh.cols()));
}

std::vector<double> Permutation::scatter(const std::vector<double>& fresh) const {
  return scattered(*this, fresh, std::vector<double>(fresh.size()));
}

std::vector<Triangle> Permutation::scatter(const std::vector<Triangle>& fresh) const {
  std::vector<Triangle> old(fresh.size());
  parallel_for(fresh.size(), order_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f)
      for (size_t k = 0; k < 3; ++k) old[old_face[f]][k] = old_vertex[fresh[f][k]];
  });
  return old;
}

Permutation reorder(std::vector<Triangle> faces, const std::vector<int>& order) {
  std::vector<int> fresh(order.size());
  for (size_t i = 0; i < order.size(); ++i) fresh[order[i]] = static_cast<int>(i);
  std::vector<std::array<int, 1>> smallest(faces.size());  // vertex of each face
  parallel_for(faces.size(), order_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      for (int& v : faces[f]) v = fresh[v];
      smallest[f][0] = std::ranges::min(faces[f]);
    }
  });
  Permutation r;
  r.old_vertex = order;
  r.old_face = inverse(static_cast<int>(order.size()), smallest).items;
  r.faces.resize(faces.size());
  parallel_for(faces.size(), order_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) r.faces[f] = faces[r.old_face[f]];
  });
  return r;
}

}  // namespace hooke
