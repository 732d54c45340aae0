#include "hooke/remesh/preserving_remesh.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/geometry/aabb_tree.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/mirror.h"
#include "hooke/mesh/normals.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/options.h"
#include "support/crease_solids.h"
#include "support/junction_sheets.h"
#include "support/masks.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::preserving_remesh_test {

/// A coarse sheet closed on both sides, thinner than its edges are long.
test::Triangles lens(unsigned seed) {
  test::Triangles t = test::sphere(1, .4, seed);
  t.points.row(2) *= .12;
  return t;
}

RemeshOptions options_for(ConnectivityMode mode) {
  RemeshOptions options;
  options.connectivity = mode;
  options.effort = Effort::fast;
  return options;
}

test::Outcome preserved(const test::Triangles& t, const RemeshOptions& options,
                        const Observer& observer = nullptr, const PreservationOptions& preservation = {}) {
  test::Outcome o;
  o.mesh = test::with_length(t, test::natural(t));
  const MemoryOrder memory_order = find_memory_order(o.mesh);
  o.result = preserving_remesh(o.mesh, memory_order, options, preservation, {}, observer);
  o.points = vertex_points(o.mesh);
  o.faces = triangles_of(o.mesh);
  return o;
}

TEST(PreservingRemesh, LeavesAGoodResultAsItIs) {
  const test::Triangles t = test::sphere(2, .3, 1);
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt}) {
    const RemeshOptions options = options_for(mode);
    const test::Outcome once = test::remeshed(t, options), kept = preserved(t, options);
    EXPECT_EQ(kept.result.rescue, Rescue::none);
    EXPECT_TRUE(kept.result.measures->preservation.holds());
    EXPECT_EQ(kept.points, once.points);
    EXPECT_EQ(kept.faces, once.faces);
  }
}

TEST(PreservingRemesh, PointsThatAreRoundedAreJudgedAsTheyAre) {
  test::Triangles t = test::sphere(2, .3, 1);
  t.points = rounded_to_floats(t.points.colwise() + Vec3(2e5, 1e5, 1e5));
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt}) {
    const test::Outcome o = preserved(t, options_for(mode), nullptr, {.has_float_points = true});
    const ResultMeasures& m = *o.result.measures;
    EXPECT_EQ(m.preservation.flaws(), 0);
    EXPECT_NEAR(m.quality.min_angle.min, min_angle(o.points, o.faces), 1e-9);
    EXPECT_GT(m.quality.min_angle.min, 45);
    for (const double x : o.points.reshaped()) EXPECT_EQ(x, std::stof(fmt::format("{:.17g}", x)));
  }
}

TEST(PreservingRemesh, RoundingOfWhatStandsStillPutsNothingBack) {
  for (const double offset : {10., 100., 1000.}) {
    test::Triangles t = test::grid(8, test::flat);
    t.points.colwise() += Vec3(offset, .1, .1);
    t.points.col(t.faces[40][0]) = .9 * t.points.col(t.faces[40][1]) + .1 * t.points.col(t.faces[40][2]);
    t.points(1, t.faces[40][0]) += .01 / 3;
    RemeshOptions options = options_for(ConnectivityMode::fixed);
    options.constraints.fixed_vertices = {t.faces[40].begin(), t.faces[40].end()};
    const test::Outcome o = preserved(t, options, nullptr, {.has_float_points = true});
    EXPECT_EQ(o.result.rescue, Rescue::none) << offset;
    EXPECT_TRUE(o.result.measures->preservation.holds());
  }
}

TEST(PreservingRemesh, TheStepsOfAMaskAreNoEdges) {
  test::Triangles t =
      test::marched_mask(7, [](const Vec3& x) { return (x - Vec3(.3, .2, .1)).norm() < 5.5; });
  t.points.row(2) *= 1.5;
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt}) {
    RemeshOptions options = options_for(mode);
    const test::Outcome o = preserved(test::moved(t), options);
    const ResultMeasures& m = *o.result.measures;
    EXPECT_EQ(o.result.steps, MaskSteps::smoothed);
    EXPECT_TRUE(m.preservation.holds());
    EXPECT_GT(m.quality.min_angle.min, mode == ConnectivityMode::fixed ? 22 : 35);
    EXPECT_GT(m.quality.min_angle.min, 1.3 * m.input_quality.min_angle.min);
    EXPECT_LT(std::max(m.deviation.to_reference.max, m.deviation.from_reference.max), 1) << "cell";
    EXPECT_NEAR(m.deviation.volume_change.value(), 0, .01);
    options.constraints.features.drops_noise = false;
    EXPECT_EQ(preserved(t, options).result.steps, MaskSteps::none);
  }
}

TEST(PreservingRemesh, StepsThatTheLengthResolvesAreKeptUnlessAnglesAreOff) {
  const test::Triangles t = test::marched_mask(5, [](const Vec3& x) { return x.norm() < 3.7; });
  for (const double angle : {40., 180.}) {
    RemeshOptions options = options_for(ConnectivityMode::adapt);
    options.constraints.features.angle = angle;
    TriMesh mesh = test::with_length(t, .6 * test::natural(t));
    const MemoryOrder memory_order = find_memory_order(mesh);
    const RemeshResult result = preserving_remesh(mesh, memory_order, options, {}, {});
    EXPECT_EQ(result.steps, angle < 180 ? MaskSteps::resolved : MaskSteps::smoothed);
  }
}

TEST(PreservingRemesh, TheBevelsThatMarchingCubesMakeOfEdgesLeaveNoSlivers) {
  const test::Triangles box =
      test::marched_cubes(8, [](const Vec3& x) { return (x.cwiseAbs() - Vec3(6.3, 5.6, 4.2)).maxCoeff(); });
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt}) {
    const test::Outcome o = preserved(box, options_for(mode));
    const ResultMeasures& m = *o.result.measures;
    EXPECT_TRUE(m.preservation.holds());
    EXPECT_LT(m.input_quality.min_angle.min, 20);
    EXPECT_GT(m.quality.min_angle.min, mode == ConnectivityMode::fixed ? 25 : 38);
    EXPECT_LT(std::max(m.deviation.to_reference.max, m.deviation.from_reference.max), .6) << "cells";
    EXPECT_NEAR(m.deviation.volume_change.value(), 0, .01);
    EXPECT_GT(o.result.creases.dropped, 0);
  }
}

TEST(PreservingRemesh, AMarchedSurfaceWithSharpPlacesIsImproved) {
  const test::Triangles t = test::marched_level(9, [](const Vec3& x) {
    return std::min((x - Vec3(2.3, .2, .1)).norm() - 5.2, (x + Vec3(2.9, .3, .2)).norm() - 5.4);
  });
  for (const ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    const test::Outcome o = preserved(t, options_for(mode));
    const ResultMeasures& m = *o.result.measures;
    EXPECT_TRUE(m.preservation.holds());
    EXPECT_LT(20 * m.quality.faces_below_20, m.input_quality.faces_below_20);
    EXPECT_GT(m.quality.shape.mean, m.input_quality.shape.mean + .2);
  }
}

TEST(PreservingRemesh, BodiesThatCrossAreAsGoodAsEachAlone) {
  const test::Triangles one = test::sphere(2, .3, 1);
  const auto n = static_cast<int>(one.points.cols());
  test::Triangles two = one;
  two.points.conservativeResize(3, 2 * n);
  two.points.rightCols(n) = one.points.colwise() + Vec3(.9, .5, .2);
  for (const Triangle& t : one.faces) two.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt}) {
    const test::Outcome alone = preserved(one, options_for(mode)), both = preserved(two, options_for(mode));
    EXPECT_EQ(both.result.rescue, Rescue::none);
    EXPECT_TRUE(both.result.measures->preservation.holds());
    EXPECT_GT(both.result.measures->quality.min_angle.min, alone.result.measures->quality.min_angle.min - 3);
  }
}

TEST(PreservingRemesh, GlobesBecomeRegular) {
  for (const auto& [meridians, bands] : {std::pair(24, 12), {20, 20}}) {
    const test::Triangles globe = test::globe(meridians, bands);
    RemeshOptions options;
    options.connectivity = ConnectivityMode::flip;
    const test::Outcome o = preserved(globe, options);
    EXPECT_EQ(o.result.rescue, Rescue::none);
    EXPECT_GT(o.result.measures->quality.min_angle.min, 40) << meridians;
  }
}

TEST(PreservingRemesh, FlipsDoNotMakeSmallAngles) {
  const test::Triangles stairs = test::cells(
      8, 8, 8, [](int x, int y, int z) { return x + y + z < 10; }, 0, 1);
  const test::Outcome o = preserved(stairs, options_for(ConnectivityMode::flip));
  EXPECT_GE(o.result.measures->quality.min_angle.min,
            std::min(25., .999 * o.result.measures->input_quality.min_angle.min));
}

/// Folds that are creases are no reason for small angles: they do not go away.
TEST(PreservingRemesh, AnglesDoNotGetSmallerBesideABlade) {
  test::Triangles blade = test::cells(
      4, 4, 2, [](int, int, int) { return true; }, 0);
  blade.points.row(0) += 1.5 * blade.points.row(2);
  blade.points.colwise() += Vec3(10, 0, 0);
  ASSERT_FALSE(sharp_edges(blade.points, test::connect(blade), 91).empty());
  for (const test::Triangles& globe : {test::globe(64, 16), test::globe(20, 20)}) {
    const test::Outcome o = preserved(test::both(globe, blade), options_for(ConnectivityMode::fixed), nullptr,
                                      {.max_distance = 1e-3});
    EXPECT_NE(o.result.rescue, Rescue::none);
    EXPECT_GE(o.result.measures->quality.min_angle.min,
              (1 - 1e-9) * o.result.measures->input_quality.min_angle.min);
  }
}

/// Unfolding costs angles where the folds are, not where vertices are put back elsewhere.
TEST(PreservingRemesh, AnglesDoNotGetSmallerFarFromFoldsThatGo) {
  test::Triangles folded = test::grid(8, [](double, double) { return 0.; });
  const double cell = (folded.points.col(1) - folded.points.col(0)).norm();
  folded.points.col(40) += Vec3(1.6, .16, 0) * cell;  // over the next edges
  folded.points *= .3 / cell;
  folded.points.colwise() += Vec3(10, 0, 0);
  const size_t folds = sharp_edges(folded.points, test::connect(folded), 91).size();
  ASSERT_GT(folds, 0u);
  RemeshOptions options = options_for(ConnectivityMode::fixed);
  options.effort = Effort::standard;
  options.constraints.features.angle = 180;
  for (const test::Triangles& globe : {test::globe(64, 16), test::globe(20, 20)}) {
    const test::Outcome o =
        preserved(test::both(globe, folded), options, nullptr, {.max_distance = 1e-3, .feature_angle = 180});
    EXPECT_NE(o.result.rescue, Rescue::none);
    EXPECT_LT(o.result.measures->quality.folded_edges, folds);
    const std::vector<Triangle> faces(o.faces.begin(), o.faces.begin() + std::ssize(globe.faces));
    EXPECT_GE(min_angle(o.points, faces), (1 - 1e-9) * min_angle(globe.points, globe.faces));
  }
}

TEST(PreservingRemesh, FacesThatStayDoNotGetSmallerAnglesWhereTheyGoBack) {
  int rescued = 0;
  for (const test::Triangles& t : {test::globe(64, 16), test::globe(20, 20)})
    for (const double max_distance : {1e-3, 1e-2}) {
      const test::Outcome o =
          preserved(t, options_for(ConnectivityMode::fixed), nullptr, {.max_distance = max_distance});
      rescued += o.result.rescue != Rescue::none;
      EXPECT_TRUE(o.result.measures->preservation.holds());
      EXPECT_GE(o.result.measures->quality.min_angle.min,
                (1 - 1e-9) * o.result.measures->input_quality.min_angle.min)
          << max_distance;
    }
  EXPECT_GT(rescued, 0);
}

TEST(PreservingRemesh, KeepsWhatOneRunMayNot) {
  int mended = 0;
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt})
    for (unsigned seed = 1; seed <= 6; ++seed) {
      const test::Triangles t = lens(seed);
      const RemeshOptions options = options_for(mode);
      const test::Outcome first = test::remeshed(t, options), kept = preserved(t, options);
      if (mode != ConnectivityMode::adapt) {
        EXPECT_TRUE(kept.result.measures->preservation.holds()) << seed;
      }
      mended += kept.faces != first.faces || kept.points != first.points;
      EXPECT_NEAR(kept.result.measures->quality.min_angle.min, min_angle(kept.points, kept.faces), 1e-9);
    }
  EXPECT_GE(mended, 3);
}

/// A disc with a sharp rim, which edges as long as its radius cut through.
test::Triangles thin_disc() {
  test::Triangles disc = test::globe(24, 8);
  disc.points.row(2) *= .05;
  return disc;
}

TEST(PreservingRemesh, ShortensEdgesAtPartsTooThinForThem) {
  const test::Triangles disc = thin_disc();
  for (const double length : {.2, 1.5, 2.}) {
    test::Outcome o;
    o.mesh = test::with_length(disc, length);
    o.result = preserving_remesh(o.mesh, find_memory_order(o.mesh), options_for(ConnectivityMode::adapt));
    const std::vector<double> lengths = vertex_values(o.mesh, target_length_property);
    EXPECT_TRUE(o.result.measures->preservation.holds());
    EXPECT_EQ(o.result.shortened > 0, length > 1) << length;
    EXPECT_EQ(std::ranges::min(lengths) < length, length > 1) << length;
    EXPECT_LE(std::ranges::max(lengths), (1 + 1e-12) * length);
  }
}

/// Those of the vertices on the right of x, sorted.
std::vector<std::array<double, 3>> points_right_of(double x, const Mat3X& points) {
  std::vector<std::array<double, 3>> all;
  for (const auto& p : points.colwise())
    if (p[0] > x) all.push_back({p[0], p[1], p[2]});
  std::ranges::sort(all);
  return all;
}

TEST(PreservingRemesh, WhereABodyIsTooThinOthersStayAsTheyAre) {
  test::Triangles ball = test::sphere(3, .3, 1);
  ball.points = (4 * ball.points).colwise() + Vec3(10, 0, 0);
  const test::Triangles t = test::both(thin_disc(), ball);
  test::Outcome once, kept;
  const RemeshOptions options = options_for(ConnectivityMode::adapt);
  once.mesh = kept.mesh = test::with_length(t, 1.5);
  once.result = remesh(once.mesh, options);
  kept.result = preserving_remesh(kept.mesh, find_memory_order(kept.mesh), options);
  EXPECT_TRUE(kept.result.measures->preservation.holds());
  EXPECT_GT(kept.result.shortened, 0);
  EXPECT_NE(points_right_of(-5, vertex_points(kept.mesh)), points_right_of(-5, vertex_points(once.mesh)));
  EXPECT_EQ(points_right_of(5, vertex_points(kept.mesh)), points_right_of(5, vertex_points(once.mesh)));
  EXPECT_TRUE(kept.result.map.empty());  // which nobody asked for
  EXPECT_EQ(kept.result.adaptation.target_faces, once.result.adaptation.target_faces);
  EXPECT_EQ(kept.result.iterations.size(), once.result.iterations.size());
  EXPECT_EQ(kept.result.rescued_shells, kept.result.rescue == Rescue::none ? 0 : 1);
  EXPECT_EQ(kept.result.vertex_limits.size(), kept.mesh.n_vertices());
  EXPECT_EQ(kept.result.input_points, t.points);
}

TEST(PreservingRemesh, StoppedAtOneShellItKeepsWhatIsDoneOfOthers) {
  test::Triangles disc = thin_disc(), ball = test::sphere(3, .3, 1);
  disc.points.colwise() += Vec3(-10, 0, 0);
  ball.points = (4 * ball.points).colwise() + Vec3(10, 0, 0);
  const test::Triangles t = test::both(test::both(thin_disc(), disc), ball);
  int calls = 0, last_call = 0;
  const auto run = [&] {
    calls = 0;
    test::Outcome o;
    o.mesh = test::with_length(t, 1.5);
    o.result = preserving_remesh(o.mesh, find_memory_order(o.mesh), options_for(ConnectivityMode::adapt), {},
                                 {}, [&](const Progress&) { return ++calls != last_call; });
    o.points = vertex_points(o.mesh);
    return o;
  };
  const test::Outcome all = run();
  last_call = calls - 1;
  const test::Outcome some = run();
  EXPECT_EQ(some.result.reason, StopReason::interrupted);
  EXPECT_GT(some.result.shortened, 0);
  EXPECT_LT(some.result.shortened, all.result.shortened);
  EXPECT_EQ(points_right_of(-5, some.points), points_right_of(-5, all.points));
  EXPECT_NE(triangles_of(some.mesh), triangles_of(all.mesh));
}

/// Sheet metal of thickness 1, 40 and 27 wide, with a round bend.
test::Triangles bent_sheet() {
  constexpr int in_bend = 9;
  std::vector<std::array<double, 2>> outside = {{0, 0}}, inside = {{0, 1}};
  for (int i = 0; i < in_bend; ++i) {
    const double angle = std::numbers::pi / 2 * i / (in_bend - 1), s = std::sin(angle), c = std::cos(angle);
    outside.push_back({40 + 3 * s, 3 - 3 * c});
    inside.push_back({40 + 2 * s, 3 - 2 * c});
  }
  outside.push_back({43, 30});
  inside.push_back({42, 30});
  const int n = static_cast<int>(outside.size());
  test::Triangles t{Mat3X(3, 4 * n), {}};
  const auto quad = [&](int a, int b, int c, int d) {
    t.faces.insert(t.faces.end(), {{a, b, c}, {a, c, d}});
  };
  for (int i = 0; i < n; ++i)
    for (int side : {0, 1}) {
      t.points.col(2 * n * side + i) = Vec3(outside[i][0], outside[i][1], 25. * side);
      t.points.col(2 * n * side + n + i) = Vec3(inside[i][0], inside[i][1], 25. * side);
    }
  const int last = n - 1, far = 2 * n;  // indices: outside i, inside n + i, and far more on the other side
  for (int i = 0, j = 1; j < n; ++i, ++j) {
    quad(i, j, far + j, far + i);
    quad(n + j, n + i, far + n + i, far + n + j);
    quad(n + i, n + j, j, i);
    quad(far + i, far + j, far + n + j, far + n + i);
  }
  quad(n, 0, far, far + n);
  quad(last, n + last, far + n + last, far + last);
  return t;
}

TEST(PreservingRemesh, ShortensEdgesAgainWhereThatDoesNotHalveWhatIsWrongAtFirst) {
  for (const double length : {5., 10., 20.}) {
    test::Outcome o;
    o.mesh = test::with_length(bent_sheet(), length);
    o.result = preserving_remesh(o.mesh, find_memory_order(o.mesh), options_for(ConnectivityMode::adapt));
    EXPECT_TRUE(o.result.measures->preservation.holds()) << length;
    EXPECT_NE(o.result.rescue, Rescue::kept_faces) << length;
    EXPECT_LT(o.mesh.n_faces(), 4000) << length;
  }
}

/// A board with four rounded edges, of facets as long as it: edges longer than it is thick cut through it.
test::Triangles board_with_rounded_edges() {
  constexpr int steps = 8;                              // of a quarter round of radius 1
  std::vector<std::array<double, 2>> rings = {{0, 0}};  // height, and distance from the box around it
  for (int k = 0; k <= steps; ++k) {
    const double angle = .5 * std::numbers::pi * k / steps;
    rings.push_back({1 + std::sin(angle), 1 - std::cos(angle)});
  }
  test::Triangles t{Mat3X(3, 4 * std::ssize(rings)), {{0, 2, 1}, {0, 3, 2}}};
  for (int r = 0; r < std::ssize(rings); ++r) {
    const auto [height, inset] = rings[r];
    const double x[] = {inset, 70 - inset, 70 - inset, inset},
                 y[] = {inset, inset, 97.5 - inset, 97.5 - inset};
    for (int k = 0; k < 4; ++k) {
      t.points.col(4 * r + k) << x[k], y[k], height;
      if (r == 0) continue;
      const int a = 4 * r - 4 + k, b = 4 * r - 4 + (k + 1) % 4;
      t.faces.push_back({a, b, b + 4});
      t.faces.push_back({a, b + 4, a + 4});
    }
  }
  const int top = 4 * static_cast<int>(rings.size()) - 4;
  t.faces.push_back({top, top + 1, top + 2});
  t.faces.push_back({top, top + 2, top + 3});
  return t;
}

TEST(PreservingRemesh, ShortensEdgesAlsoWhereWhatWasMendedWouldComeAgain) {
  for (const double length : {4.4, 5., 8.}) {
    test::Outcome o;
    o.mesh = test::with_length(board_with_rounded_edges(), length);
    o.result = preserving_remesh(o.mesh, find_memory_order(o.mesh), options_for(ConnectivityMode::adapt));
    EXPECT_TRUE(o.result.measures->preservation.holds()) << length;
    EXPECT_NE(o.result.rescue, Rescue::kept_faces) << length;
    EXPECT_GT(o.result.measures->quality.min_angle.min, 10) << length;
  }
}

TEST(PreservingRemesh, ShorterEdgesKeepFlatPrismsThoughMoreOfThemAreWrongAtFirst) {
  test::Triangles t = test::drum(48, 3);
  t.points.row(1) *= .3;
  for (const double times_natural : {8., 12., 20.}) {
    test::Outcome o;
    o.mesh = test::with_length(t, times_natural * test::natural(t));
    o.result = preserving_remesh(o.mesh, find_memory_order(o.mesh), options_for(ConnectivityMode::adapt));
    EXPECT_TRUE(o.result.measures->preservation.holds()) << times_natural;
    EXPECT_NE(o.result.rescue, Rescue::kept_faces) << times_natural;
    EXPECT_LT(o.mesh.n_faces(), t.faces.size()) << times_natural;
  }
}

TEST(PreservingRemesh, StoppedWhileEdgesGetShorterItKeepsTheResultAsAsked) {
  int calls = 0, last_call = 0;
  const auto run = [&] {
    test::Outcome o;
    o.mesh = test::with_length(thin_disc(), 1.5);
    calls = 0;
    o.result = preserving_remesh(o.mesh, find_memory_order(o.mesh), options_for(ConnectivityMode::adapt), {},
                                 {}, [&](const Progress&) { return ++calls != last_call; });
    return o;
  };
  const test::Outcome whole = run();
  EXPECT_NE(whole.result.reason, StopReason::interrupted);
  EXPECT_GT(whole.result.shortened, 0);
  const int all = calls;
  for (int eighth = 3; eighth <= 8; ++eighth) {
    last_call = all * eighth / 8;
    const test::Outcome o = run();
    EXPECT_EQ(o.result.reason, StopReason::interrupted) << eighth;
    ASSERT_TRUE(o.result.measures) << eighth;
    EXPECT_TRUE(vertex_points(o.mesh).allFinite()) << eighth;
    EXPECT_EQ(o.result.shortened, 0) << eighth;
    for (double length : vertex_values(o.mesh, target_length_property)) EXPECT_EQ(length, 1.5) << eighth;
  }
}

/// The number of vertices that were put back or held, which are where they were.
int count_where_they_were(const test::Outcome& o, const test::Triangles& before) {
  int count = 0;
  for (int v = 0; v < o.points.cols(); ++v) {
    if ((o.result.vertex_limits[v] & VertexLimit::put_back) == 0) continue;
    ++count;
    EXPECT_EQ(o.points.col(v), before.points.col(v));
  }
  return count;
}

/// A flat needle of slivers, along which vertices have long ways.
test::Triangles stretched_sphere() {
  test::Triangles t = test::sphere(4, .45, 2);
  t.points.row(1) *= .05;
  t.points.row(2) *= .02;
  return t;
}

TEST(PreservingRemesh, MirroredMeshesStayMirroredWithFixedFaces) {
  test::Triangles egg = test::sphere(3);
  for (auto x : egg.points.colwise())
    x = Vec3(x[0] * (1 + .3 * x[0] * x[0]), .6 * x[1] + .2 * x[0] * x[0], 1.5 * x[2]).eval();
  RemeshOptions options = options_for(ConnectivityMode::fixed);
  const test::Outcome outcome = preserved(egg, options);
  ASSERT_TRUE(outcome.result.measures->preservation.holds());
  EXPECT_GT((outcome.points - egg.points).cwiseAbs().maxCoeff(), .01);
  const std::vector<Mirror> mirrors = find_mirrors(egg.points, egg.faces);
  ASSERT_EQ(mirrors.size(), 2u);
  for (const Mirror& mirror : mirrors)
    for (int v = 0; v < egg.points.cols(); ++v)
      EXPECT_LT((mirror(outcome.points.col(v)) - outcome.points.col(mirror.image[v])).norm(), 1e-12);
  ASSERT_NE(mirrors[0].image[20], 20);
  for (const int held : {20, mirrors[0].image[20]}) {  // on one side
    options.constraints.fixed_vertices = {held};
    EXPECT_EQ(preserved(egg, options).points.col(held), egg.points.col(held));
  }
  // Nor do those move that are held on both sides, but mirror each other only nearly.
  const int held = 20, image = mirrors[0].image[held];
  egg.points(2, held) += 1e-7;
  options.constraints.fixed_vertices = {held, image};
  const test::Outcome both = preserved(egg, options);
  for (const int v : {held, image}) EXPECT_EQ(both.points.col(v), egg.points.col(v));
}

TEST(PreservingRemesh, TellsTheDistanceThatItRefused) {
  test::Triangles pipe = test::grid(23, test::flat);  // open, rows ever farther apart
  for (auto x : pipe.points.colwise()) {
    const double angle = 1.9 * std::numbers::pi * x[0];
    x = Vec3(std::cos(angle), std::sin(angle), 4 * std::pow(x[1], 3)).eval();
  }
  const RemeshOptions options = options_for(ConnectivityMode::fixed);
  const test::Outcome refused = preserved(pipe, options);
  ASSERT_EQ(refused.result.rescue, Rescue::put_back);
  ASSERT_GT(refused.result.refused_distance, 0);
  const test::Outcome allowed =
      preserved(pipe, options, nullptr, {.max_distance = 1.2 * refused.result.refused_distance});
  EXPECT_NE(allowed.result.rescue, Rescue::put_back);
  EXPECT_EQ(allowed.result.refused_distance, 0);
  EXPECT_GT(allowed.result.measures->quality.min_angle.min,
            10 * refused.result.measures->quality.min_angle.min);
}

TEST(PreservingRemesh, FlawsAlongLongWaysDoNotPutMostVerticesBack) {
  const test::Triangles t = stretched_sphere();
  int calls = 0, stop = 0;
  const auto run = [&] {
    calls = 0;
    return preserved(t, options_for(ConnectivityMode::fixed),
                     [&](const Progress&) { return ++calls != stop; });
  };
  const test::Outcome o = run();
  EXPECT_TRUE(o.result.measures->preservation.holds());
  EXPECT_EQ(o.result.rescue, Rescue::put_back);
  const int count = count_where_they_were(o, t);
  EXPECT_GT(count, 0);
  EXPECT_LT(4 * count, o.points.cols());

  stop = calls - 10;  // while it runs with vertices held
  const test::Outcome stopped = run();
  EXPECT_EQ(stopped.result.reason, StopReason::interrupted);
  EXPECT_TRUE(stopped.result.measures->preservation.holds());
}

/// A plane with a bump, whose surface no new vertices keep to within rounding.
test::Triangles bumped_plane(double radius = .2) {
  test::Triangles t = test::grid(
      16, [](double, double) { return 0.; }, .3, 4);
  for (auto x : t.points.colwise())
    x[2] = .012 * std::pow(std::max(0., radius - std::hypot(x[0] - .5, x[1] - .5)), 2);
  return t;
}

TEST(PreservingRemesh, KeepsTheFacesOfTheInputWhereNoOthersDo) {
  const test::Triangles t = bumped_plane();
  RemeshOptions options = options_for(ConnectivityMode::adapt);
  options.map = true;
  const test::Outcome o = preserved(t, options, nullptr, {.max_distance = 1e-9});
  EXPECT_TRUE(o.result.measures->preservation.holds());
  EXPECT_EQ(o.result.rescue, Rescue::kept_faces);
  int count = 0;
  for (int v = 0; v < o.points.cols(); ++v) {
    if ((o.result.vertex_limits[v] & VertexLimit::put_back) == 0) continue;
    ++count;
    EXPECT_EQ(o.points.col(v), t.points.col(o.result.map[v].vertex));
  }
  EXPECT_GT(count, 9);
  EXPECT_LT(2 * count, o.points.cols());
}

TEST(PreservingRemesh, KeepsNearlyAllFacesOfTheInputWhereNoOthersDo) {
  const test::Triangles t = bumped_plane(.58);
  const test::Outcome o = preserved(t, options_for(ConnectivityMode::adapt), nullptr, {.max_distance = 1e-9});
  EXPECT_TRUE(o.result.measures->preservation.holds());
  EXPECT_EQ(o.result.rescue, Rescue::kept_faces);
  const auto kept = std::ranges::count_if(
      o.result.vertex_limits, [](unsigned char limits) { return limits & VertexLimit::put_back; });
  EXPECT_GT(static_cast<double>(kept), .8 * static_cast<double>(o.points.cols()));
  EXPECT_LT(kept, o.points.cols());
}

TEST(PreservingRemesh, FlippedEdgesStayWhereFacesOfTheInputDoNotHaveTo) {
  const test::Triangles t = bumped_plane();
  const test::Outcome o = preserved(t, options_for(ConnectivityMode::flip), nullptr, {.max_distance = 1e-9});
  EXPECT_TRUE(o.result.measures->preservation.holds());
  EXPECT_EQ(o.result.rescue, Rescue::kept_faces);
  EXPECT_NE(o.faces, t.faces);
  const int count = count_where_they_were(o, t);
  EXPECT_GT(count, 9);
  EXPECT_LT(2 * count, o.points.cols());
}

/// A disc whose faces get finer by a factor of 30 towards its middle, with rows at random angles.
test::Triangles graded_disc() {
  constexpr int rings = 24, sides = 24;
  test::Triangles t;
  t.points.resize(3, 1 + rings * sides);
  t.points.col(0).setZero();
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      const double radius = std::pow(1.16, ring - rings + 1.);
      const double angle =
          2 * std::numbers::pi * (side + .3 * std::sin(7. * ring * sides + 5. * side)) / sides;
      t.points.col(1 + ring * sides + side) << radius * std::cos(angle), radius * std::sin(angle), 0;
    }
  const auto at = [&](int ring, int side) { return 1 + ring * sides + side % sides; };
  for (int side = 0; side < sides; ++side) t.faces.push_back({0, at(0, side), at(0, side + 1)});
  for (int ring = 0; ring + 1 < rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      t.faces.push_back({at(ring, side), at(ring + 1, side), at(ring + 1, side + 1)});
      t.faces.push_back({at(ring, side), at(ring + 1, side + 1), at(ring, side + 1)});
    }
  return t;
}

TEST(PreservingRemesh, WhereEvenEdgesMakeWorseFacesThoseOfTheInputGiveTheLengths) {
  const test::Outcome o = preserved(graded_disc(), options_for(ConnectivityMode::fixed));
  const ResultMeasures& m = *o.result.measures;
  EXPECT_TRUE(m.preservation.holds());
  EXPECT_TRUE(o.result.has_lengths_of_input);
  EXPECT_GT(m.quality.shape.mean, m.input_quality.shape.mean);
  EXPECT_GE(m.quality.min_angle.min, (1 - 1e-9) * m.input_quality.min_angle.min);
  EXPECT_EQ(o.result.shortened, 0);
  EXPECT_FALSE(
      preserved(test::sphere(2, .3, 1), options_for(ConnectivityMode::fixed)).result.has_lengths_of_input);
}

/// A coin of radius 10 + rings / 2: fine rings on its face, long facets around, and a fan of long triangles
/// on its back.
test::Triangles coin(int sides, int rings) {
  test::Triangles t;
  t.points.resize(3, 1 + (rings + 1) * sides);
  t.points.col(0) << 0, 0, 2;
  const auto at = [&](int ring, int side) { return 1 + ring * sides + side % sides; };
  for (int ring = 0; ring <= rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      const double radius = (10 + rings / 2.) * std::min(1., (ring + 1.) / rings);
      const double angle = 2 * std::numbers::pi * side / sides;
      t.points.col(at(ring, side)) << radius * std::cos(angle), radius * std::sin(angle),
          ring < rings ? 2 : 0;
    }
  for (int side = 0; side < sides; ++side) {
    t.faces.push_back({0, at(0, side), at(0, side + 1)});
    for (int ring = 0; ring < rings; ++ring) {
      t.faces.push_back({at(ring, side), at(ring + 1, side), at(ring + 1, side + 1)});
      t.faces.push_back({at(ring, side), at(ring + 1, side + 1), at(ring, side + 1)});
    }
    if (side > 0 && side + 1 < sides) t.faces.push_back({at(rings, 0), at(rings, side + 1), at(rings, side)});
  }
  return t;
}

TEST(PreservingRemesh, LongFacetsElsewhereMakeNoSliversOfGoodFaces) {
  const test::Outcome fixed = preserved(coin(32, 8), options_for(ConnectivityMode::fixed));
  const ResultMeasures& m = *fixed.result.measures;
  EXPECT_LE(m.quality.faces_below_20, m.input_quality.faces_below_20);
  EXPECT_GT(m.quality.shape.mean, m.input_quality.shape.mean);
  EXPECT_TRUE(fixed.result.has_lengths_of_input);
}

TEST(PreservingRemesh, WhereLittleIsWrongTheRestKeepsItsSpline) {
  const test::Triangles fine = test::sphere(4, .3, 1);
  const auto count = fine.points.cols();
  const auto off_sphere = [](const auto& points) {
    return (points.colwise().norm().array() - 1).abs().maxCoeff();
  };
  int rescued = 0;
  for (const ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    RemeshOptions on_faces = options_for(mode);
    on_faces.filter.kind = FilterKind::closest;
    const double off_faces = off_sphere(preserved(fine, on_faces).points);
    for (unsigned seed = 1; seed <= 6; ++seed) {
      test::Triangles thin = lens(seed);
      thin.points.row(2) *= .3;  // so that mending alone does not do
      thin.points = ((.1 * thin.points).colwise() + Vec3(2, 0, 0)).eval();
      const test::Outcome o = preserved(test::both(fine, thin), options_for(mode));
      EXPECT_TRUE(o.result.measures->preservation.holds());
      rescued += o.result.rescue != Rescue::none;
      EXPECT_LT(off_sphere(o.points.leftCols(count)), off_faces / 5) << seed;
    }
  }
  EXPECT_GT(rescued, 0);
}

/// A flat tongue whose faces get finer by a factor of 50 towards its end: even edges leave it.
test::Triangles graded_tongue() {
  test::Triangles t = test::sphere(4, .3, 3);
  for (auto p : t.points.colwise())
    p = Vec3(std::exp(3 * p[0]), .3 * std::exp(1.5 * p[0]) * p[1], .03 * p[2]);
  return t;
}

TEST(PreservingRemesh, WhereMuchIsWrongOnlyOtherLengthsAreTried) {
  for (const ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    TriMesh mesh = test::with_length(graded_tongue(), test::natural(graded_tongue()));
    const MemoryOrder memory_order = find_memory_order(mesh);
    Stopwatch stopwatch;
    const RemeshResult result =
        preserving_remesh(mesh, memory_order, options_for(mode), {}, {}, nullptr, &stopwatch);
    EXPECT_TRUE(result.measures->preservation.holds());
    const auto untangle = std::ranges::find(stopwatch.stages(), "untangle", &StageTime::name);
    ASSERT_NE(untangle, stopwatch.stages().end());
    EXPECT_EQ(untangle->calls, 2);  // one a run: none on the faces of the input
  }
}

TEST(PreservingRemesh, SmallThinBodiesAreTriedOnTheirFaces) {
  for (const ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    int on_faces = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
      test::Triangles t = test::sphere(1, .3, seed);
      t.points.row(2) *= .04;
      on_faces += preserved(t, options_for(mode)).result.rescue == Rescue::closest;
    }
    EXPECT_GT(on_faces, 0);
  }
}

TEST(PreservingRemesh, StoppedWithLengthsOfTheInputItKeepsTheResultIfItIsGood) {
  int calls = 0, last_call = 0;
  const auto run = [&] {
    calls = 0;
    return preserved(graded_disc(), options_for(ConnectivityMode::fixed),
                     [&](const Progress&) { return ++calls != last_call; });
  };
  ASSERT_TRUE(run().result.has_lengths_of_input);
  last_call = calls - 1;
  const test::Outcome o = run();
  EXPECT_EQ(o.result.reason, StopReason::interrupted);
  EXPECT_TRUE(o.result.has_lengths_of_input);
  EXPECT_TRUE(o.result.measures->preservation.holds());
  EXPECT_TRUE(o.points != graded_disc().points);
}

TEST(PreservingRemesh, EdgesAreAsLongAsAskedDistancesAllow) {
  const test::Triangles t = test::sphere(4, .2, 1);
  std::size_t faces_before = 0;
  for (const double max_distance : {.05, .02, .008}) {  // of a radius of 1
    TriMesh mesh = test::with_length(t, 5 * test::natural(t));
    const RemeshResult result = preserving_remesh(
        mesh, find_memory_order(mesh), options_for(ConnectivityMode::adapt), {.max_distance = max_distance});
    EXPECT_TRUE(result.measures->preservation.holds()) << max_distance;
    EXPECT_LE(result.rescue, Rescue::tips) << max_distance;
    EXPECT_GT(result.measures->quality.min_angle.min, 15) << max_distance;
    EXPECT_GT(mesh.n_faces(), faces_before) << max_distance;
    EXPECT_LT(mesh.n_faces(), t.faces.size()) << max_distance;
    EXPECT_EQ(result.shortened > 0, max_distance < .05) << max_distance;
    faces_before = mesh.n_faces();
  }
}

TEST(PreservingRemesh, DistancesBelowThoseOfItsFacetsAreKeptByMoreFaces) {
  for (const unsigned seed : {1u, 2u}) {
    const test::Triangles t = test::sphere(3, .3, seed);
    TriMesh mesh = test::with_length(t, 2 * test::natural(t));
    const RemeshResult result = preserving_remesh(
        mesh, find_memory_order(mesh), options_for(ConnectivityMode::adapt), {.max_distance = 2e-3});
    EXPECT_TRUE(result.measures->preservation.holds()) << seed;
    EXPECT_NE(result.rescue, Rescue::kept_faces) << seed;
    EXPECT_GT(result.measures->quality.min_angle.p05, 30) << seed;
    EXPECT_GT(result.measures->quality.min_angle.min, 10) << seed;
  }
}

/// Two spheres, one close within the other, which has furrows at one place.
test::Triangles furrowed_in_sphere(unsigned seed) {
  const test::Triangles outer = test::sphere(4, .2, seed);
  test::Triangles inner = test::sphere(4, .2, seed + 100);
  const Vec3 place(.6, .48, .64), across(.48, -.6, 0);
  for (auto x : inner.points.colwise()) {
    const double share = std::clamp((.35 - (x - place).norm()) / .1, 0., 1.);
    x *= 1 - .023 + .02 * share * std::sin(x.dot(across) * 2 * std::numbers::pi / .15);
  }
  return test::both(outer, inner);
}

TEST(PreservingRemesh, ShellsThatAreMadeAgainKeepAMaximumDistance) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const test::Triangles t = furrowed_in_sphere(seed);
    TriMesh mesh = test::with_length(t, .18);
    const RemeshResult result = preserving_remesh(
        mesh, find_memory_order(mesh), options_for(ConnectivityMode::adapt), {.max_distance = .011});
    EXPECT_TRUE(result.measures->preservation.holds()) << seed;
    EXPECT_TRUE(vertex_points(mesh).allFinite()) << seed;
  }
}

TEST(PreservingRemesh, FarFromKeptFacesLengthsAreAsAsked) {
  TriMesh mesh = test::to_mesh(bumped_plane());
  std::vector<double> lengths;
  for (Eigen::Index v = 0; v < vertex_points(mesh).cols(); ++v)
    lengths.push_back(vertex_points(mesh)(0, v) > .9 ? .03 : .1);
  set_vertex_values(mesh, target_length_property, lengths);
  const RemeshResult result = preserving_remesh(mesh, find_memory_order(mesh),
                                                options_for(ConnectivityMode::adapt), {.max_distance = 1e-9});
  EXPECT_EQ(result.rescue, Rescue::kept_faces);
  const std::vector<double> now = vertex_values(mesh, target_length_property);
  int far = 0;
  for (std::size_t v = 0; v < now.size(); ++v) {
    const Vec3 x = vertex_points(mesh).col(static_cast<Eigen::Index>(v));
    if (x[0] > .8 || (x - Vec3(.5, .5, 0)).norm() < .58) continue;
    ++far;
    EXPECT_NEAR(now[v], .1, 1e-12);
  }
  EXPECT_GT(far, 9);
}

TEST(PreservingRemesh, StoppedWhileFacesAreKeptItKeepsTheResultBefore) {
  int calls = 0, last_call = 0;
  const auto run = [&] {
    calls = 0;
    return preserved(bumped_plane(), options_for(ConnectivityMode::adapt),
                     [&](const Progress&) { return ++calls != last_call; }, {.max_distance = 1e-9});
  };
  EXPECT_EQ(run().result.rescue, Rescue::kept_faces);
  last_call = calls - 1;
  const test::Outcome o = run();
  EXPECT_EQ(o.result.reason, StopReason::interrupted);
  ASSERT_TRUE(o.result.measures);
  EXPECT_FALSE(o.result.measures->preservation.holds());
}

TEST(PreservingRemesh, DoesNotKeepAllFacesOfTheInput) {
  TriMesh mesh = test::with_length(test::sphere(2, .3, 1), .5);
  const RemeshResult result = preserving_remesh(mesh, find_memory_order(mesh),
                                                options_for(ConnectivityMode::adapt), {.max_distance = 1e-9});
  EXPECT_FALSE(result.measures->preservation.holds());
  EXPECT_NE(result.rescue, Rescue::kept_faces);
}

/// A sphere with a spike as thin as its faces, which collapses and the splines would take off.
test::Triangles spiked_sphere() {
  test::Triangles t = test::sphere(3);
  t.points.col(0) *= 1.6;
  return t;
}

TEST(PreservingRemesh, KeepsTips) {
  const test::Triangles t = spiked_sphere();
  for (const ConnectivityMode mode : {ConnectivityMode::flip, ConnectivityMode::adapt}) {
    const test::Outcome kept = preserved(t, options_for(mode));
    EXPECT_TRUE(kept.result.measures->preservation.holds());
    const double distance = AabbTree(kept.points, kept.faces).closest(t.points.col(0)).squared_distance;
    EXPECT_LT(std::sqrt(distance), .6 * test::natural(t));
  }
}

TEST(PreservingRemesh, HoldsTheTipOfAConeWithGoodFaces) {
  const test::Triangles cone = test::pyramid(32, 3, 6);
  for (const double length : {.4, .8}) {
    const test::Outcome made = test::remeshed(cone, length, options_for(ConnectivityMode::adapt));
    double nearest = 1;
    for (int v = 0; v < made.points.cols(); ++v)
      nearest = std::min(nearest, (made.points.col(v) - cone.points.col(32)).norm());
    EXPECT_EQ(nearest, 0);
    EXPECT_GT(min_angle(made.points, made.faces), 24);
  }
}

/// Strips that meet in a bent line, of which only the vertices of the line may move: along its chords, which
/// leaves the strips by a little.
TEST(PreservingRemesh, HoldsJunctionsIfSlidingBreaksAPromise) {
  Mat3X line = test::on_axis({0, .7, 1.4, 3, 4.2, 5, 6.3, 7});
  for (Eigen::Index i = 0; i < line.cols(); ++i) line(1, i) = .02 * line(0, i) * line(0, i);
  const TriMesh input = test::sheets(test::fan(line, 3, 1, 1), 1);
  RemeshOptions options = options_for(ConnectivityMode::fixed);
  for (int v = static_cast<int>(line.cols()); v < 4 * line.cols(); ++v)
    options.constraints.fixed_vertices.push_back(v);
  for (const double max_distance : {1., 1e-6}) {
    TriMesh mesh = input;
    const RemeshResult done =
        preserving_remesh(mesh, find_memory_order(mesh), options, {.max_distance = max_distance});
    EXPECT_TRUE(done.measures->preservation.holds());
    EXPECT_EQ(done.rescue, max_distance == 1 ? Rescue::none : Rescue::junctions);
    EXPECT_EQ(vertex_points(mesh) == vertex_points(input), max_distance < 1);
  }
}

TEST(PreservingRemesh, IsTheSameForAnyNumberOfThreads) {
  const RemeshOptions options = options_for(ConnectivityMode::adapt);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return preserved(spiked_sphere(), options);
  };
  const test::Outcome one = run(1), two = run(2);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.faces, two.faces);
}

TEST(PreservingRemesh, VerticesThatStayMakeAValidMeshWheneverTheyAreStopped) {
  for (const ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip})
    for (unsigned seed = 1; seed <= 4; ++seed)
      for (int stop : {1, 2, 4, 8, 16, 40}) {
        int calls = 0;
        const test::Outcome o =
            preserved(lens(seed), options_for(mode), [&](const Progress&) { return ++calls < stop; });
        EXPECT_TRUE(o.result.measures->preservation.holds()) << seed << " " << stop;
        EXPECT_TRUE(calls < stop || o.result.reason == StopReason::interrupted);
      }
}

TEST(PreservingRemesh, DiscardsAnInterruptedRunButTheFirst) {
  const RemeshOptions options = options_for(ConnectivityMode::adapt);
  int tried = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    test::Triangles t = lens(seed);
    t.points.row(2) *= .3;
    int of_first = 0, of_all = 0;
    test::remeshed(t, test::natural(t), options, [&](const Progress&) { return ++of_first > 0; });
    preserved(t, options, [&](const Progress&) { return ++of_all > 0; });
    if (of_all == of_first) continue;
    ++tried;
    for (int stop : {of_first / 2, of_first + 1, of_all - 1}) {
      int calls = 0;
      const test::Outcome stopped = preserved(t, options, [&](const Progress&) { return ++calls < stop; });
      EXPECT_EQ(stopped.result.reason, StopReason::interrupted);
      EXPECT_LE(calls, stop + 1);
    }
  }
  EXPECT_GE(tried, 1);
}

TEST(PreservingRemesh, EdgesGetShorterWithinAFacetOnlyWhereTheyMust) {
  constexpr double length = .3;
  TriMesh mesh = test::with_length(test::drum(24, 1), length);  // no vertices within its caps
  const RemeshResult result =
      preserving_remesh(mesh, find_memory_order(mesh), options_for(ConnectivityMode::adapt),
                        {.max_distance = 4e-3});  // of its rims, from chords of 24 sides
  EXPECT_TRUE(result.measures->preservation.holds());
  EXPECT_GT(result.shortened, 0);
  const Mat3X points = vertex_points(mesh);
  double in_middle = 0, count = 0, shortest = length;
  for (const auto e : mesh.edges()) {
    const Vec3 a = points.col(e.v0().idx()), b = points.col(e.v1().idx()), middle = .5 * (a + b);
    shortest = std::min(shortest, (a - b).norm());
    if (middle.head<2>().norm() > .3) continue;
    in_middle += (a - b).norm();
    ++count;
  }
  ASSERT_GT(count, 0);
  EXPECT_GT(in_middle / count, .85 * length);
  EXPECT_LT(shortest, .7 * length);
}

TEST(PreservingRemesh, AnOpenTubeOfLongFacetsTakesNoMoreFacesThanItMust) {
  test::Triangles tube = test::drum(64, 2);
  tube.faces.resize(128);  // its sides, without the caps
  for (const double times_natural : {2., 5., 8.}) {
    const double length = times_natural * test::natural(tube);
    TriMesh mesh = test::with_length(tube, length);
    const RemeshResult result = preserving_remesh(
        mesh, find_memory_order(mesh), options_for(ConnectivityMode::adapt), {.max_distance = 3e-3});
    EXPECT_TRUE(result.measures->preservation.holds()) << times_natural;
    EXPECT_NE(result.rescue, Rescue::kept_faces) << times_natural;
    EXPECT_GT(result.measures->quality.min_angle.min, 30) << times_natural;
    // Chords of .15 keep so much of a radius of 1.
    EXPECT_LT(static_cast<double>(mesh.n_faces()), 4 * 4 * std::numbers::pi / (std::sqrt(3.) / 4 * .15 * .15))
        << times_natural;
  }
}

}  // namespace hooke::preserving_remesh_test
