// The faces and edges around one vertex, gathered once: the energy as a function of the vertex position, to
// second order, and the guards on a displacement of the vertex.
#pragma once

#include "hooke/filter/retraction.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/ring_energy.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {

/// The shape of a ring for one position of its vertex. Columns with one value per ring entry.
struct RingShape {
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  // of the vertex
  std::vector<double> columns;
};

/// What the guards limit at one entry of a ring.
struct RingMeasures {
  double area = 0, alignment = 1;  // of the face
  double cotangent = 0;            // of its smallest angle
  double sagitta = 0;              // of the edge
  double fold = 1;                 // cosine between the faces on both sides of the edge
  double far_fold = 1;             // the same across the face's far edge
};

/// Holds one ring at a time; reused for many vertices to save allocations. On a crease each wedge of the
/// vertex has its own ring, and the energy is the sum.
class VertexRing {
 public:
  /// Keeps references.
  VertexRing(const VertexRings& rings, const TargetLengths& targets) : rings_(rings), targets_(targets) {}

  /// Gathers everything but the vertex itself. `wedge` is the vertex or one of its extra wedges.
  /// Pre-condition: it has faces.
  void gather(const SurfacePositions& at, int wedge);

  /// Measures the ring with its vertex at `point`, where the surface has the unit normal `normal`.
  void shape(const Vec3& point, const Vec3& normal, RingShape& shape) const;

  /// The part of the energy that depends on the vertex, up to a constant.
  double energy(const RingShape& shape, const RingTerms& terms) const;

  /// The same with its derivatives along two directions, of which v may be zero. The surface normals count as
  /// constant.
  RingModel model(const RingShape& shape, const RingTerms& terms, const Vec3& u, const Vec3& v) const;

  /// Do the guards allow the displacement of the vertex from `before` to `after`?
  bool obeys(const RingShape& before, const RingShape& after, const ShapeLimits& limits) const;

  /// The maximum cotangent of the faces' smallest angles, at least 0.
  double max_cotangent(const RingShape& shape) const;

  /// The number of faces with an alignment below `limit`.
  int folded_faces(const RingShape& shape, double limit) const;

 private:
  std::span<const RingEntry> entries() const { return rings_[wedge_]; }
  RingView view(const RingShape& s) const { return {columns_.data(), s.columns.data(), stride_, s.normal}; }
  RingModel unfold(const RingShape& shape, const RingTerms& terms, const Vec3& u, const Vec3& v,
                   std::vector<double>& face_mask) const;
  double alignment(const RingShape& shape, std::size_t entry) const;
  RingMeasures measures(const RingShape& shape, std::size_t entry) const;

  const VertexRings& rings_;
  const TargetLengths& targets_;
  bool fold_breaks(const ShapeLimits& limits, std::size_t entry, const RingMeasures& before,
                   const RingMeasures& after) const;
  bool begins_at_crease() const {
    return !rings_.crease_opposite.empty() && rings_.crease_opposite[wedge_] >= 0;
  }

  int wedge_ = 0;
  Vec3 crease_opposite_ = Vec3::Zero();  // opposite vertex beyond the crease where the wedge begins
  std::size_t stride_ = 0;               // values per column: whole groups of lanes
  std::vector<double> columns_;          // values that do not depend on the vertex position
};

}  // namespace hooke
