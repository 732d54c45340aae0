#include "hooke/remesh/restarts.h"

#include <gtest/gtest.h>

#include <string_view>

#include "hooke/core/parallel.h"
#include "hooke/geometry/self_intersection.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/deviation.h"
#include "hooke/remesh/options.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::restarts_test {

/// A coarse sheet closed on both sides, thinner than its edges are long.
test::Triangles lens(unsigned seed) {
  test::Triangles t = test::sphere(1, .4, seed);
  t.points.row(2) *= .12;
  return t;
}

RemeshOptions options_for(ConnectivityMode mode) {
  RemeshOptions options;
  options.connectivity = mode;
  set_effort(options, Effort::standard);
  options.slivers.pass.sliver_angles = {30};  // makes each restart fast
  options.slivers.pass.rounds = options.slivers.passes = 1;
  return options;
}

test::Outcome remeshed(const test::Triangles& t, const RemeshOptions& options, const RestartOptions& restarts,
                       const Observer& observer = nullptr) {
  test::Outcome o;
  o.mesh = test::with_length(t, test::natural(t));
  const MemoryOrder memory_order = find_memory_order(o.mesh);
  o.result = remesh_with_restarts(o.mesh, memory_order, options, restarts, {}, observer);
  o.points = vertex_points(o.mesh);
  o.faces = triangles_of(o.mesh);
  return o;
}

/// The criteria for comparing restarts: number of flipped faces and crossings, and minimum angle.
std::pair<std::size_t, double> judged(const test::Triangles& before, const test::Outcome& after) {
  const auto adjacency = [](const Mat3X& points, const std::vector<Triangle>& faces) {
    return make_adjacency(static_cast<int>(points.cols()), faces);
  };
  const Deviation deviation = measure_deviation(before.points, adjacency(before.points, before.faces),
                                                after.points, adjacency(after.points, after.faces));
  return {deviation.flipped_faces.size() + find_self_intersections(after.points, after.faces).size(),
          min_angle(after.points, after.faces)};
}

TEST(Restarts, TheBestIsNoWorseThanTheFirstAndSomeAreBetter) {
  int better = 0;
  for (const ConnectivityMode mode : {ConnectivityMode::flip, ConnectivityMode::adapt})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const test::Triangles t = lens(seed);
      const RemeshOptions options = options_for(mode);
      const test::Outcome first = test::remeshed(t, options), best = remeshed(t, options, {.max_runs = 4});
      const auto [first_flaws, first_angle] = judged(t, first);
      const auto [best_flaws, best_angle] = judged(t, best);
      EXPECT_LE(best_flaws, first_flaws) << seed;
      if (best_flaws == first_flaws) {
        EXPECT_GE(best_angle, first_angle) << seed;
      }
      EXPECT_LE(best.result.restarts, 4);
      EXPECT_LE(best.result.kept_run, best.result.restarts);
      EXPECT_EQ(best.result.kept_run == 1, best.points == first.points);
      better += best_flaws < first_flaws || best_angle > first_angle;
    }
  EXPECT_GE(better, 2);
}

TEST(Restarts, AGoodResultIsTheFirst) {
  const test::Triangles t = test::sphere(2, .3, 1);
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt}) {
    const RemeshOptions options = options_for(mode);
    const test::Outcome once = test::remeshed(t, options), best = remeshed(t, options, {});
    EXPECT_EQ(best.result.restarts, 1);
    EXPECT_EQ(best.points, once.points);
    EXPECT_EQ(best.faces, once.faces);
  }
}

/// There are no further restarts for a corner that no connectivity can improve, when all results are equal,
/// or beyond the budget.
TEST(Restarts, ThereIsOneWhereMoreAreOfNoUse) {
  const test::Triangles sharp_corner =
      test::triangles({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {2, .25, 0}}, {{0, 1, 3}, {1, 2, 3}});
  EXPECT_EQ(remeshed(sharp_corner, options_for(ConnectivityMode::adapt), {}).result.restarts, 1);
  EXPECT_EQ(
      remeshed(test::sphere(3), options_for(ConnectivityMode::fixed), {.good_angle = 60}).result.restarts, 1);
  const RemeshOptions options = options_for(ConnectivityMode::adapt);
  const double faces = static_cast<double>(lens(1).faces.size());
  EXPECT_EQ(remeshed(lens(1), options, {.max_faces = 1.9 * faces, .good_angle = 60}).result.restarts, 1);
  EXPECT_EQ(remeshed(lens(1), options, {.max_faces = 2.5 * faces, .good_angle = 60}).result.restarts, 2);
  EXPECT_EQ(remeshed(lens(1), options, {.max_runs = 3, .good_angle = 60}).result.restarts, 3);
}

TEST(Restarts, AreTheSameForAnyNumberOfThreads) {
  const RemeshOptions options = options_for(ConnectivityMode::adapt);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return remeshed(lens(2), options, {.max_runs = 3, .good_angle = 60});
  };
  const test::Outcome one = run(1), two = run(2);
  EXPECT_EQ(one.result.restarts, 3);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.faces, two.faces);
}

TEST(Restarts, AnInterruptedOneCountsForNothing) {
  const test::Triangles t = lens(1);
  const RemeshOptions options = options_for(ConnectivityMode::adapt);
  int of_first = 0;
  const Observer count = [&](const Progress&) { return ++of_first > 0; };
  const test::Outcome first = remeshed(t, options, {.max_runs = 1}, count);
  for (int more : {1, of_first / 2}) {
    int calls = 0;
    const test::Outcome stopped =
        remeshed(t, options, {.good_angle = 60}, [&](const Progress&) { return ++calls < of_first + more; });
    EXPECT_EQ(stopped.result.reason, StopReason::interrupted);
    EXPECT_EQ(stopped.result.restarts, 1);
    EXPECT_EQ(stopped.points, first.points);
    EXPECT_EQ(stopped.faces, first.faces);
    EXPECT_LE(calls, of_first + more);
  }
  int calls = 0;
  const test::Outcome early =
      remeshed(t, options, {}, [&](const Progress&) { return ++calls < of_first / 2; });
  EXPECT_EQ(early.result.reason, StopReason::interrupted);
  EXPECT_EQ(early.result.restarts, 1);
}

}  // namespace hooke::restarts_test
