// The mesh of a work as one whose vertices come and go.
#pragma once

#include "hooke/working_mesh/adapting_mesh.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {

/// Pre-condition: the vertices lie on the field of the input, see Workspace::replace_faces().
class AdaptingWork {
 public:
  /// Keeps a reference to the work. `corner_angle`: degrees, see corner_rule.h.
  AdaptingWork(Workspace& work, double corner_angle);
  AdaptingWork(const AdaptingWork&) = delete;

  AdaptingMesh& mesh() { return mesh_; }
  const AdaptingMesh& mesh() const { return mesh_; }

  /// Gives the work the faces as they are now. Pre-condition: there were only flips.
  void replace_faces() { work_.replace_faces(triangulation_.faces()); }

  /// Gives the work the mesh as it is now, which ends this one. Pre-condition: it is compact.
  void replace_mesh() { work_.replace_mesh(triangulation_.faces(), triangulation_.sides(), origins_); }

 private:
  Workspace& work_;
  Triangulation triangulation_;
  std::vector<int> corner_valences_;
  std::vector<int> origins_;
  const CurveFinder curve_finder_;
  CurveEdges curve_edges_;
  AdaptingMesh mesh_;
};

}  // namespace hooke
