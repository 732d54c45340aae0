#include "hooke/remesh/walls.h"

#include <gtest/gtest.h>

#include <optional>

#include "hooke/mesh/mesh.h"
#include "hooke/remesh/preserving_remesh.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::walls_test {

constexpr double wall = .4;

RemeshResult adapted(double length, std::optional<double> max_distance = {}) {
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  options.effort = Effort::fast;
  const test::Triangles pipe = test::turned({{10, 0}, {10 + wall, 0}, {10 + wall, 8}, {10, 8}}, 96);
  TriMesh mesh = test::with_length(pipe, length);
  return preserving_remesh(mesh, find_memory_order(mesh), options,
                           {.max_distance = max_distance, .faceted = true});
}

TEST(WallsOfRemeshed, KeepTheirThicknessWhereChordsWouldCrossThem) {
  constexpr double length = 4.5;  // with chords of .2
  const RemeshResult shorter = adapted(length);
  EXPECT_EQ(shorter.left_walls, 0);
  EXPECT_LT(shorter.measures->deviation.from_reference.max, .25 * wall);
  EXPECT_GT(shorter.shortened, 0);
}

TEST(WallsOfRemeshed, AreNotedWhereTheyAreLeft) {
  const RemeshResult left = adapted(4.5, 1);  // which asks for no more than that
  EXPECT_GT(left.left_walls, 10);
  EXPECT_NEAR(left.thickness, wall, .1 * wall);
  EXPECT_GT(left.lost_thickness, .25 * wall);
  EXPECT_NEAR(left.thin_place.head<2>().norm(), 10 + wall / 2, wall);
  EXPECT_EQ(adapted(1, 1).left_walls, 0);
}

}  // namespace hooke::walls_test
