#include "hooke/flip_pass.h"

#include <gtest/gtest.h>

#include "flipping_scene.h"

namespace hooke {
namespace {

double spring_energy(const test::FlippingScene& s) {
  const Connectivity c = make_connectivity(static_cast<int>(s.vertex_length.size()), s.triangulation.faces());
  const TargetLengths targets = spread_target_lengths(c, s.vertex_length);
  return Energy(c, targets, {})(s.placement, nullptr);
}

TEST(FlipPass, EveryFlipKeptLowersTheEnergyByItsGain) {
  test::FlippingScene s(test::sphere(3, .4, 5), test::unit_sphere());
  flip_to_delaunay(s.mesh, {});
  const double before = spring_energy(s);
  const FlipPassOptions options{.gain = 1e-3};
  const int flips = flip_irregular_edges(s.mesh, {}, options, {}, {});
  EXPECT_GT(flips, 10);
  EXPECT_LE(spring_energy(s), before - flips * options.gain);
  for (const Triangle& f : s.triangulation.faces())
    EXPECT_GE(face_alignment(s.placement.points, s.placement.normals, f), .3);
}

TEST(FlipPass, ARegularMeshHasNothingToFlip) {
  test::FlippingScene s(test::grid(6, test::flat), test::plane());
  for (int v : {0, 6, 42, 48}) s.corner_valences[static_cast<size_t>(v)] = s.triangulation.valence(v);
  EXPECT_EQ(flip_irregular_edges(s.mesh, {}, {}, {}, {}), 0);
}

TEST(FlipPass, KeepsTheBoundary) {
  const test::Triangles t = test::grid(8, test::flat, .4, 3);
  test::FlippingScene s(t, test::plane());
  flip_to_delaunay(s.mesh, {});
  flip_irregular_edges(s.mesh, {}, {}, {}, {});
  const int n = static_cast<int>(t.points.cols());
  EXPECT_EQ(test::boundary_edges(n, s.triangulation.faces()), test::boundary_edges(n, t.faces));
  EXPECT_NEAR(total_area(s.placement.points, s.triangulation.faces()), 1, 1e-12);
}

}  // namespace
}  // namespace hooke
