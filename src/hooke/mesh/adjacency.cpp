#include "hooke/mesh/adjacency.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr size_t adjacency_block = 1024;

/// A face as seen from one of its corners.
struct FaceInRing {
  int out, in;         // half-edges that leave and enter the corner
  int next, previous;  // the other corners
};

/// Sorts ascending by the previous corner. Rings are short; vertices of high valence are rare.
void sort_by_previous(std::vector<FaceInRing>& ring) {
  constexpr size_t short_ring = 16;
  if (ring.size() > short_ring) {
    std::ranges::sort(ring, {}, &FaceInRing::previous);
    return;
  }
  for (size_t i = 1; i < ring.size(); ++i)
    for (size_t k = i; k > 0 && ring[k].previous < ring[k - 1].previous; --k) std::swap(ring[k], ring[k - 1]);
}

/// Collects the ring entries of the vertex, ascending by their previous corner.
void collect(int vertex, std::span<const int> its_faces, const std::vector<Triangle>& faces,
             std::vector<FaceInRing>& ring) {
  ring.clear();
  for (int f : its_faces) {
    const Triangle& t = faces[f];
    const int k = static_cast<int>(corner_of(t, vertex)), before = (k + 2) % 3;
    ring.push_back({3 * f + k, 3 * f + before, t[(k + 1) % 3], t[before]});
  }
  sort_by_previous(ring);
}

/// Index of the entry of the face across the outgoing half-edge of `entry`; ring.size() if there is none.
size_t follower(const std::vector<FaceInRing>& ring, const FaceInRing& entry) {
  const auto position = std::ranges::lower_bound(ring, entry.next, {}, &FaceInRing::previous);
  const bool found = position != ring.end() && position->previous == entry.next;
  return found ? position - ring.begin() : ring.size();
}

Fan classify(const std::vector<FaceInRing>& ring, std::vector<char>& followed) {
  if (ring.empty()) return Fan::isolated;
  followed.assign(ring.size() + 1, 0);
  for (const FaceInRing& entry : ring)
    if (std::exchange(followed[follower(ring, entry)], 1)) return Fan::broken;  // two ends, or a branch
  // No entry follows two others, and at most one has no follower: it remains to check whether all entries
  // form one chain or cycle.
  const size_t first = std::ranges::find(followed, 0) - followed.begin();
  const size_t start = first < ring.size() ? first : 0;
  size_t reached = 1;
  size_t at = follower(ring, ring[start]);
  for (; at != ring.size() && at != start; at = follower(ring, ring[at])) ++reached;
  const bool doubled = at == start && ring.size() == 2;  // two faces with the same corners
  return reached == ring.size() && !doubled ? Fan::whole : Fan::broken;
}

/// Finds the twins of all half-edges and calls visit(vertex, ring, scratch) for each vertex.
template <typename Visit>
void for_each_ring(int vertex_count, const std::vector<Triangle>& faces, HalfEdges& half_edges,
                   const Visit& visit) {
  parallel_for(vertex_count, adjacency_block, [&](size_t begin, size_t end) {
    std::vector<FaceInRing> ring;
    std::vector<char> scratch;
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
      collect(v, half_edges.faces[v], faces, ring);
      visit(v, ring, scratch);
      for (const FaceInRing& entry : ring)
        if (const size_t other = follower(ring, entry); other < ring.size())
          half_edges.twins[entry.out] = ring[other].in;
    }
  });
}

}  // namespace

HalfEdges pair_half_edges(int vertex_count, const std::vector<Triangle>& faces) {
  HalfEdges half_edges{inverse(vertex_count, faces), std::vector<int>(3 * faces.size(), -1)};
  for_each_ring(vertex_count, faces, half_edges,
                [](int, const std::vector<FaceInRing>&, std::vector<char>&) {});
  return half_edges;
}

VertexFans examine_fans(int vertex_count, const std::vector<Triangle>& faces) {
  VertexFans fans{{inverse(vertex_count, faces), std::vector<int>(3 * faces.size(), -1)},
                  std::vector<Fan>(vertex_count)};
  for_each_ring(vertex_count, faces, fans,
                [&](int v, const std::vector<FaceInRing>& ring, std::vector<char>& followed) {
                  fans.kinds[v] = classify(ring, followed);
                });
  return fans;
}

int first_broken(const VertexFans& fans) {
  const auto broken = std::ranges::find(fans.kinds, Fan::broken);
  return broken == fans.kinds.end() ? -1 : static_cast<int>(broken - fans.kinds.begin());
}

namespace {

/// Whether half-edge h is the first that names its edge.
bool names_edge(const std::vector<int>& twins, size_t h) {
  return twins[h] < 0 || static_cast<int>(h) < twins[h];
}

/// Numbers the edges in the order of the half-edges that name them.
void number_edges(const std::vector<int>& twins, Adjacency& c) {
  std::vector<int> first(twins.size() / adjacency_block + 2, 0);  // first edge of each block of half-edges
  parallel_for(twins.size(), adjacency_block, [&](size_t begin, size_t end) {
    for (size_t h = begin; h < end; ++h) first[h / adjacency_block + 1] += names_edge(twins, h);
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  c.edges.resize(first.back());
  c.edge_faces.resize(c.edges.size());
  c.face_edges.resize(c.faces.size());
  parallel_for(twins.size(), adjacency_block, [&](size_t begin, size_t end) {
    int edge = first[begin / adjacency_block];
    for (size_t h = begin; h < end; ++h) {
      if (!names_edge(twins, h)) continue;
      const Triangle& t = c.faces[h / 3];
      c.edges[edge] = {t[h % 3], t[(h + 1) % 3]};
      c.edge_faces[edge] = {static_cast<int>(h / 3), twins[h] < 0 ? -1 : twins[h] / 3};
      c.face_edges[h / 3][h % 3] = edge;
      if (twins[h] >= 0) c.face_edges[twins[h] / 3][twins[h] % 3] = edge;
      ++edge;
    }
  });
}

/// The other end of every edge in c.vertex_edges.
IntLists other_ends(const Adjacency& c) {
  IntLists lists = c.vertex_edges;
  parallel_for(c.vertex_count, adjacency_block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      for (auto i = static_cast<size_t>(lists.first[v]); i < static_cast<size_t>(lists.first[v + 1]); ++i)
        lists.items[i] = c.other_end(lists.items[i], static_cast<int>(v));
  });
  return lists;
}

}  // namespace

Adjacency make_adjacency(int vertex_count, std::vector<Triangle> faces) {
  HalfEdges half_edges = pair_half_edges(vertex_count, faces);
  return make_adjacency(std::move(faces), std::move(half_edges));
}

Adjacency make_adjacency(std::vector<Triangle> faces, HalfEdges half_edges) {
  Adjacency c;
  c.vertex_count = static_cast<int>(half_edges.faces.first.size()) - 1;
  c.faces = std::move(faces);
  c.vertex_faces = std::move(half_edges.faces);
  number_edges(half_edges.twins, c);
  c.vertex_edges = inverse(c.vertex_count, c.edges);
  c.vertex_neighbours = other_ends(c);
  return c;
}

std::vector<int> with_rings(const Adjacency& c, const std::vector<int>& vertices, int rings) {
  std::vector<char> marked(c.vertex_count, 0);
  std::vector<int> all;
  const auto add = [&](int v) {
    if (!std::exchange(marked[v], 1)) all.push_back(v);
  };
  std::ranges::for_each(vertices, add);
  for (int ring = 0; ring < rings; ++ring)
    for (size_t i = 0, count = all.size(); i < count; ++i)
      std::ranges::for_each(c.vertex_neighbours[all[i]], add);
  return all;
}

}  // namespace hooke
