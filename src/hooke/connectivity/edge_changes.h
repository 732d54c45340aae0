// What can become of an edge: which changes are allowed, and each of them in a patch and in the whole mesh.
#pragma once

#include "hooke/working_mesh/adapting_mesh.h"
#include "hooke/working_mesh/edge_patch.h"

namespace hooke {

enum class ChangeKind {
  flip,   // the edge comes to join the corners across it
  split,  // a new vertex halves it
  merge,  // its ends become one vertex
};

struct EdgeChange {
  int half_edge;
  ChangeKind kind;
  int stays = 0;          // of a merge: the end where the half-edge begins (0) or ends (1)
  bool half_way = false;  // that end comes to the middle
};

/// The changes to choose from.
struct ChangeRules {
  int valence = 9;  // greatest of a vertex that gains edges
  bool splits = true, merges = true;
};

/// One half-edge of each inner edge of the faces about the corners of this one, ascending.
std::vector<int> inner_edges_about(const Triangulation& triangulation, int face);

/// The changes of an inner edge that leave a mesh of the same topology, creases and corners included,
/// whatever becomes of angles and folds: that is for a trial to tell. Vertices on curves neither come nor go.
std::vector<EdgeChange> allowed_changes(const AdaptingMesh& mesh, int half_edge, const ChangeRules& rules);

/// Puts the vertices of the patch of the edge where the change takes them, on the surface; a split adds one.
/// Returns the faces it has then.
std::vector<Triangle> change_patch(EdgePatch& patch, const EdgeChange& change, const Surface& surface,
                                   const RetractionOptions& options);

/// Changes the mesh as its patch was changed, and moves its vertices to where those of the patch are.
void change_mesh(AdaptingMesh& mesh, const EdgeChange& change, EdgePatch& patch);

}  // namespace hooke
