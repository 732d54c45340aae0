#include "hooke/springs/energy.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "hooke/core/parallel.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/hooke_law.h"
#include "hooke/springs/target_lengths.h"
#include "support/meshes.h"
#include "support/named_terms.h"

namespace hooke::energy_test {

struct Placed {
  Mat3X points, normals;

  double energy(Energy& energy, Mat3X* gradient) const { return energy(points, normals, gradient); }
};

Placed on_unit_sphere(const Mat3X& points) {
  Placed p;
  p.points = points;
  p.normals = points.colwise().normalized();
  return p;
}

class EnergyLaws : public testing::TestWithParam<test::NamedTerms> {
 protected:
  test::Triangles mesh_ = test::sphere(2, .35, 7);
  Adjacency c_ = make_adjacency(static_cast<int>(mesh_.points.cols()), mesh_.faces);
  TargetLengths targets_ = spread_target_lengths(c_, lengths());
  Energy energy_{c_, targets_, GetParam().terms};

  std::vector<double> lengths() const {  // graded, so that no unit is taken for granted
    std::vector<double> l(c_.vertex_count);
    for (size_t v = 0; v < l.size(); ++v) l[v] = .3 + .1 * mesh_.points(0, static_cast<Eigen::Index>(v));
    return l;
  }
};

TEST_P(EnergyLaws, GradientEqualsDifferences) {
  Placed p = on_unit_sphere(mesh_.points);
  Mat3X gradient;
  ASSERT_GT(energy_(p.points, p.normals, &gradient), 0);
  const double h = 1e-6;
  for (Eigen::Index v = 0; v < p.points.cols(); v += 13)
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double x = p.points(k, v);
      p.points(k, v) = x + h;
      const double up = energy_(p.points, p.normals, nullptr);
      p.points(k, v) = x - h;
      const double down = energy_(p.points, p.normals, nullptr);
      p.points(k, v) = x;
      EXPECT_NEAR(gradient(k, v), (up - down) / (2 * h), 1e-5 * (1 + std::abs(gradient(k, v))))
          << v << ' ' << k;
    }
}

TEST_P(EnergyLaws, ForcesOfAPotentialSumToZero) {
  Mat3X gradient;
  on_unit_sphere(mesh_.points).energy(energy_, &gradient);
  EXPECT_LT(gradient.rowwise().sum().norm(), 1e-9 * gradient.colwise().norm().sum());
}

/// A mesh so large that its faces are summed up in several parts, which end elsewhere in reverse order.
TEST_P(EnergyLaws, TheOrderOfTheFacesDoesNotMatter) {
  const test::Triangles t = test::grid(150, test::paraboloid, .3, 3);
  std::vector<Triangle> reversed(t.faces.rbegin(), t.faces.rend());
  const int n = static_cast<int>(t.points.cols());
  const Adjacency forwards = make_adjacency(n, t.faces), back = make_adjacency(n, reversed);
  const std::vector<double> lengths(n, 1. / 150);
  const TargetLengths targets = spread_target_lengths(forwards, lengths),
                      targets_back = spread_target_lengths(back, lengths);
  Placed p;
  p.points = t.points;
  p.normals = Vec3::UnitZ().replicate(1, n);
  Mat3X gradient, gradient_back;
  const double energy = Energy(forwards, targets, GetParam().terms)(p.points, p.normals, &gradient);
  EXPECT_NEAR(Energy(back, targets_back, GetParam().terms)(p.points, p.normals, &gradient_back), energy,
              1e-10 * energy);
  EXPECT_LT((gradient - gradient_back).cwiseAbs().maxCoeff(), 1e-10 * gradient.cwiseAbs().maxCoeff());
}

TEST_P(EnergyLaws, OneThreadAndTwoGiveTheSameBits) {
  Mat3X one, two;
  double e1, e2;
  {
    ThreadLimit limit(1);
    e1 = on_unit_sphere(mesh_.points).energy(energy_, &one);
  }
  {
    ThreadLimit limit(2);
    e2 = on_unit_sphere(mesh_.points).energy(energy_, &two);
  }
  EXPECT_EQ(e1, e2);
  EXPECT_EQ(one, two);
}

INSTANTIATE_TEST_SUITE_P(All, EnergyLaws,
                         testing::Values(test::NamedTerms{"strings", test::only_strings()},
                                         test::NamedTerms{"altitudes", RingTerms{}}),
                         [](const auto& i) { return std::string(i.param.name); });

TEST_P(EnergyLaws, IsTheSumOfItsSprings) {
  const Placed p = on_unit_sphere(mesh_.points);
  const double expected = test::energy_by_definition(p.points, p.normals, c_, targets_, GetParam().terms);
  EXPECT_NEAR(p.energy(energy_, nullptr), expected, 1e-12 * expected);
}

TEST(Energy, VanishesOnEquilateralTrianglesOfTheTargetLength) {
  Placed p;
  p.points = Mat3X(3, 3);
  p.points.col(0) = Vec3(0, 0, 0);
  p.points.col(1) = Vec3(2, 0, 0);
  p.points.col(2) = Vec3(1, std::sqrt(3.), 0);
  p.normals = Vec3::UnitZ().replicate(1, 3);
  const Adjacency c = make_adjacency(3, {{0, 1, 2}});
  const TargetLengths targets = spread_target_lengths(c, {2, 2, 2});
  Mat3X gradient;
  EXPECT_NEAR(Energy(c, targets, EnergyTerms{})(p.points, p.normals, &gradient), 0,
              1e-14);  // rounding of ln(L / l)
  EXPECT_LT(gradient.norm(), 1e-12);
}

TEST(Energy, AFaceWithoutAreaIsPushedOpenAlongTheSurface) {
  Placed p;
  p.points = Mat3X(3, 3);
  p.points.col(0) = Vec3(0, 0, 0);
  p.points.col(1) = Vec3(1, 0, 0);
  p.points.col(2) = Vec3(.5, 0, 0);  // on the edge; to its left (+y) the face is the right way round
  p.normals = Vec3::UnitZ().replicate(1, 3);
  const Adjacency c = make_adjacency(3, {{0, 1, 2}});
  const TargetLengths targets = spread_target_lengths(c, {1, 1, 1});
  Mat3X gradient;
  EXPECT_TRUE(std::isfinite(Energy(c, targets, EnergyTerms{})(p.points, p.normals, &gradient)));
  EXPECT_TRUE(gradient.allFinite());
  EXPECT_LT(gradient(1, 2), 0);  // the force is its negative
}

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
    evaluate_face_springs({.7, .4}, f);
    ASSERT_FALSE(f.needs_normals);
    double expected = 0;
    for (std::size_t lane = 0; lane < lane_count; ++lane) expected += expected_energy(f, lane, .7, .4);
    EXPECT_NEAR(f.energy, expected, 1e-12 * expected);
  }
}

TEST(FaceSprings, GradientEqualsDifferences) {
  FaceSprings f = four_faces(3);
  evaluate_face_springs({1, .5}, f);
  const double h = 1e-6;
  for (std::size_t i = 0; i < std::size(f.corners); ++i) {
    FaceSprings up = f, down = f;
    up.corners[i] += h;
    down.corners[i] -= h;
    evaluate_face_springs({1, .5}, up);
    evaluate_face_springs({1, .5}, down);
    EXPECT_NEAR(f.gradient[i], (up.energy - down.energy) / (2 * h), 1e-6 * (1 + std::abs(f.gradient[i])))
        << i;
  }
}

/// The third corner of the face in lane 2 lies on the edge between the others.
FaceSprings with_a_flat_face(unsigned seed) {
  FaceSprings f = four_faces(seed);
  for (std::size_t d = 0; d < 3; ++d)
    f.corners[(6 + d) * lane_count + 2] =
        .5 * (corner(f, 0, 2) + corner(f, 1, 2))[static_cast<Eigen::Index>(d)];
  return f;
}

TEST(FaceSprings, AFaceWithoutAreaOpensAcrossItsNormalAndLeavesTheOthersAlone) {
  FaceSprings f = with_a_flat_face(5);
  evaluate_face_springs({}, f);
  ASSERT_TRUE(f.needs_normals);
  const Vec3 along = corner(f, 1, 2) - corner(f, 0, 2), up = along.unitOrthogonal();
  for (std::size_t d = 0; d < 3; ++d) f.surface_normal[d * lane_count + 2] = up[static_cast<Eigen::Index>(d)];
  for (std::size_t lane : {0, 1, 3}) f.surface_normal[lane] = 1;
  f.has_normals = true;
  evaluate_face_springs({}, f);
  ASSERT_FALSE(f.needs_normals);
  EXPECT_TRUE(std::isfinite(f.energy));
  const auto gradient = [](const FaceSprings& of, std::size_t k, std::size_t lane) {
    const double* g = of.gradient + 3 * k * lane_count + lane;
    return Vec3(g[0], g[lane_count], g[2 * lane_count]);
  };
  const Vec3 force = -gradient(f, 2, 2);
  EXPECT_GT(force.dot(up.cross(along)), 0);
  EXPECT_NEAR(force.dot(up), 0, 1e-9 * force.norm());
  FaceSprings good = four_faces(5);
  evaluate_face_springs({}, good);
  for (std::size_t lane : {0, 1, 3})
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(gradient(f, k, lane), gradient(good, k, lane));
}

TEST(FaceSprings, APointThatIsNoNumberHasNoFiniteEnergy) {
  for (std::size_t i = 0; i < std::size(FaceSprings{}.corners); ++i) {
    FaceSprings f = four_faces(7);
    std::ranges::fill(f.has_edge, 1);
    f.corners[i] = std::numeric_limits<double>::quiet_NaN();
    evaluate_face_springs({}, f);
    EXPECT_FALSE(std::isfinite(f.energy)) << i;
  }
}

}  // namespace hooke::energy_test
