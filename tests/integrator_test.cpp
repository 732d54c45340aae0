#include "hooke/integrator.h"

#include <gtest/gtest.h>

#include <set>

#include "scene.h"

namespace hooke {
namespace {

IntegrationOptions rest(double drop, int window) {
  IntegrationOptions options;
  options.energy_drop = drop;
  options.window = window;
  return options;
}

TEST(RestDetector, IsNotAtRestBeforeTheWindowIsFull) {
  RestDetector detector(rest(1e-3, 3));
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(detector.at_rest(1));
  EXPECT_TRUE(detector.at_rest(1));
}

TEST(RestDetector, MeasuresTheDropOverTheWindow) {
  RestDetector fast(rest(1e-3, 2)), slow(rest(1e-3, 2));
  double energy = 1;
  for (int i = 0; i < 20; ++i, energy *= 1 - 1e-3) EXPECT_FALSE(fast.at_rest(energy)) << i;
  energy = 1;
  slow.at_rest(energy);
  slow.at_rest(energy *= 1 - 4e-4);
  EXPECT_TRUE(slow.at_rest(energy *= 1 - 4e-4));
}

TEST(RestDetector, DoesNotDependOnTheUnitOfTheEnergy) {
  RestDetector one(rest(1e-2, 3)), other(rest(1e-2, 3));
  double energy = 1;
  for (int i = 0; i < 30; ++i, energy *= 1 - .01 / (1 + i))
    EXPECT_EQ(one.at_rest(energy), other.at_rest(1024 * energy)) << i;
}

TEST(RestDetector, ZeroEnergyIsRest) {
  RestDetector detector(rest(1e-3, 1));
  detector.at_rest(0);
  EXPECT_TRUE(detector.at_rest(0));
}

TEST(CapDisplacement, ShortensWhatIsTooLongAndNothingElse) {
  const Mat3X u = test::random_vectors(5000, 1);
  std::vector<double> length(5000);
  for (size_t v = 0; v < length.size(); ++v) length[v] = .2 + 1e-4 * static_cast<double>(v);
  Mat3X capped = u;
  cap_displacement(length, 1.5, capped);
  int shortened = 0;
  for (Eigen::Index v = 0; v < u.cols(); ++v) {
    const double cap = 1.5 * length[static_cast<size_t>(v)];
    if (u.col(v).norm() <= cap) {
      EXPECT_EQ(capped.col(v), u.col(v));
      continue;
    }
    ++shortened;
    EXPECT_NEAR(capped.col(v).norm(), cap, 1e-14);
    EXPECT_LT(capped.col(v).cross(u.col(v)).norm(), 1e-14);
    EXPECT_GT(capped.col(v).dot(u.col(v)), 0);
  }
  EXPECT_GT(shortened, 1000);
}

TEST(Colours, OfOneClassAreNotSeenFromEachOtherAndEveryVertexHasOne) {
  for (const test::Triangles& t : {test::sphere(3), test::grid(9, test::flat), test::tetrahedron()}) {
    const Connectivity c = test::connect(t);
    std::vector<int> colour(static_cast<size_t>(c.vertex_count), -1);
    const auto classes = colour_vertices(c);
    for (size_t k = 0; k < classes.size(); ++k)
      for (int v : classes[k]) {
        EXPECT_EQ(colour[static_cast<size_t>(v)], -1);
        colour[static_cast<size_t>(v)] = static_cast<int>(k);
      }
    for (int k : colour) EXPECT_GE(k, 0);
    for (const auto& [a, b] : c.edges)
      EXPECT_NE(colour[static_cast<size_t>(a)], colour[static_cast<size_t>(b)]);
    for (size_t e = 0; e < c.edges.size(); ++e) {  // the fold guard looks across
      if (c.is_boundary_edge(static_cast<int>(e))) continue;
      std::set<int> corners, classes_there;
      for (int f : c.edge_faces[e])
        for (int v : c.faces[static_cast<size_t>(f)]) corners.insert(v);
      for (int v : corners) classes_there.insert(colour[static_cast<size_t>(v)]);
      EXPECT_EQ(classes_there.size(), corners.size());
    }
  }
}

}  // namespace
}  // namespace hooke
