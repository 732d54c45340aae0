#include "hooke/springs/forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/hooke_law.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::forces_test {

using test::Triangles;

Adjacency connected(const Triangles& t) {
  return make_adjacency(static_cast<int>(t.points.cols()), t.faces);
}

/// Target lengths that differ from edge to edge, around `mean`: some edges push and some pull.
std::vector<double> uneven_lengths(const Adjacency& c, double mean) {
  std::vector<double> lengths(c.edges.size());
  for (size_t e = 0; e < lengths.size(); ++e) lengths[e] = mean * (1 + .3 * std::sin(double(e)));
  return lengths;
}

Mat3X strings(const Mat3X& points, const Adjacency& c, const std::vector<double>& lengths) {
  Mat3X forces(3, points.cols());
  string_forces(points, c, lengths, forces);
  return forces;
}

Mat3X torques(const Mat3X& points, const Adjacency& c) {
  Mat3X forces(3, points.cols());
  torque_forces(points, c, forces);
  return forces;
}

double energy(const Mat3X& points, const Adjacency& c, const std::vector<double>& lengths) {
  double sum = 0;
  for (size_t e = 0; e < c.edges.size(); ++e)
    sum += spring_potential((points.col(c.edges[e][1]) - points.col(c.edges[e][0])).norm(), lengths[e]).value;
  return sum;
}

/// Two triangles on the common edge from (0, -1/2, 0) to (0, 1/2, 0); `theta` is the angle between their
/// normals, 0 is flat.
Triangles hinge(double theta) {
  Triangles t{Mat3X(3, 4), {{0, 1, 2}, {1, 0, 3}}};
  t.points << 0, 0, -1, std::cos(theta),  //
      -.5, .5, 0, 0,                      //
      0, 0, 0, std::sin(theta);
  return t;
}

double normal_angle(const Triangles& t) {
  const Vec3 a = face_shape(t.points, t.faces[0]).normal, b = face_shape(t.points, t.faces[1]).normal;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(1.1, Vec3(1, 2, -3).normalized()).toRotationMatrix();
}

TEST(StringForces, AreMinusTheGradientOfTheEnergy) {
  const Triangles t = test::sphere(1, .2);
  const Adjacency c = connected(t);
  const auto lengths = uneven_lengths(c, .55);
  const Mat3X forces = strings(t.points, c, lengths);
  const double h = 1e-6;
  for (Eigen::Index i = 0; i < t.points.size(); ++i) {
    Mat3X ahead = t.points, behind = t.points;
    ahead.data()[i] += h;
    behind.data()[i] -= h;
    const double slope = (energy(ahead, c, lengths) - energy(behind, c, lengths)) / (2 * h);
    EXPECT_NEAR(forces.data()[i], -slope, 1e-8);
  }
}

TEST(StringForces, OfOneEdgeFollowTheModifiedLaw) {
  const Triangles t = hinge(0);
  const Adjacency c = connected(t);
  std::vector<double> lengths(c.edges.size());
  for (size_t e = 0; e < lengths.size(); ++e)
    lengths[e] = (t.points.col(c.edges[e][1]) - t.points.col(c.edges[e][0])).norm();
  ASSERT_EQ(c.edges[0], (Edge{0, 1}));  // of length 1
  lengths[0] = .75;                     // too long: pulls with l - L
  EXPECT_TRUE(strings(t.points, c, lengths).col(0).isApprox(Vec3(0, .25, 0)));
  lengths[0] = 4;  // too short: pushes with (L - l) L / l
  EXPECT_TRUE(strings(t.points, c, lengths).col(0).isApprox(Vec3(0, -12, 0)));
}

TEST(StringForces, SumToZeroAndExertNoMoment) {
  const Triangles t = test::sphere(2, .3);
  const Adjacency c = connected(t);
  const Mat3X forces = strings(t.points, c, uneven_lengths(c, .3));
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index v = 0; v < forces.cols(); ++v) moment += Vec3(t.points.col(v)).cross(Vec3(forces.col(v)));
  EXPECT_LT(forces.rowwise().sum().norm(), 1e-12);
  EXPECT_LT(moment.norm(), 1e-12);
  EXPECT_GT(forces.norm(), .1);
}

TEST(StringForces, OfAnEdgeOfLengthZeroAreLeftOut) {
  Triangles t = hinge(0);
  t.points.col(1) = t.points.col(0);
  const Adjacency c = connected(t);
  EXPECT_TRUE(strings(t.points, c, uneven_lengths(c, 1)).allFinite());
}

TEST(StringForces, CommuteWithRigidMotionAndScale) {
  const Triangles t = test::sphere(2, .3);
  const Adjacency c = connected(t);
  auto lengths = uneven_lengths(c, .3);
  const Mat3X forces = strings(t.points, c, lengths);
  const Mat3X moved = ((7 * some_rotation()) * t.points).colwise() + Vec3(3, -2, 5);
  for (double& l : lengths) l *= 7;
  EXPECT_LT((strings(moved, c, lengths) - 7 * some_rotation() * forces).norm(), 1e-11 * forces.norm());
}

TEST(TorqueForces, VanishOnAFlatMesh) {
  const Triangles t = test::grid(6, test::flat, .3);
  EXPECT_LT(torques(t.points, connected(t)).norm(), 1e-12);
}

TEST(TorqueForces, OfEveryFaceSumToZero) {
  const Triangles t = test::sphere(2, .3);
  const Mat3X forces = torques(t.points, connected(t));
  EXPECT_GT(forces.norm(), .1);
  EXPECT_LT(forces.rowwise().sum().norm(), 1e-12 * forces.norm());
}

TEST(TorqueForces, OfAHingeFollowTheFormula) {
  for (const double theta : {1e-9, .3, 1.5, 3., std::numbers::pi - 1e-4}) {
    const Triangles t = hinge(theta);
    const Mat3X forces = torques(t.points, connected(t));
    // T = theta / (1 + cos theta) / d about the edge, the tip is 2/3 of the height 1 from the centre, d =
    // 2/3.
    const double expected = theta / (2 * std::pow(std::cos(theta / 2), 2)) / (2. / 3) * (2. / 3);
    EXPECT_NEAR(forces.col(3).norm() / expected, 1, 1e-9) << theta;
    EXPECT_NEAR(forces.col(2).norm() / expected, 1, 1e-9) << theta;
  }
}

TEST(TorqueForces, UnfoldAHingeEitherWay) {
  for (const double theta : {-3., -1., -.01, .01, 1., 3.}) {
    Triangles t = hinge(theta);
    const double before = normal_angle(t);
    const Mat3X forces = torques(t.points, connected(t));
    t.points += 1e-4 / forces.norm() * forces;
    EXPECT_LT(normal_angle(t), before) << theta;
  }
}

TEST(TorqueForces, OfAFlatFoldAreLeftOut) {
  const Triangles t = hinge(std::numbers::pi);
  EXPECT_EQ(torques(t.points, connected(t)).norm(), 0);
}

TEST(TorqueForces, IgnoreADegenerateFace) {
  Triangles t = hinge(1);
  t.points.col(3) = Vec3(0, .1, 0);  // on the common edge
  EXPECT_EQ(torques(t.points, connected(t)).norm(), 0);
}

TEST(TorqueForces, DoNotDependOnTheSideOfTheNormals) {
  Triangles t = test::sphere(2, .3);
  const Mat3X outward = torques(t.points, connected(t));
  for (Triangle& f : t.faces) std::swap(f[1], f[2]);
  EXPECT_LT((torques(t.points, connected(t)) - outward).norm(), 1e-12 * outward.norm());
}

TEST(TorqueForces, CommuteWithRigidMotionAndIgnoreScale) {
  const Triangles t = test::sphere(2, .3);
  const Adjacency c = connected(t);
  const Mat3X forces = torques(t.points, c);
  const Mat3X moved = ((7 * some_rotation()) * t.points).colwise() + Vec3(3, -2, 5);
  EXPECT_LT((torques(moved, c) - some_rotation() * forces).norm(), 1e-11 * forces.norm());
}

TEST(Forces, DoNotDependOnTheNumberOfThreads) {
  const Triangles t = test::sphere(4, .2);
  const Adjacency c = connected(t);
  const auto lengths = uneven_lengths(c, .07);
  const auto both = [&](int threads) {
    const ThreadLimit limit(threads);
    return std::pair{strings(t.points, c, lengths), torques(t.points, c)};
  };
  EXPECT_EQ(both(1), both(2));
}

/// The energy of the altitude springs with all lengths 1, as a function of the points.
struct Altitudes {
  Adjacency adjacency;
  std::vector<double> lengths;
  Mat3X normals;

  explicit Altitudes(const Triangles& t)
      : adjacency(make_adjacency(static_cast<int>(t.points.cols()), t.faces)),
        lengths(adjacency.edges.size(), 1.),
        normals(Mat3X::Zero(3, t.points.cols())) {
    normals.row(2).setOnes();
  }
  double energy(const Mat3X& points) const { return altitude_energy(points, &normals, adjacency, lengths); }
  Mat3X forces(const Mat3X& points) const {
    Mat3X f = Mat3X::Zero(3, points.cols());
    add_altitude_forces(points, &normals, adjacency, lengths, 1, f);
    return f;
  }
};

TEST(AltitudeForces, AreMinusTheGradientOfTheirEnergyAndSumToZero) {
  Triangles t = test::grid(3, test::paraboloid, .4);
  t.points *= 2;
  const Altitudes springs(t);
  const Mat3X f = springs.forces(t.points);
  EXPECT_LT(f.rowwise().sum().norm(), 1e-12 * f.norm());
  constexpr double h = 1e-6;
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    for (int k = 0; k < 3; ++k) {
      Mat3X right = t.points, left = t.points;
      right(k, v) += h;
      left(k, v) -= h;
      EXPECT_NEAR(f(k, v), -(springs.energy(right) - springs.energy(left)) / (2 * h), 1e-6 * f.norm());
    }
}

TEST(AltitudeForces, AreZeroWhereAllAltitudesAreLongEnough) {
  Triangles t = test::grid(3, test::flat);
  t.points *= 10;
  EXPECT_EQ(Altitudes(t).forces(t.points).norm(), 0);
}

TEST(AltitudeForces, GrowWithoutBoundAsAFaceLeansOutOfTheSurface) {
  // A face of unchanged shape, turned about an edge: its altitude across the surface goes to zero.
  double last = 0;
  for (const double turn : {0., 1., 1.4, 1.55}) {
    const auto t =
        test::triangles({{0, 0, 0}, {1, 0, 0}, {.5, .8 * std::cos(turn), .8 * std::sin(turn)}}, {{0, 1, 2}});
    const double now = Altitudes(t).forces(t.points).norm();
    EXPECT_GT(now, last);
    last = now;
  }
  EXPECT_GT(last, 30);
}

}  // namespace hooke::forces_test
