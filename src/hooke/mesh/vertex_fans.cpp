#include "hooke/mesh/vertex_fans.h"

#include <algorithm>
#include <utility>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr size_t block = 1024;

/// A face as one of its corners sees it.
struct Spoke {
  int out, in;         // half-edges that leave the corner and come to it
  int next, previous;  // the other corners
};

/// Ascending by the previous corner. Rings are short, and hubs are rare.
void sort_by_previous(std::vector<Spoke>& ring) {
  constexpr size_t short_ring = 16;
  if (ring.size() > short_ring) {
    std::ranges::sort(ring, {}, &Spoke::previous);
    return;
  }
  for (size_t i = 1; i < ring.size(); ++i)
    for (size_t k = i; k > 0 && ring[k].previous < ring[k - 1].previous; --k) std::swap(ring[k], ring[k - 1]);
}

/// The spokes of the vertex, ascending by their previous corner.
void collect(int vertex, std::span<const int> its_faces, const std::vector<Triangle>& faces,
             std::vector<Spoke>& ring) {
  ring.clear();
  for (int f : its_faces) {
    const Triangle& t = faces[static_cast<size_t>(f)];
    const int k = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2, before = (k + 2) % 3;
    ring.push_back(
        {3 * f + k, 3 * f + before, t[static_cast<size_t>((k + 1) % 3)], t[static_cast<size_t>(before)]});
  }
  sort_by_previous(ring);
}

/// Place of a spoke of the face across the half-edge that leaves with `spoke`; ring.size() if there is none.
size_t follower(const std::vector<Spoke>& ring, const Spoke& spoke) {
  const auto found = std::ranges::lower_bound(ring, spoke.next, {}, &Spoke::previous);
  const bool there = found != ring.end() && found->previous == spoke.next;
  return there ? static_cast<size_t>(found - ring.begin()) : ring.size();
}

Fan classify(const std::vector<Spoke>& ring, std::vector<char>& followed) {
  if (ring.empty()) return Fan::isolated;
  followed.assign(ring.size() + 1, 0);
  for (const Spoke& spoke : ring)
    if (std::exchange(followed[follower(ring, spoke)], 1)) return Fan::broken;  // two ends, or one after two
  // Every spoke has another one after it, none has two before it, and at most one is the end: what is left to
  // know is whether all are in one chain or cycle.
  const auto first = static_cast<size_t>(std::ranges::find(followed, 0) - followed.begin());
  const size_t start = first < ring.size() ? first : 0;
  size_t reached = 1;
  size_t at = follower(ring, ring[start]);
  for (; at != ring.size() && at != start; at = follower(ring, ring[at])) ++reached;
  const bool doubled = at == start && ring.size() == 2;  // two faces with the same corners
  return reached == ring.size() && !doubled ? Fan::whole : Fan::broken;
}

/// Finds the twins of all half-edges and calls look(vertex, ring, memory) for each vertex.
template <typename Look>
void look_at_rings(int vertex_count, const std::vector<Triangle>& faces, HalfEdges& half_edges,
                   const Look& look) {
  parallel_for(static_cast<size_t>(vertex_count), block, [&](size_t begin, size_t end) {
    std::vector<Spoke> ring;
    std::vector<char> memory;
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
      collect(v, half_edges.faces[v], faces, ring);
      look(v, ring, memory);
      for (const Spoke& spoke : ring)
        if (const size_t other = follower(ring, spoke); other < ring.size())
          half_edges.twins[static_cast<size_t>(spoke.out)] = ring[other].in;
    }
  });
}

}  // namespace

HalfEdges pair_half_edges(int vertex_count, const std::vector<Triangle>& faces) {
  HalfEdges half_edges{invert(vertex_count, faces), std::vector<int>(3 * faces.size(), -1)};
  look_at_rings(vertex_count, faces, half_edges, [](int, const std::vector<Spoke>&, std::vector<char>&) {});
  return half_edges;
}

VertexFans examine_fans(int vertex_count, const std::vector<Triangle>& faces) {
  VertexFans fans{{invert(vertex_count, faces), std::vector<int>(3 * faces.size(), -1)},
                  std::vector<Fan>(static_cast<size_t>(vertex_count))};
  look_at_rings(vertex_count, faces, fans,
                [&](int v, const std::vector<Spoke>& ring, std::vector<char>& followed) {
                  fans.kinds[static_cast<size_t>(v)] = classify(ring, followed);
                });
  return fans;
}

int first_broken(const VertexFans& fans) {
  const auto broken = std::ranges::find(fans.kinds, Fan::broken);
  return broken == fans.kinds.end() ? -1 : static_cast<int>(broken - fans.kinds.begin());
}

}  // namespace hooke
