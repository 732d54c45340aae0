// A mesh whose vertices come and go: its triangles with all that belongs to each vertex, and what is to
// become of its curves.
#pragma once

#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/filter/retraction.h"
#include "hooke/mesh/halfedge_mesh.h"

namespace hooke {

struct Workspace;

/// A mesh whose edges are flipped and whose vertices move on the surface. All are references to objects that
/// outlive it.
struct FlippableMesh {
  HalfedgeMesh& halfedges;
  SurfacePositions& positions;
  Retraction& retraction;
  const Constraints& constraints;
  const std::vector<double>& vertex_length;  // target length per vertex
  const std::vector<int>& corner_valences;   // per side: wanted at corners, 0 elsewhere: corner_rule.h
  /// Called when vertices have moved, so that their target lengths can become those of their new places.
  std::function<void()> after_move = nullptr;
};

/// All references are to objects that outlive it. Until compact() the arrays are by the ids of the
/// triangulation, and may have room for more.
struct WorkingMesh {
  HalfedgeMesh& halfedges;
  SurfacePositions& positions;
  Retraction& retraction;
  Constraints& constraints;
  std::vector<double>& vertex_length;
  std::vector<int>& corner_valences;
  std::vector<int>& origins;  // what the vertex was before vertices came and went: an id, -1 if it is new
  const CurveFinder& curve_finder;
  CurveEdges& curve_edges;

  FlippableMesh flipping() const {
    return {halfedges, positions, retraction, constraints, vertex_length, corner_valences};
  }
};

/// Does the edge lie along a curve: a boundary or a crease?
inline bool is_feature_edge(const HalfedgeMesh& t, int h) {
  return t.twin(h) < 0 || t.is_crease(h);
}

/// The curve along which the edge of a rim runs; curve -1 where none is known.
CurveFinder::Place curve_of(const WorkingMesh& mesh, int half_edge);

/// Of an edge between the vertices.
inline double target_length(const WorkingMesh& m, int v, int w) {
  return .5 * (m.vertex_length[static_cast<size_t>(v)] + m.vertex_length[static_cast<size_t>(w)]);
}

/// Length of the edge over its target length.
double relative_length(const WorkingMesh& mesh, int half_edge);

/// Fills curve_edges: one edge per target length, and as many more as it takes to keep the chords within
/// `chord_error` target lengths of the curve.
void count_curve_edges(WorkingMesh& mesh, double chord_error);

/// Adds what belongs to a vertex in the middle of the edge, on its curve or on the surface, and to its sides:
/// the only place where a vertex is born. The triangles do not know it yet. Returns the id that a split of
/// the edge will give it. `middle` is that of the edge if it is known, else null.
int add_vertex(WorkingMesh& mesh, int half_edge, const SurfacePosition* middle = nullptr);

/// Where the middle of an edge that is no rim comes to lie on the surface; safe for different edges at once.
SurfacePosition middle_of(const WorkingMesh& mesh, int half_edge);

/// Takes back what was added last.
void drop_vertex(WorkingMesh& mesh);

/// Gives up the ids that are unused, numbers the sides as split_wedges() does, and writes the creases to
/// the constraints.
void compact(WorkingMesh& mesh);

// The mesh of a work as one whose vertices come and go.

/// Pre-condition: the vertices lie on the field of the input, see Workspace::replace_faces().
class WorkspaceEdit {
 public:
  /// Keeps a reference to the work. `corner_angle`: degrees, see corner_rule.h.
  WorkspaceEdit(Workspace& work, double corner_angle);
  WorkspaceEdit(const WorkspaceEdit&) = delete;

  WorkingMesh& mesh() { return mesh_; }
  const WorkingMesh& mesh() const { return mesh_; }

  /// Gives the work the faces as they are now. Pre-condition: there were only flips.
  void replace_faces();

  /// Gives the work the mesh as it is now, which ends this one. Pre-condition: it is compact.
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
