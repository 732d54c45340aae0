// Ways that end on the surface, taken back where a guard breaks on them or faces come to cross.
#pragma once

#include <optional>

#include "hooke/filter/retraction.h"
#include "hooke/integrator/guards.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {

/// Puts vertices back from `to` to where they were in `from`, point and normal, until no guard breaks on the
/// way. Returns these.
std::vector<int> revert_offenders(const Guards& guards, const SurfacePositions& from, SurfacePositions& to);

/// The same where no vertices moved but these.
std::vector<int> revert_offenders(const Guards& guards, const SurfacePositions& from,
                                  const std::vector<int>& moved, SurfacePositions& to);

/// Puts the vertices of faces that have come to cross each other back to where they were, with them those
/// that a guard then wants back, and in each of a few rounds a ring more about what still crosses. Parts that
/// crossed before go on to cross along the same curve: what is close to it stays. Returns these vertices,
/// ascending.
std::vector<int> revert_crossings(const Guards& guards, const Adjacency& adjacency,
                                  const SurfacePositions& from, SurfacePositions& to);

/// to = from with the vertices projected that have drifted, but for those where that would break a guard:
/// they stay drifted.
void project_drifted(const Guards& guards, Retraction& retraction, const SurfacePositions& from,
                     SurfacePositions& to);

/// The same in place.
void project_drifted(const Guards& guards, Retraction& retraction, SurfacePositions& positions);

/// The cotangent that guards have where no face's least angle may fall below the least of all as they are
/// now, with room for the final projection.
double cotangent_to_keep(const Mat3X& points, const std::vector<Triangle>& faces);

/// Puts the vertices of a workspace on the field of the input, within guards that are looser than those of
/// the steps. Keeps a reference to the workspace.
class FinalProjection {
 public:
  /// `guards` are those of the steps.
  FinalProjection(Workspace& work, const GuardOptions& guards);

  /// Fits a new field to the vertices as they lie now, see Workspace::refit(). Fields fitted again and again
  /// may let thin sheets drift through each other: project() takes that back.
  void refit();

  /// Projects the vertices. One whose way would break a guard stays where it is; returns their number. Faces
  /// that have come to cross since refit() go back to where they were, see revert_crossings().
  int project();

  /// Projects vertices, ascending, each named once, that have moved on the field of the input since, after
  /// Workspace::return_to_input(); returns how many of all stay where they are.
  int project(const std::vector<int>& vertices);

  /// Did the last projection of all take crossings back?
  bool reverted_crossings() const { return reverted_crossings_; }

 private:
  Guards guards() const;
  void undo_crossings();

  Workspace& work_;
  GuardOptions step_guards_;
  std::vector<int> unprojected_;  // vertices that stayed where they were
  struct Projected {
    SurfacePositions positions;
    std::vector<int> unprojected;
  };
  std::optional<Projected> before_refit_;  // until the next projection
  bool reverted_crossings_ = false;
};

}  // namespace hooke
