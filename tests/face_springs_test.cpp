#include "hooke/springs/energy.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "hooke/springs/hooke_law.h"

namespace hooke {
namespace {

FaceSprings four_faces(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1), target(.3, 2);
  FaceSprings f;
  for (double& x : f.corners) x = coordinate(random);
  for (double& L : f.edge_target) L = target(random);
  for (double& L : f.face_target) L = target(random);
  for (std::size_t i = 0; i < 3 * lane_count; ++i) f.has_edge[i] = i % 5 != 0;
  std::ranges::fill(f.has_face, 1);
  return f;
}

Vec3 corner(const FaceSprings& f, std::size_t k, std::size_t lane) {
  const double* x = f.corners + 3 * k * lane_count + lane;
  return {x[0], x[lane_count], x[2 * lane_count]};
}

/// The same from the definitions.
double expected_energy(const FaceSprings& f, std::size_t lane, double string, double altitude) {
  double energy = 0;
  const Vec3 a = corner(f, 0, lane), b = corner(f, 1, lane), c = corner(f, 2, lane);
  const double doubled_area = (b - a).cross(c - a).norm();
  const double h0 = std::numbers::sqrt3 / 2 * f.face_target[lane];
  for (std::size_t k = 0; k < 3; ++k) {
    const double l = (corner(f, (k + 2) % 3, lane) - corner(f, (k + 1) % 3, lane)).norm();
    const double L = f.edge_target[k * lane_count + lane];
    if (f.has_edge[k * lane_count + lane] > 0) energy += string * spring_potential(l, L).value / (L * L);
    const double h = doubled_area / l;
    if (h < h0 && f.has_face[lane] > 0) energy += altitude * spring_potential(h, h0).value / (h0 * h0);
  }
  return energy;
}

TEST(FaceSprings, EnergyIsThatOfTheSprings) {
  for (unsigned seed = 1; seed < 30; ++seed) {
    FaceSprings f = four_faces(seed);
    f.has_face[seed % lane_count] = 0;
    for (std::size_t k = 0; k < 3; ++k) f.has_edge[k * lane_count + seed % lane_count] = 0;
    evaluate_face_springs(.7, .4, f);
    ASSERT_FALSE(f.flat);
    double expected = 0;
    for (std::size_t lane = 0; lane < lane_count; ++lane) expected += expected_energy(f, lane, .7, .4);
    EXPECT_NEAR(f.energy, expected, 1e-12 * expected);
  }
}

TEST(FaceSprings, GradientEqualsDifferences) {
  FaceSprings f = four_faces(3);
  evaluate_face_springs(1, .5, f);
  const double h = 1e-6;
  for (std::size_t i = 0; i < std::size(f.corners); ++i) {
    FaceSprings up = f, down = f;
    up.corners[i] += h;
    down.corners[i] -= h;
    evaluate_face_springs(1, .5, up);
    evaluate_face_springs(1, .5, down);
    EXPECT_NEAR(f.gradient[i], (up.energy - down.energy) / (2 * h), 1e-6 * (1 + std::abs(f.gradient[i])))
        << i;
  }
}

TEST(FaceSprings, FacesWithoutAreaAreTold) {
  FaceSprings f = four_faces(5);
  for (std::size_t d = 0; d < 3; ++d)
    f.corners[(6 + d) * lane_count + 2] =
        .5 * (corner(f, 0, 2) + corner(f, 1, 2))[static_cast<Eigen::Index>(d)];
  evaluate_face_springs(1, 1, f);
  EXPECT_TRUE(f.flat);
}

}  // namespace
}  // namespace hooke
