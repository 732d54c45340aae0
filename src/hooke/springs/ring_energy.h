// How the numbers of a ring lie in memory: columns of one entry a spoke, in whole groups of lanes.
#pragma once

#include "hooke/core/simd.h"
#include "hooke/core/types.h"
#include "hooke/springs/energy.h"

namespace hooke {

namespace ring {

/// Columns of what stays as it is while the vertex moves. A vector takes three.
enum Fixed : std::size_t {
  near = 0,          // the neighbour a
  far = 3,           // the next neighbour b
  face_normals = 6,  // sum of the surface normals at a and b
  edge_normal = 9,   // surface normal at a
  beyond = 12,       // doubled area vector of the face beyond a and b; zero without one
  edge_target = 15,
  face_target = 16,
  has_edge = 17,  // 1 or 0; columns are filled up to whole groups of lanes with a copy of the first spoke
  has_face = 18,
  fixed_columns = 19
};

/// Columns of the ring's shape with its vertex at one place.
enum Moving : std::size_t {
  to_near = 0,  // from the vertex
  to_far = 3,
  area_vector = 6,      // doubled
  previous_vector = 9,  // that of the face before, across the edge to a; zero without one
  doubled_area = 12,
  previous_area = 13,
  near_length = 14,
  far_length = 15,
  moving_columns = 16
};

}  // namespace ring

/// A ring with its vertex at one place.
struct RingView {
  const double* fixed;
  const double* moving;
  std::size_t stride;  // entries of a column
  Vec3 normal;         // of the surface at the vertex
};

HOOKE_INLINE void put(const Vec3& x, double* columns, std::size_t stride) {
  columns[0] = x[0];
  columns[stride] = x[1];
  columns[2 * stride] = x[2];
}

inline Vec3 get(const double* columns, std::size_t stride) {
  return {columns[0], columns[stride], columns[2 * stride]};
}

// The energy around one vertex from its ring: strings, altitudes and angles of four faces at a time.

constexpr double altitude_ratio = std::numbers::sqrt3 / 2;  // of an equilateral triangle

constexpr double angle_felt = 1.06;  // of the threshold, to where the curvature of angle springs fades out

/// The energy around a vertex to second order in two directions.
struct RingModel {
  double energy = 0;  // up to a constant
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

/// The terms of an energy but `unfold`. `unfolded` tells by 1 and 0 which faces they are for; null: all.
double ring_energy(const RingView& ring, const double* unfolded, const EnergyTerms& terms);

/// The same with its derivatives along u and v, of which v may be zero, added to the model.
void add_ring_model(const RingView& ring, const double* unfolded, const EnergyTerms& terms, const Vec3& u,
                    const Vec3& v, RingModel& model);

}  // namespace hooke
