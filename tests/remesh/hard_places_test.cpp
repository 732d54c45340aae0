// Meshes that optimizers like to break: what must hold for them in every mode.
#include <gtest/gtest.h>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/options.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::hard_places_test {

test::Triangles stretched(test::Triangles t, const Vec3& factors) {
  t.points = (factors.asDiagonal() * t.points).eval();
  return t;
}

/// Both sides of a lens are much closer to each other than an edge is long.
test::Triangles thin_sheets() {
  return stretched(test::sphere(3, .3, 2), {1, 1, .06});
}

test::Triangles needle() {
  return stretched(test::sphere(3, .25, 3), {4, .4, .4});
}

/// Every tenth face is split at its centre: valence 3 there.
test::Triangles valence_three() {
  test::Triangles t = test::grid(10, test::paraboloid, .2, 5);
  test::split_at_centres(t, 0, 10);
  return t;
}

/// Triangles on single boundary edges.
test::Triangles ears() {
  test::Triangles t = test::grid(8, test::flat, .2, 5);
  for (int i = 1; i < 7; i += 2) {
    const int v = static_cast<int>(t.points.cols());
    t.points.conservativeResize(3, v + 1);
    t.points.col(v) = .5 * (t.points.col(i) + t.points.col(i + 1)) - Vec3(0, .12, 0);
    t.faces.push_back({i + 1, i, v});
  }
  return t;
}

/// Two spheres that pass through each other.
test::Triangles crossing_spheres() {
  test::Triangles moved = test::sphere(2, .25, 7);
  moved.points.row(0).array() += 1.2;
  return test::both(test::sphere(2, .25, 6), moved);
}

/// A grid without some of its squares.
test::Triangles many_holes() {
  test::Triangles t = test::grid(16, test::paraboloid, .25, 8);
  std::vector<Triangle> faces;
  for (size_t f = 0; f < t.faces.size(); ++f) {
    const size_t x = f / 2 % 16, y = f / 2 / 16;
    if (x % 4 != 2 || y % 4 != 2) faces.push_back(t.faces[f]);
  }
  t.faces = std::move(faces);
  return t;
}

struct Place {
  const char* name;
  test::Triangles (*mesh)();
};

void PrintTo(const Place& place, std::ostream* out) {
  *out << place.name;
}

Quality quality_of(const TriMesh& mesh) {
  const Mat3X points = vertex_points(mesh);
  return measure_quality(points, make_adjacency(static_cast<int>(points.cols()), triangles_of(mesh)), {});
}

class HardPlaces : public testing::TestWithParam<std::tuple<Place, ConnectivityMode>> {
 protected:
  test::Triangles input_ = std::get<Place>(GetParam()).mesh();
  ConnectivityMode mode_ = std::get<ConnectivityMode>(GetParam());
};

TEST_P(HardPlaces, GetBetterAndLoseNothing) {
  RemeshOptions options;
  options.connectivity = mode_;
  options.effort = Effort::standard;
  const test::Outcome o = test::remeshed(input_, options);
  const Quality before = quality_of(test::to_mesh(input_)), after = quality_of(o.mesh);
  EXPECT_GE(after.min_angle.min, before.min_angle.min);
  // The normals of the lens reverse within less than an edge length: edges along its equator fold, and other
  // edges may replace them.
  EXPECT_LE(after.folded_edges, 2 * before.folded_edges);
  EXPECT_EQ(after.degenerate_faces, 0u);
  EXPECT_EQ(after.topology.components, before.topology.components);
  EXPECT_EQ(after.topology.boundary_loops, before.topology.boundary_loops);
  EXPECT_EQ(after.topology.euler, before.topology.euler);
  if (before.self_intersections == 0u) {
    EXPECT_EQ(after.self_intersections, 0u);
  } else {  // spheres that cross go on to cross along the same curve
    EXPECT_LT(*after.self_intersections, 2 * *before.self_intersections);
  }
  EXPECT_NEAR(after.extent.area, before.extent.area, .05 * before.extent.area);
}

/// At the equator of a coarse lens the normals reverse within an edge, and springs leave slivers.
TEST(HardPlaces, OtherEdgesRemoveTheSliversThatSpringsLeave) {
  for (const ConnectivityMode mode : {ConnectivityMode::flip, ConnectivityMode::adapt}) {
    double gain = 0;
    for (unsigned seed : {1, 2}) {
      const test::Triangles lens = stretched(test::sphere(2, .4, seed), {1, 1, .12});
      RemeshOptions options;
      options.connectivity = mode;
      options.effort = Effort::standard;
      RunOptions without_removal(options);
      without_removal.slivers.rounds = 0;
      const Quality improved = quality_of(test::remeshed(lens, options).mesh);
      const Quality left = quality_of(test::remeshed(lens, without_removal).mesh);
      EXPECT_GE(improved.min_angle.min, left.min_angle.min - 1e-9) << seed;
      EXPECT_LE(improved.folded_edges, left.folded_edges) << seed;
      EXPECT_EQ(improved.topology.euler, left.topology.euler) << seed;
      if (mode == ConnectivityMode::flip) {
        EXPECT_EQ(improved.topology.faces, left.topology.faces) << seed;
      }
      gain += improved.min_angle.min - left.min_angle.min;
    }
    EXPECT_GT(gain, 5);
  }
}

TEST(HardPlaces, SliverRemovalIsTheSameForAnyNumberOfThreadsAndStopsWhenAsked) {
  const test::Triangles lens = stretched(test::sphere(2, .4, 1), {1, 1, .12});
  for (const ConnectivityMode mode : {ConnectivityMode::flip, ConnectivityMode::adapt}) {
    RemeshOptions options;
    options.connectivity = mode;
    options.effort = Effort::standard;
    RunOptions with_one_angle(options);
    with_one_angle.slivers.sliver_angles = {33};
    int slivers = 0;
    const auto run = [&](int threads, int stop_at) {
      const ThreadLimit limit(threads);
      slivers = 0;
      return test::remeshed(lens, test::natural(lens), with_one_angle, [&](const Progress& p) {
        slivers += std::string_view(p.stage) == "mend";
        return slivers < stop_at;
      });
    };
    const test::Outcome one = run(1, 1000), two = run(2, 1000);
    ASSERT_GT(slivers, 2);
    EXPECT_EQ(one.points, two.points);
    EXPECT_EQ(one.faces, two.faces);
    const test::Outcome stopped = run(2, 2);
    EXPECT_EQ(slivers, 2);
    EXPECT_EQ(stopped.result.reason, StopReason::interrupted);
    EXPECT_EQ(quality_of(stopped.mesh).topology.euler, 2);
  }
}

std::string name_of(const testing::TestParamInfo<HardPlaces::ParamType>& info) {
  const ConnectivityMode mode = std::get<ConnectivityMode>(info.param);
  return std::string(std::get<Place>(info.param).name) + (mode == ConnectivityMode::fixed  ? "_fixed"
                                                          : mode == ConnectivityMode::flip ? "_flip"
                                                                                           : "_adapt");
}

INSTANTIATE_TEST_SUITE_P(
    All, HardPlaces,
    testing::Combine(testing::Values(Place{"thin_sheets", thin_sheets}, Place{"needle", needle},
                                     Place{"valence_three", valence_three}, Place{"ears", ears},
                                     Place{"crossing_spheres", crossing_spheres},
                                     Place{"torus", [] { return test::torus(24, 10, .3); }},
                                     Place{"many_holes", many_holes}),
                     testing::Values(ConnectivityMode::fixed, ConnectivityMode::flip,
                                     ConnectivityMode::adapt)),
    name_of);

}  // namespace hooke::hard_places_test
