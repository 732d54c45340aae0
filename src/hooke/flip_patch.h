// The neighbourhood of an edge as a small mesh of its own, in which a flip of the edge is tried.
#pragma once

#include <optional>

#include "hooke/edge_flips.h"
#include "hooke/guard_rules.h"

namespace hooke {

/// An edge with which a patch ends though the mesh goes on.
struct PatchRim {
  int half_edge;  // of the mesh, on the patch's side
  int from, to;   // its ends, in ids of the patch
};

struct FlipPatch {
  /// Of the whole mesh's vertices: the edge's ends first, then the others that may move, then those around.
  std::vector<int> sides;
  size_t movable = 0;           // so many may move, but for those on creases and boundaries
  std::vector<Triangle> faces;  // all that the movable ones have, in ids of the patch
  std::vector<PatchRim> rim;
  Placement placement;
  std::vector<double> vertex_length;
  Constraints constraints;
};

/// The vertices within so many rings about an inner edge, as far as creases. Nothing where more than `most`
/// vertices would move, or one of them has more edges.
std::optional<FlipPatch> cut_patch(const FlippingMesh& mesh, int half_edge, int rings, size_t most);

/// Only the two faces of the edge, of which no vertex may move.
FlipPatch cut_pair(const FlippingMesh& mesh, int half_edge);

/// The faces of the patch after the flip of its edge.
std::vector<Triangle> flipped_faces(const FlipPatch& patch);

/// Would faces of the patch, its edge flipped and its vertices where they are now, break the rule of folds
/// with those beyond its rim?
bool folds_at_rim(const FlipPatch& patch, const FlippingMesh& mesh, const GuardOptions& guards);

/// The vertex of the whole mesh that a side is of.
int vertex_of_side(const FlippingMesh& mesh, int side);

/// Moves the vertices of the mesh to where those of the patch are.
void move_vertices(const FlipPatch& patch, FlippingMesh& mesh);

}  // namespace hooke
