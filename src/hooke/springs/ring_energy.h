// The energy around one vertex from its ring: strings, altitude and angle springs, to second order, for four
// faces at a time. A ring is stored as columns with one value per ring entry, padded to whole groups of
// lanes.
#pragma once

#include "hooke/core/simd.h"
#include "hooke/core/types.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/hooke_law.h"

namespace hooke {

namespace ring {

/// Columns that do not depend on the vertex position. A vector takes three.
enum Fixed : std::size_t {
  near = 0,         // position of the neighbour a
  far = 3,          // position of the next neighbour b
  normal_sums = 6,  // sum of the surface normals at a and b
  edge_normal = 9,  // surface normal at a
  beyond = 12,      // doubled area vector of the face beyond the edge a b; zero without one
  edge_target = 15,
  face_target = 16,
  has_edge = 17,  // 1 or 0; the padding repeats the first entry with 0
  has_face = 18,
  fixed_columns = 19
};

/// Columns that depend on the vertex position.
enum Moving : std::size_t {
  to_near = 0,          // from the vertex to a
  to_far = 3,           // from the vertex to b
  area_vector = 6,      // doubled
  previous_vector = 9,  // that of the previous face, across the edge to a; zero without one
  doubled_area = 12,
  previous_area = 13,
  near_length = 14,
  far_length = 15,
  moving_columns = 16
};

}  // namespace ring

/// A ring for one position of its vertex.
struct RingView {
  const double* fixed;
  const double* moving;
  std::size_t stride;  // values per column
  Vec3 normal;         // of the surface at the vertex
};

/// Writes a vector to three columns.
HOOKE_INLINE void put(const Vec3& x, double* columns, std::size_t stride) {
  columns[0] = x[0];
  columns[stride] = x[1];
  columns[2 * stride] = x[2];
}

/// Reads a vector from three columns.
inline Vec3 get(const double* columns, std::size_t stride) {
  return {columns[0], columns[stride], columns[2 * stride]};
}

/// Up to this multiple of the threshold the curvature of angle springs fades out.
constexpr double angle_fade_out = 1.06;

/// Weights of the terms about one vertex: those of the whole mesh, and two that act for a while.
struct RingTerms : EnergyTerms {
  double angle = 0;            // w: U(theta; t) / t^2 per corner angle theta < t
  double angle_threshold = 0;  // t, radians, below pi / 2
  double unfold = 0;           // of 3/2 ((d - s) / d)^2 with the signed area s, for faces with alignment < d;
                               // replaces the altitude and angle terms of such a face
  double unfold_below = .3;    // d
};

/// The energy around a vertex to second order in two directions u and v.
struct RingModel {
  double energy = 0;  // up to a constant
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

/// All terms of the energy except `unfold`. `face_mask` (null: all ones) has 1 for each face to which the
/// face terms apply, else 0.
double ring_energy(const RingView& ring, const double* face_mask, const RingTerms& terms);

/// The same with its derivatives along u and v, of which v may be zero; adds to the model.
void add_ring_model(const RingView& ring, const double* face_mask, const RingTerms& terms, const Vec3& u,
                    const Vec3& v, RingModel& model);

}  // namespace hooke
