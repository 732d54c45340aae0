// How sweeps over the vertices run: what each vertex looks at, and which vertices may move at once.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// An edge of a vertex, and the face between it and the next spoke about that vertex.
struct RingEntry {
  int neighbour;  // the other end
  int edge;
  int face;    // -1 after the last edge of an open fan
  int across;  // corner of the face beyond that face's far edge; -1 without one
};

/// The spokes of each vertex or, where creases part it, of each of its sides, counter-clockwise; a closed fan
/// ends where it begins, an open one begins at the boundary or a crease.
struct VertexRings {
  std::vector<int> first;  // size: sides + 1
  std::vector<RingEntry> items;
  // Per item; empty without creases:
  std::vector<int> wedges;       // the neighbour's side, as the spoke sees it
  std::vector<char> owned;       // 0 for a crease that is counted on the vertex's other side
  std::vector<char> far_crease;  // 1 where the face's far edge is a crease
  // Per side; empty without creases: corner of the face beyond the crease with which the side begins, -1
  // where it begins otherwise.
  std::vector<int> mate;

  std::span<const RingEntry> operator[](int wedge) const {
    const auto s = static_cast<size_t>(wedge);
    return {items.data() + first[s], items.data() + first[s + 1]};
  }
};

/// Sweeps go wave by wave over blocks of consecutive vertices. No vertex of a block looks at a vertex of
/// another block of its wave: they may be worked at the same time, each from its first vertex to its last.
struct VertexColoring {
  VertexRings rings;
  int vertices = 0;
  int block = 1;  // vertices of a block
  std::vector<std::vector<int>> colors;
};
VertexColoring color_vertices(const Adjacency& adjacency);

/// A plan of one block, for small meshes that one thread works on.
VertexColoring color_as_one_block(const Adjacency& adjacency);

/// Calls body(begin, end) on each block of vertices, wave by wave.
void for_each_block(const VertexColoring& plan, const std::function<void(int begin, int end)>& body);

}  // namespace hooke
