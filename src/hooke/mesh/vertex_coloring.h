// Sweeps over the vertices: the one-ring of each vertex, and a colouring of blocks of vertices that can be
// processed in parallel.
#pragma once

#include <algorithm>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// An edge of a vertex, and the face between it and the next ring entry.
struct RingEntry {
  int neighbour;  // other end of the edge
  int edge;
  int face;    // -1 after the last edge of an open fan
  int across;  // vertex opposite the face's far edge on its other side; -1 without one
};

/// The one-ring of each vertex or, where creases divide it, of each of its wedges, counter-clockwise. A
/// closed fan ends where it begins, an open one begins at a feature edge.
struct VertexRings {
  std::vector<int> first;  // size: wedges + 1
  std::vector<RingEntry> items;
  // Per item; empty without creases:
  std::vector<int> wedges;       // wedge of the neighbour
  std::vector<char> owned;       // 0 for a crease edge that is counted in another wedge of the vertex
  std::vector<char> far_crease;  // 1 where the face's far edge is a crease
  // Per wedge; empty without creases: opposite vertex across the crease edge with which the wedge begins; -1
  // where it begins otherwise.
  std::vector<int> crease_opposite;

  std::span<const RingEntry> operator[](int wedge) const {
    const size_t s = wedge;
    return {items.data() + first[s], items.data() + first[s + 1]};
  }
};

/// Sweeps go colour by colour over blocks of consecutive vertices. No vertex depends on a vertex of another
/// block of the same colour: these blocks may be processed concurrently, each from its first vertex to its
/// last.
struct VertexColoring {
  VertexRings rings;
  int vertices = 0;
  int block = 1;                         // vertices per block
  std::vector<std::vector<int>> colors;  // blocks of each colour
};
VertexColoring color_vertices(const Adjacency& adjacency);

/// A colouring with a single block, for small meshes that one thread processes.
VertexColoring color_as_one_block(const Adjacency& adjacency);

/// Calls body(begin, end) on each block of vertices, colour by colour, in parallel within a colour.
void for_each_block(const VertexColoring& coloring, const std::function<void(int begin, int end)>& body);

/// Calls body(worker, i) for the index of each of these vertices, which are ascending, in the order of
/// for_each_block(); make() makes a worker for the vertices of a block.
template <typename Make, typename Body>
void for_each_of(const VertexColoring& coloring, const std::vector<int>& vertices, const Make& make,
                 const Body& body) {
  for_each_block(coloring, [&](int begin, int end) {
    auto v = std::ranges::lower_bound(vertices, begin);
    if (v == vertices.end() || *v >= end) return;
    auto worker = make();
    for (; v != vertices.end() && *v < end; ++v) body(worker, v - vertices.begin());
  });
}

}  // namespace hooke
