// The working mesh of the algorithms that change connectivity: a half-edge mesh with the data of each vertex
// (position, constraints, target length), and the edit of a workspace through it.
#pragma once

#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/filter/retraction.h"
#include "hooke/mesh/halfedge_mesh.h"

namespace hooke {

struct Workspace;

/// A mesh whose edges are flipped and whose vertices move on the surface. All references must outlive it.
struct FlippableMesh {
  HalfedgeMesh& halfedges;
  SurfacePositions& positions;
  Retraction& retraction;
  const Constraints& constraints;
  const std::vector<double>& vertex_length;  // target length per vertex
  /// Per wedge: target valence of a corner, else 0; see corner_valences().
  const std::vector<int>& corner_valences;
  /// Called after vertices have moved, to update their target lengths to their new positions.
  std::function<void()> after_move = nullptr;
};

/// A mesh whose edges are flipped, split and collapsed. All references must outlive it. Until compact() the
/// arrays are indexed by the ids of the half-edge mesh, and may have spare capacity.
struct WorkingMesh {
  HalfedgeMesh& halfedges;
  SurfacePositions& positions;
  Retraction& retraction;
  Constraints& constraints;
  std::vector<double>& vertex_length;
  std::vector<int>& corner_valences;
  std::vector<int>& origins;  // id of the vertex before any split or collapse, -1 for a new one
  const CurveFinder& curve_finder;
  CurveEdges& curve_edges;

  FlippableMesh flipping() const {
    return {halfedges, positions, retraction, constraints, vertex_length, corner_valences};
  }
};

/// The curve on which a feature edge lies; curve -1 if none is known.
CurveFinder::Location curve_of(const WorkingMesh& mesh, int half_edge);

/// Target length of an edge between the vertices.
inline double target_length(const WorkingMesh& m, int v, int w) {
  return .5 * (m.vertex_length[v] + m.vertex_length[w]);
}

/// Length of the edge over its target length.
double relative_length(const WorkingMesh& mesh, int half_edge);

/// Updates curve_edges: the edges present per curve, and their target number, which is one per target length,
/// plus what it takes to keep the chords within `chord_error` target lengths of the curve.
void count_curve_edges(WorkingMesh& mesh, double chord_error);

/// Adds the data of a vertex in the middle of the edge, on its curve or on the surface, and of its wedges; no
/// other function adds vertices. The half-edge mesh is not changed. Returns the id that a split of the edge
/// will assign. `middle` is the result of project_midpoint() if known, else null.
int add_vertex(WorkingMesh& mesh, int half_edge, const SurfacePosition* middle = nullptr);

/// The surface position of the midpoint of an edge that is no feature edge; safe for different edges at once.
SurfacePosition project_midpoint(const WorkingMesh& mesh, int half_edge);

/// Removes the data added last, when the split was not made.
void remove_last_vertex(WorkingMesh& mesh);

/// Removes unused ids, numbers the wedges as split_wedges() does, and writes the creases to the constraints.
void compact(WorkingMesh& mesh);

/// Edits the mesh of a workspace as a WorkingMesh. Pre-condition: the vertices lie on the field of the input,
/// see Workspace::replace_faces().
class WorkspaceEdit {
 public:
  /// Keeps a reference to the workspace. `corner_angle`: degrees, see corner_valences().
  WorkspaceEdit(Workspace& work, double corner_angle);
  WorkspaceEdit(const WorkspaceEdit&) = delete;

  WorkingMesh& mesh() { return mesh_; }
  const WorkingMesh& mesh() const { return mesh_; }

  /// Writes the current faces to the workspace. Pre-condition: there were only flips.
  void replace_faces();

  /// Writes the current mesh to the workspace; this edit must not be used afterwards. Pre-condition:
  /// compact() was called.
  void replace_mesh();

 private:
  Workspace& work_;
  HalfedgeMesh halfedges_;
  std::vector<int> corner_valences_;
  std::vector<int> origins_;
  const CurveFinder curve_finder_;
  CurveEdges curve_edges_;
  WorkingMesh mesh_;
};

}  // namespace hooke
