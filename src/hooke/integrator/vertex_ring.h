// The faces and edges around one vertex, gathered once: its energy as a function of its place, to second
// order, and what the guards ask of a move.
#pragma once

#include "hooke/filter/retraction.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/ring_energy.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {

/// The shape of a ring with its vertex at one place. Columns of numbers, one entry a spoke.
struct RingShape {
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  // of the vertex
  std::vector<double> columns;
};

/// What the guards measure on a ring, one entry a spoke.
struct RingMeasures {
  std::vector<double> area, alignment;  // of the face
  std::vector<double> cotangent;        // of its least angle
  std::vector<double> sagitta;          // of the edge
  std::vector<double> fold;             // cosine between the faces on both sides of the edge
  std::vector<double> far_fold;         // and on both sides of the face's far edge
};

/// Holds no more than one ring at a time; made once for many vertices, for its memory. On a crease each side
/// of the vertex has a ring of its own, and the energy is the sum.
class VertexRing {
 public:
  /// Keeps references.
  VertexRing(const VertexRings& rings, const TargetLengths& targets) : spokes_(rings), targets_(targets) {}

  /// Takes in all but the vertex itself. Pre-condition: the vertex has faces. `side` is the vertex or one of
  /// its further sides.
  void gather(const SurfacePositions& at, int wedge);

  /// The ring with its vertex at this point, where the surface has this normal.
  void shape(const Vec3& point, const Vec3& normal, RingShape& shape) const;

  /// The part of the energy that the vertex takes part in, up to a constant.
  double energy(const RingShape& shape, const EnergyTerms& terms) const;

  /// The same with its derivatives along two directions, of which the second may be zero. The normals count
  /// as constant.
  RingModel model(const RingShape& shape, const EnergyTerms& terms, const Vec3& u, const Vec3& v) const;

  /// Whether the vertex may move so.
  bool obeys(const RingShape& before, const RingShape& after, const GuardOptions& options) const;

  RingMeasures measures(const RingShape& shape) const;

  /// The greatest cotangent of the faces' least angles; 0 if none is greater.
  double max_cotangent(const RingShape& shape) const;

  /// The number of faces with an alignment below `limit`.
  int folded_faces(const RingShape& shape, double limit) const;

 private:
  std::span<const RingEntry> rings() const { return spokes_[wedge_]; }
  RingView view(const RingShape& s) const { return {columns_.data(), s.columns.data(), stride_, s.normal}; }
  RingModel unfold(const RingShape& shape, const EnergyTerms& terms, const Vec3& u, const Vec3& v,
                   std::vector<double>& unfolded) const;

  const VertexRings& spokes_;
  const TargetLengths& targets_;
  bool fold_breaks(const GuardOptions& options, std::size_t entry, const RingMeasures& before,
                   const RingMeasures& after) const;
  bool begins_at_crease() const {
    return !spokes_.mate.empty() && spokes_.mate[static_cast<std::size_t>(wedge_)] >= 0;
  }

  int wedge_ = 0;
  Vec3 mate_ = Vec3::Zero();     // corner of the face beyond the crease with which the side begins
  std::size_t stride_ = 0;       // entries of a column: whole groups of lanes
  std::vector<double> columns_;  // what stays as it is while the vertex moves
};

}  // namespace hooke
