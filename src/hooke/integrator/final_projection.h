// Projection of the vertices to the field of the input, and the reversal of displacements that break a guard
// or make faces intersect.
#pragma once

#include <optional>

#include "hooke/filter/retraction.h"
#include "hooke/integrator/guards.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {

/// Reverts vertices of `to` to their point and normal in `from` until no displacement breaks a guard. Returns
/// the reverted vertices.
std::vector<int> revert_offenders(const Guards& guards, const SurfacePositions& from, SurfacePositions& to);

/// The same where only the vertices `moved` differ.
std::vector<int> revert_offenders(const Guards& guards, const SurfacePositions& from,
                                  const std::vector<int>& moved, SurfacePositions& to);

/// Reverts the vertices of faces that intersect in `to` but did not in `from`, and the vertices that the
/// guards then require; each of a few rounds takes in one more ring around the remaining intersections.
/// Intersections next to one that `from` already has are not reverted. Returns the reverted vertices,
/// ascending. Copies that slide together are reverted together.
std::vector<int> revert_crossings(const Guards& guards, const Adjacency& adjacency,
                                  const Constraints& constraints, const SurfacePositions& from,
                                  SurfacePositions& to);

/// to = from with drifted vertices projected; a vertex whose projection would break a guard stays drifted.
void project_drifted(const Guards& guards, Retraction& retraction, const SurfacePositions& from,
                     SurfacePositions& to);

/// The same in place.
void project_drifted(const Guards& guards, Retraction& retraction, SurfacePositions& positions);

/// The cotangent limit for guards that must keep the minimum angle of the faces as it is now, with a reserve
/// for the final projection.
double cotangent_limit(const Mat3X& points, const std::vector<Triangle>& faces);

/// Projects the vertices of a workspace to the field of the input, under guards looser than those of the
/// steps. Keeps a reference to the workspace.
class FinalProjection {
 public:
  /// `limits` are those of the steps.
  FinalProjection(Workspace& work, const ShapeLimits& limits);

  /// Fits a new field to the current vertices, see Workspace::refit(). Repeated fits may let thin sheets
  /// drift through each other; the next project() reverts that.
  void refit();

  /// Projects all vertices. A vertex whose projection would break a guard stays where it is; returns the
  /// number of these. Faces that have come to intersect since refit() are reverted, see revert_crossings().
  int project();

  /// Projects only `vertices` (ascending, unique), which have moved on the field of the input after
  /// Workspace::return_to_input(). Returns the number of all vertices that are not projected.
  int project(const std::vector<int>& vertices);

  /// Did the last projection of all vertices revert intersections?
  bool reverted_crossings() const { return reverted_crossings_; }

 private:
  Guards guards() const;
  void undo_crossings();

  Workspace& work_;
  ShapeLimits step_limits_;
  std::vector<int> unprojected_;  // vertices that the guards kept from being projected
  struct Projected {
    SurfacePositions positions;
    std::vector<int> unprojected;
  };
  std::optional<Projected> before_refit_;  // reset by the next projection
  bool reverted_crossings_ = false;
};

}  // namespace hooke
