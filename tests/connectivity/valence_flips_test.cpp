#include "hooke/connectivity/valence_flips.h"

#include <gtest/gtest.h>

#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/target_lengths.h"
#include "support/working_scene.h"

namespace hooke::valence_flips_test {

double spring_energy(const test::WorkingScene& s, const EnergyTerms& terms = {}) {
  const Adjacency c = make_adjacency(static_cast<int>(s.vertices.vertex_length.size()), s.halfedges.faces());
  const TargetLengths targets = spread_target_lengths(c, s.vertices.vertex_length);
  return Energy(c, targets, terms)(s.positions.points, s.positions.normals, nullptr);
}

/// A pass over all edges.
int flip_all(test::WorkingScene& s, const FlipPassOptions& options = {}) {
  std::vector<char> near;
  return flip_irregular_edges(s.mesh, {}, options, {}, near, nullptr);
}

/// Minimum cosine between two neighbouring faces.
double min_fold(const test::WorkingScene& s) {
  const Adjacency c = make_adjacency(static_cast<int>(s.vertices.vertex_length.size()), s.halfedges.faces());
  double least = 1;
  for (const auto& [f, g] : c.edge_faces)
    if (g >= 0) least = std::min(least, cosine_between(s.positions.points, c.faces[f], c.faces[g]));
  return least;
}

TEST(FlipPass, EveryFlipKeptLowersTheEnergyByItsGain) {
  test::WorkingScene s(test::sphere(3, .4, 5), test::unit_sphere());
  flip_to_delaunay(s.mesh);
  const double before = spring_energy(s);
  const FlipPassOptions options{.gain = 1e-3};
  const int flips = flip_all(s, options);
  EXPECT_GT(flips, 10);
  EXPECT_LE(spring_energy(s), before - flips * options.gain);
  for (const Triangle& f : s.halfedges.faces())
    EXPECT_GE(face_alignment(s.positions.points, s.positions.normals, f), .3);
  EXPECT_GE(min_fold(s), .1);
}

TEST(FlipPass, HopeLosesHardlyAnyGain) {
  for (double altitude : {0., 1., 10.}) {
    const auto gain = [altitude](const FlipPassOptions& options) {
      test::WorkingScene s(test::sphere(4, .4, 7), test::unit_sphere());
      flip_to_delaunay(s.mesh);
      const EnergyTerms terms{.altitude = altitude};
      const double before = spring_energy(s, terms);
      std::vector<char> near;
      flip_irregular_edges(s.mesh, terms, options, {}, near, nullptr);
      return before - spring_energy(s, terms);
    };
    const double all = gain({.rounds = 1, .max_energy_rise = 1e9, .max_rise_after_relaxation = 1e9});
    EXPECT_GT(gain({.rounds = 1}), .95 * all) << altitude;
    EXPECT_LT(gain({.rounds = 1, .max_energy_rise = -1e9}), 1e-9 * all) << altitude;
  }
}

TEST(FlipPass, LooksOnlyWhereThereIsSomethingNew) {
  test::WorkingScene s(test::sphere(3, .4, 5), test::unit_sphere());
  flip_to_delaunay(s.mesh);
  const std::vector<Triangle> faces = s.halfedges.faces();
  std::vector<char> near(s.vertices.vertex_length.size(), 0);
  EXPECT_EQ(flip_irregular_edges(s.mesh, {}, {}, {}, near, nullptr), 0);
  EXPECT_EQ(s.halfedges.faces(), faces);
  near.clear();
  EXPECT_GT(flip_irregular_edges(s.mesh, {}, {.rounds = 1}, {}, near, nullptr), 0);
  EXPECT_EQ(near.size(), s.vertices.vertex_length.size());
  EXPECT_GT(std::ranges::count(near, 1), 0);
}

TEST(FlipPass, NoEdgeIsTriedAmongTooManyVertices) {
  test::WorkingScene s(test::sphere(3, .4, 5), test::unit_sphere());
  flip_to_delaunay(s.mesh);
  EXPECT_EQ(flip_all(s, {.max_vertices = 8}), 0);  // two rings have more
}

TEST(FlipPass, ThreadsChangeNothing) {
  const auto result = [](int threads) {
    const ThreadLimit limit(threads);
    test::WorkingScene s(test::sphere(4, .4, 3), test::unit_sphere());
    flip_to_delaunay(s.mesh);
    EXPECT_GT(flip_all(s), 10);
    return std::pair(s.halfedges.faces(), s.positions.points);
  };
  const auto one = result(1), two = result(2);
  EXPECT_EQ(one.first, two.first);
  EXPECT_EQ(one.second, two.second);
}

TEST(FlipPass, StopsWithAValidMeshWhenTheObserverSaysSo) {
  test::WorkingScene s(test::sphere(4, .4, 3), test::unit_sphere());
  flip_to_delaunay(s.mesh);
  const double before = spring_energy(s);
  std::vector<char> near;
  int calls = 0;
  const int flips =
      flip_irregular_edges(s.mesh, {}, {}, {}, near, [&](const Progress&) { return ++calls < 3; });
  EXPECT_EQ(calls, 3);
  EXPECT_GT(flips, 0);
  EXPECT_LT(spring_energy(s), before);
}

TEST(FlipPass, ARegularMeshHasNothingToFlip) {
  test::WorkingScene s(test::grid(6, test::flat), test::plane());
  for (int v : {0, 6, 42, 48}) s.vertices.corner_valences[v] = s.halfedges.valence(v);
  EXPECT_EQ(flip_all(s), 0);
}

TEST(FlipPass, KeepsTheBoundary) {
  const test::Triangles t = test::grid(8, test::flat, .4, 3);
  test::WorkingScene s(t, test::plane());
  flip_to_delaunay(s.mesh);
  EXPECT_GT(flip_all(s), 0);
  const int n = static_cast<int>(t.points.cols());
  EXPECT_EQ(test::boundary_edges(n, s.halfedges.faces()), test::boundary_edges(n, t.faces));
  EXPECT_NEAR(total_area(s.positions.points, s.halfedges.faces()), 1, 1e-12);
}

}  // namespace hooke::valence_flips_test
