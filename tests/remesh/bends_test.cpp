#include "hooke/remesh/bends.h"

#include <gtest/gtest.h>

#include "hooke/mesh/mesh.h"
#include "hooke/remesh/preserving_remesh.h"
#include "support/crease_solids.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::bends_test {

RemeshResult adapted(const test::Triangles& t, double length) {
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  options.effort = Effort::fast;
  TriMesh mesh = test::with_length(t, length);
  return preserving_remesh(mesh, find_memory_order(mesh), options, {});
}

TEST(BendsOfRemeshed, AreSharpWhereATubeHasFiveSides) {
  EXPECT_EQ(adapted(test::torus(60, 24, 0), .2).sharp_bends, 0);
  const RemeshResult coarse = adapted(test::torus(60, 24, 0), .5);
  EXPECT_GT(coarse.sharp_bends, 5);
  EXPECT_GT(coarse.sharpest_bend, 60);
  EXPECT_LT(coarse.sharpest_bend, 120);
  EXPECT_NEAR(coarse.sharpest_place.norm(), 1, .5);
}

TEST(BendsOfRemeshed, AreNoneAtCreasesOfTheInput) {
  EXPECT_EQ(adapted(test::irregular_cube(5), .2).sharp_bends, 0);
}

}  // namespace hooke::bends_test
