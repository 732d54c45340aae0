// The energy around one vertex from its ring: strings, altitudes and angles of four faces at a time.
#pragma once

#include "hooke/springs/energy.h"
#include "hooke/springs/ring_columns.h"

namespace hooke {

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
