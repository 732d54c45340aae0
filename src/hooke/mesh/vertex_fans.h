// The faces around each vertex as one fan: what makes a triangle mesh a manifold with an orientation.
#pragma once

#include "hooke/core/int_lists.h"
#include "hooke/core/types.h"

namespace hooke {

enum class Fan : char {
  isolated,  // no faces
  whole,     // faces in one chain or cycle, oriented alike
  broken,    // anything else: not a manifold there, or not oriented, or a face twice
};

struct HalfEdges {
  IntLists faces;  // of each vertex, ascending
  /// The half-edge across each half-edge. Half-edge 3 f + k runs from corner k of face f to the next corner;
  /// its twin runs back, or is -1 on the boundary. Says nothing at a broken ring.
  std::vector<int> twins;
};

struct VertexFans : HalfEdges {
  std::vector<Fan> kinds;  // per vertex
};

/// Pre-condition of both: corners in [0, vertex_count), three different ones to a face.
HalfEdges pair_half_edges(int vertex_count, const std::vector<Triangle>& faces);
VertexFans examine_fans(int vertex_count, const std::vector<Triangle>& faces);

/// The first vertex whose ring is broken; -1 for a manifold.
int first_broken(const VertexFans& fans);

}  // namespace hooke
