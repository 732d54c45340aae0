#include "hooke/connectivity/adaptation.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string_view>

#include "hooke/connectivity/edge_collapses.h"
#include "hooke/connectivity/edge_splits.h"
#include "hooke/connectivity/face_count.h"
#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/aabb_tree.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/topology.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/remesh.h"
#include "hooke/remesh/result.h"
#include "hooke/remesh/run.h"
#include "hooke/remesh/run_options.h"
#include "hooke/working_mesh/working_mesh.h"
#include "support/crease_solids.h"
#include "support/remeshed.h"
#include "support/solids.h"
#include "support/working_scene.h"

namespace hooke::adaptation_test {

using test::natural;

double wave(double x, double y) {
  return .1 * std::sin(5 * x) * std::cos(4 * y);
}

test::Triangles with_holes(double (*height)(double, double)) {
  test::Triangles t = test::grid(14, height, .3, 2);
  std::erase_if(t.faces, [&](const Triangle& f) {
    const Vec3 middle = (t.points.col(f[0]) + t.points.col(f[1]) + t.points.col(f[2])) / 3;
    return (middle.head(2) - Eigen::Vector2d(.3, .3)).norm() < .15 ||
           (middle.head(2) - Eigen::Vector2d(.7, .65)).norm() < .12;
  });
  return t;
}

struct Outcome {
  RemeshResult result;
  Mat3X points;
  Adjacency adjacency;
};

RemeshOptions adaptation_options(Effort effort = Effort::fast) {
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  options.effort = effort;
  options.map = true;
  return options;
}

Outcome adapted(const test::Triangles& t, const RunOptions& options, const std::vector<double>& lengths,
                const Observer& observer = nullptr) {
  TriMesh mesh = test::to_mesh(t);
  auto length = OpenMesh::getOrMakeProperty<OpenMesh::VertexHandle, double>(mesh, target_length_property);
  for (const auto v : mesh.vertices()) length[v] = lengths[v.idx()];
  Outcome o;
  o.result = Run(mesh, find_memory_order(mesh), options, observer, nullptr).remesh(mesh);
  o.points = vertex_points(mesh);
  o.adjacency = make_adjacency(static_cast<int>(mesh.n_vertices()), triangles_of(mesh));
  return o;
}

Outcome adapted(const test::Triangles& t, double length, const RunOptions& options,
                const Observer& observer = nullptr) {
  return adapted(t, options, std::vector<double>(t.points.cols(), length), observer);
}
Outcome adapted(const test::Triangles& t, double length, const RemeshOptions& options = adaptation_options(),
                const Observer& observer = nullptr) {
  return adapted(t, length, RunOptions(options), observer);
}
Outcome adapted(const test::Triangles& t, const RemeshOptions& options, const std::vector<double>& lengths) {
  return adapted(t, RunOptions(options), lengths);
}

/// The same topology, no face against its neighbours, no crossing.
void expect_sound(const test::Triangles& t, const Outcome& o) {
  const Topology before = measure_topology(make_adjacency(static_cast<int>(t.points.cols()), t.faces));
  const Topology after = measure_topology(o.adjacency);
  EXPECT_EQ(after.euler, before.euler);
  EXPECT_EQ(after.boundary_loops, before.boundary_loops);
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(after.isolated_vertices, before.isolated_vertices);
  EXPECT_TRUE(o.points.allFinite());
  const Quality quality =
      measure_quality(o.points, o.adjacency, std::vector<double>(o.adjacency.edges.size(), 1.));
  EXPECT_EQ(quality.folded_edges, 0u);
  EXPECT_EQ(quality.self_intersections.value_or(1), 0u);
}

TEST(Adaptation, HasAsManyFacesAsTheLengthAsksFor) {
  for (const test::Triangles& t : {test::grid(10, wave, .3), test::sphere(2, .3, 4)})
    for (double factor : {.3, 1., 3.}) {
      const Outcome o = adapted(t, factor * natural(t));
      const double wanted = static_cast<double>(t.faces.size()) / (factor * factor);
      EXPECT_NEAR(static_cast<double>(o.adjacency.faces.size()), wanted, std::max(2.5, .03 * wanted));
      EXPECT_NEAR(o.result.adaptation.target_faces, wanted, .001 * wanted);
      expect_sound(t, o);
    }
}

TEST(Adaptation, KeepsHolesEvenWhereTheyAreSmallForTheLength) {
  const test::Triangles t = with_holes(wave);
  for (double factor : {.6, 3.}) expect_sound(t, adapted(t, factor * natural(t)));
}

TEST(Adaptation, MakesGoodTriangles) {
  const test::Triangles t = test::sphere(3, .45, 4);
  const Outcome o = adapted(t, natural(t), adaptation_options(Effort::standard));
  EXPECT_GT(min_angle(o.points, o.adjacency.faces), 44);
  EXPECT_LT(min_angle(t.points, t.faces), 15);
}

/// Splits alone would cut the 1500 edges at the tip into some 30 pieces each.
TEST(Adaptation, FansOfNeedlesAreNotCutInPiecesFirst) {
  const test::Triangles t = test::pyramid(1500, 20, 40);
  const Outcome o = adapted(t, natural(t));
  EXPECT_LT(o.result.adaptation.splits, 5 * static_cast<long long>(t.faces.size()));
  EXPECT_GT(min_angle(o.points, o.adjacency.faces), 20);
  EXPECT_EQ(measure_topology(o.adjacency).euler, 2);
}

/// At once they would be cut into some 180 times the faces wanted.
TEST(Adaptation, NeedlesAreCutAShareAtATime) {
  const test::Triangles t = test::drum(1000, 8);
  const Outcome o = adapted(t, natural(t));
  EXPECT_LT(o.result.adaptation.splits, 20 * static_cast<long long>(t.faces.size()));
  EXPECT_GT(min_angle(o.points, o.adjacency.faces), 20);
  EXPECT_EQ(measure_topology(o.adjacency).euler, 2);
}

/// Standard deviation of the edge lengths over their mean.
double edge_variation(const Outcome& o) {
  double sum = 0, squares = 0;
  for (const auto& [a, b] : o.adjacency.edges) {
    const double squared = (o.points.col(a) - o.points.col(b)).squaredNorm();
    sum += std::sqrt(squared);
    squares += squared;
  }
  return std::sqrt(static_cast<double>(o.adjacency.edges.size()) * squares / (sum * sum) - 1);
}

TEST(Adaptation, ACoarserMeshFirstMakesEdgesMoreEven) {
  double with_levels = 0, without_levels = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const test::Triangles t = test::sphere(4, .45, seed);
    const RunOptions coarse(adaptation_options(Effort::standard));
    RunOptions none = coarse;
    none.adaptation.coarse.levels = 0;
    const Outcome with = adapted(t, .7 * natural(t), coarse), without = adapted(t, .7 * natural(t), none);
    EXPECT_EQ(with.result.adaptation.levels, 1);
    EXPECT_EQ(without.result.adaptation.levels, 0);
    EXPECT_GT(min_angle(with.points, with.adjacency.faces), 44);
    expect_sound(t, with);
    with_levels += edge_variation(with);
    without_levels += edge_variation(without);
  }
  EXPECT_LT(with_levels, .95 * without_levels);
}

TEST(Adaptation, InterruptedAtACoarserMeshItStillHasTheLengthsAskedFor) {
  const test::Triangles t = test::sphere(4, .3, 4);
  const double L = natural(t), wanted = static_cast<double>(t.faces.size());
  int all = 0;
  adapted(t, L, adaptation_options(),
          [&](const Progress& p) { return all += std::string_view(p.stage) == "adapt", true; });
  ASSERT_GT(all, 8);
  for (int calls : {1, all / 4, all / 2, 3 * all / 4}) {
    int left = calls;
    const Outcome o = adapted(t, L, adaptation_options(), [&](const Progress& p) {
      return std::string_view(p.stage) != "adapt" || --left > 0;
    });
    EXPECT_EQ(o.result.reason, StopReason::interrupted);
    EXPECT_GT(o.result.adaptation.levels, 0);
    EXPECT_NEAR(static_cast<double>(o.adjacency.faces.size()) / wanted, 1, .35) << calls;
    expect_sound(t, o);
  }
}

/// On the faces of the input, where any drift shows.
TEST(Adaptation, AllVerticesAreProjectedInterruptedOrNot) {
  const test::Triangles t = test::sphere(4, .3, 4);
  const AabbTree input(t.points, t.faces);
  RemeshOptions options = adaptation_options();
  options.filter.kind = FilterKind::closest;
  int all = 0;
  const auto max_distance = [&](const Outcome& o) {
    double greatest = 0;
    for (const auto& x : o.points.colwise())
      greatest = std::max(greatest, input.closest(Vec3(x)).squared_distance);
    return std::sqrt(greatest);
  };
  EXPECT_LT(max_distance(adapted(t, natural(t), options, [&](const Progress&) { return ++all > 0; })), 1e-9);
  ASSERT_GT(all, 12);
  for (int calls = 1; calls < all; calls += all / 8) {
    int left = calls;
    const Outcome o = adapted(t, natural(t), options, [&](const Progress&) { return --left > 0; });
    EXPECT_EQ(o.result.reason, StopReason::interrupted);
    EXPECT_LT(max_distance(o), 1e-9) << calls;
  }
}

TEST(Adaptation, ACoarserMeshHonoursASizing) {
  const test::Triangles t = test::sphere(4, .3, 4);
  std::vector<double> lengths;
  for (const auto& x : t.points.colwise()) lengths.push_back(natural(t) * (1 + .4 * x[2]));
  const Outcome o = adapted(t, adaptation_options(), lengths);
  EXPECT_GT(o.result.adaptation.levels, 0);
  double error = 0;
  for (const auto& [a, b] : o.adjacency.edges) {
    const double z = .5 * (o.points(2, a) + o.points(2, b)), l = (o.points.col(a) - o.points.col(b)).norm();
    error += std::pow(l / (natural(t) * (1 + .4 * z)) - 1, 2);
  }
  EXPECT_LT(std::sqrt(error / static_cast<double>(o.adjacency.edges.size())), .1);
  expect_sound(t, o);
}

TEST(Adaptation, ARegularMeshKeepsItsVertices) {
  const test::Triangles t = test::sphere(4);
  const Outcome o = adapted(t, natural(t), adaptation_options(Effort::standard));
  EXPECT_EQ(o.result.adaptation.levels, 0);
  for (size_t v = 0; v < o.result.map.size(); ++v) EXPECT_EQ(o.result.map[v].vertex, static_cast<int>(v));
  EXPECT_EQ(o.adjacency.faces.size(), t.faces.size());
}

TEST(Adaptation, ARoughSurfaceHasNoCoarserMesh) {
  test::Triangles t = test::sphere(4, .3, 4);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, .3 * natural(t));
  for (auto x : t.points.colwise()) x *= 1 + noise(random);
  EXPECT_EQ(adapted(t, natural(t)).result.adaptation.levels, 0);
}

TEST(Adaptation, CornersAndGivenVerticesStayBitForBit) {
  const test::Triangles t = with_holes(wave);
  RemeshOptions options = adaptation_options();
  options.constraints.fixed_vertices = {100, 112};
  const Outcome o = adapted(t, .8 * natural(t), options);
  std::set<int> found;
  for (size_t v = 0; v < o.result.map.size(); ++v)
    for (int kept : {0, 14, 210, 224, 100, 112})
      if (o.result.map[v].vertex == kept) {
        EXPECT_EQ(o.points.col(static_cast<Eigen::Index>(v)), t.points.col(kept));
        found.insert(kept);
      }
  EXPECT_EQ(found.size(), 6u);
}

TEST(Adaptation, TheBoundaryStaysOnItsPolyline) {
  const test::Triangles t = with_holes(test::flat);
  const Adjacency input = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  const Constraints constraints = find_constraints(t.points, input, {});
  const Outcome o = adapted(t, .7 * natural(t));
  const std::vector<char> boundary = boundary_vertices(o.adjacency);
  for (size_t v = 0; v < boundary.size(); ++v) {
    if (!boundary[v]) continue;
    const Vec3 x = o.points.col(static_cast<Eigen::Index>(v));
    double least = 1;
    for (const Curve& curve : constraints.curves)
      for (int s = 0; s < curve.segment_count(); ++s)
        least = std::min(least, (project_to_curve(curve, x, s).point - x).norm());
    EXPECT_LT(least, 1e-12);
  }
}

TEST(Adaptation, TheMapReproducesThePoints) {
  const test::Triangles t = with_holes(test::flat);
  const Outcome o = adapted(t, .8 * natural(t));
  ASSERT_EQ(o.result.map.size(), o.points.cols());
  int last = -1;
  bool fresh = false;
  for (size_t v = 0; v < o.result.map.size(); ++v) {
    const auto& [vertex, place] = o.result.map[v];
    fresh |= vertex < 0;
    if (fresh)
      EXPECT_EQ(vertex, -1) << "old vertices come first";
    else
      EXPECT_LT(std::exchange(last, vertex), vertex) << "in their old order";
    if (o.adjacency.vertex_faces[static_cast<int>(v)].empty()) continue;
    EXPECT_NEAR(place.weights.sum(), 1, 1e-12);
    EXPECT_GE(place.weights.minCoeff(), 0);
    Vec3 x = Vec3::Zero();
    for (size_t k = 0; k < 3; ++k)
      x += place.weights[static_cast<Eigen::Index>(k)] * t.points.col(t.faces[place.face][k]);
    EXPECT_LT((x - o.points.col(static_cast<Eigen::Index>(v))).norm(), 1e-9);
  }
  EXPECT_TRUE(fresh);
}

TEST(Adaptation, TheMapIsKeptInTheOtherModes) {
  const test::Triangles t = test::sphere(2, .3, 4);
  const double L = natural(t);
  for (ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    RemeshOptions options = adaptation_options();
    options.connectivity = mode;
    const Outcome o = adapted(t, L, options);
    ASSERT_EQ(o.result.map.size(), o.points.cols());
    for (size_t v = 0; v < o.result.map.size(); ++v) {
      const MapEntry& entry = o.result.map[v];
      EXPECT_EQ(entry.vertex, static_cast<int>(v));
      Vec3 x = Vec3::Zero();
      for (size_t k = 0; k < 3; ++k)
        x += entry.position.weights[static_cast<Eigen::Index>(k)] *
             t.points.col(t.faces[entry.position.face][k]);
      EXPECT_LT((x - o.points.col(static_cast<Eigen::Index>(v))).norm(), .3 * L);  // the faces' sagitta
    }
  }
}

TEST(Adaptation, OneThreadAndTwoGiveTheSameBits) {
  const test::Triangles t = test::grid(40, wave, .35);
  std::vector<Outcome> outcomes;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    outcomes.push_back(adapted(t, .8 * natural(t)));
  }
  EXPECT_EQ(outcomes[0].points, outcomes[1].points);
  EXPECT_EQ(outcomes[0].adjacency.faces, outcomes[1].adjacency.faces);
}

TEST(Adaptation, APowerOfTwoScalesTheResultExactly) {
  const test::Triangles t = with_holes(wave);
  test::Triangles large = t;
  large.points *= 8;
  const double L = 1.2 * natural(t);
  const Outcome one = adapted(t, L), eight = adapted(large, 8 * L);
  EXPECT_EQ(8 * one.points, eight.points);
  EXPECT_EQ(one.adjacency.faces, eight.adjacency.faces);
}

TEST(Adaptation, StopsWithAValidMeshWheneverTheObserverSaysSo) {
  const test::Triangles t = with_holes(wave);
  int all = 0;
  adapted(t, .6 * natural(t), adaptation_options(), [&](const Progress&) { return ++all > 0; });
  for (int calls : {1, 2, all / 4, all / 2, all - 1}) {
    int left = calls;
    const Outcome o =
        adapted(t, .6 * natural(t), adaptation_options(), [&](const Progress&) { return --left > 0; });
    EXPECT_EQ(o.result.reason, StopReason::interrupted);
    expect_sound(t, o);
  }
}

TEST(Adaptation, SmallMeshesSurvive) {
  test::Triangles face, tetrahedron;
  face.points = Mat3X{{0, 3, .1}, {0, 0, 2}, {0, 0, 0}};
  face.faces = {{0, 1, 2}};
  tetrahedron.points = Mat3X{{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  tetrahedron.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (const test::Triangles& t : {face, tetrahedron})
    for (double factor : {.5, 1., 5.}) {
      const Outcome o = adapted(t, factor * natural(t));
      EXPECT_TRUE(o.points.allFinite());
      const Topology before = measure_topology(make_adjacency(static_cast<int>(t.points.cols()), t.faces));
      EXPECT_EQ(measure_topology(o.adjacency).euler, before.euler);
      EXPECT_GE(o.adjacency.faces.size(), factor < 1 ? 2 * t.faces.size() : t.faces.size() / 2);
    }
}

TEST(Adaptation, EdgesFollowGradedTargets) {
  const test::Triangles t = test::grid(20, test::flat, .3);
  std::vector<double> lengths;
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) lengths.push_back(natural(t) * (.6 + t.points(0, v)));
  const Outcome o = adapted(t, adaptation_options(), lengths);
  double left = 0, right = 0, lefts = 0, rights = 0;
  for (const auto& [a, b] : o.adjacency.edges) {
    const double x = .5 * (o.points(0, a) + o.points(0, b)), l = (o.points.col(a) - o.points.col(b)).norm();
    if (x < .2) left += l, ++lefts;
    if (x > .8) right += l, ++rights;
  }
  EXPECT_NEAR(right / rights / (left / lefts), 1.5 / .7, .25);
}

constexpr int cells = 8;

/// The middle row of edges of a grid.
std::vector<Edge> middle_row() {
  std::vector<Edge> row;
  for (int v = cells / 2 * (cells + 1); row.size() < cells; ++v) row.push_back({v, v + 1});
  return row;
}

struct CreasedScene : test::WorkingScene {
  CreasedScene() : WorkingScene(test::grid(cells, test::flat), test::plane(), middle_row()) {}
};

TEST(WorkingMesh, CreasesAreSplitAndCollapsedAlongThemselves) {
  for (double factor : {.4, 2.5}) {
    CreasedScene s;
    for (double& length : s.vertices.vertex_length) length *= factor;
    for (int round = 0; round < 4; ++round) {
      count_curve_edges(s.mesh, .1);
      split_long_edges(s.mesh);
      WorkingMesh flipping = s.mesh;
      flip_to_delaunay(flipping);
      collapse_short_edges(s.mesh);
      match_curve_edges(s.mesh);
      compact(s.mesh);
    }
    const double wanted = std::lround(1 / s.vertices.vertex_length[0]);
    EXPECT_NEAR(static_cast<double>(s.constraints.creases.size()), wanted, 1);
    double length = 0;
    for (const auto& [a, b] : s.constraints.creases) {
      EXPECT_NEAR(s.positions.points(1, a), .5, 1e-12);
      length += (s.positions.points.col(a) - s.positions.points.col(b)).norm();
    }
    EXPECT_NEAR(length, 1, 1e-9);
  }
}

/// Limited by the surface only.
constexpr CoarseLimits any_number{
    .levels = 10, .min_faces = 0, .constrained_share = 9, .irregular_share = -1};

int levels_of(const test::WorkingScene& s, const CoarseLimits& limits = any_number) {
  return coarse_levels(s.mesh, static_cast<double>(s.adjacency.faces.size()), limits);
}

TEST(FaceCount, ARoundChangesWhatIsMissingButOnlyAShareOfTheEdges) {
  EXPECT_EQ(changes_towards(100, 100), 0);
  EXPECT_EQ(changes_towards(104, 100), 2);
  EXPECT_EQ(changes_towards(96, 100), 2);
  EXPECT_EQ(changes_towards(1e6, 1000), 30);
  EXPECT_EQ(changes_towards(1e6, 4), 1);
}

TEST(CoarseLevels, GrowByOneWhereTheMeshIsTwiceAsFine) {
  const test::WorkingScene coarse(test::sphere(3, .2, 3), test::unit_sphere());
  const test::WorkingScene fine(test::sphere(4, .2, 3), test::unit_sphere());
  EXPECT_GE(levels_of(coarse), 1);
  EXPECT_EQ(levels_of(fine), levels_of(coarse) + 1);
}

TEST(CoarseLevels, AreThoseThatTheSagittaAllows) {
  const test::WorkingScene s(test::sphere(4, 0, 3), test::unit_sphere());
  for (double sagitta : {.02, .05, .1}) {
    CoarseLimits limits = any_number;
    limits.sagitta = sagitta;
    const auto on_unit_circle = [&](int level) {
      return std::tan(std::ldexp(s.vertices.vertex_length[0], level) / 4) / 2;
    };
    const int levels = levels_of(s, limits);
    EXPECT_LE(on_unit_circle(levels), 1.1 * sagitta);  // edges are a little longer than arcs turn
    EXPECT_GT(on_unit_circle(levels + 1), .9 * sagitta);
  }
}

TEST(CoarseLevels, AreLimited) {
  const test::WorkingScene s(test::sphere(4, .2, 3), test::unit_sphere());
  CoarseLimits limits = any_number;
  for (int levels : {0, 1}) {
    limits.levels = levels;
    EXPECT_EQ(levels_of(s, limits), levels);
  }
  const double faces = static_cast<double>(s.adjacency.faces.size());
  limits.levels = 3;
  limits.min_faces = .9 * faces / 4;
  EXPECT_EQ(levels_of(s, limits), 1);
  limits.min_faces = 1.1 * faces / 4;
  EXPECT_EQ(levels_of(s, limits), 0);
}

TEST(CoarseLevels, AMeshThatIsRegularAlreadyHasNone) {
  const test::WorkingScene regular(test::sphere(4), test::unit_sphere());
  EXPECT_EQ(levels_of(regular, {}), 0);
  test::WorkingScene too_fine(test::sphere(4), test::unit_sphere());
  for (double& length : too_fine.vertices.vertex_length) length *= 1.5;
  EXPECT_EQ(levels_of(too_fine, {}), 1);
  EXPECT_EQ(levels_of(test::WorkingScene(test::sphere(4, .3, 3), test::unit_sphere()), {}), 1);
}

TEST(CoarseLevels, AreThoseOfTheSurfaceHoweverFinelyItIsMeshed) {
  // A large sphere of small faces beside a small one of large faces: the edges of the latter are 1 in 80, but
  // it takes a quarter of the target mesh.
  test::Triangles flat = test::sphere(5), bent = test::sphere(2);
  flat.points *= 2;
  bent.points.row(0).array() += 5;
  const test::Triangles t = test::both(flat, bent);
  const Surface both = [](const Vec3& x, int hint, double) {
    const Vec3 centre(x[0] > 3 ? 5 : 0, 0, 0), n = (x - centre).normalized();
    return Projection{centre + (x[0] > 3 ? 1 : 2) * n, n, hint, ProjectionStatus::converged, 1};
  };
  test::WorkingScene s(t, both);
  for (double& length : s.vertices.vertex_length) length = .3;
  CoarseLimits limits = any_number;
  const double round = .5 * std::tan(.3 / 4);  // sagitta of an edge of the small sphere over its length
  limits.sagitta = 1.5 * round;
  EXPECT_EQ(levels_of(s, limits), 0);  // the large sphere alone would allow one
  limits.bent_share = .5;
  EXPECT_EQ(levels_of(s, limits), 1);
}

TEST(CoarseLevels, ThereAreNoneBetweenCreases) {
  constexpr int width = 12;
  std::vector<Edge> crease;
  for (int v = width / 2 * (width + 1); crease.size() < width; ++v) crease.push_back({v, v + 1});
  const test::Triangles t = test::grid(width, test::flat, .1);
  EXPECT_GT(levels_of(test::WorkingScene(t, test::plane())), 0);
  EXPECT_EQ(levels_of(test::WorkingScene(t, test::plane(), crease)), 0);
}

TEST(CoarseLevels, ConstrainedVerticesTakeNoMoreThanTheirShare) {
  const test::WorkingScene s(test::grid(24, test::flat, .1), test::plane());
  CoarseLimits limits = any_number;
  // At level 1 about 44 of 144 vertices are on the boundary, whose corners are fixed, at level 2 22 of 36.
  for (const auto& [share, levels] : {std::pair(.25, 0), std::pair(.45, 1), std::pair(.8, 2)}) {
    limits.constrained_share = share;
    EXPECT_EQ(levels_of(s, limits), levels) << share;
  }
}

TEST(CoarseLevels, VerticesThatStandStillDoNotGetFewer) {
  test::WorkingScene s(test::sphere(4, .2, 3), test::unit_sphere());
  CoarseLimits limits = any_number;
  limits.constrained_share = .25;
  EXPECT_GE(levels_of(s, limits), 2);
  for (size_t v = 0; v < s.constraints.freedom.size(); v += 25) s.constraints.freedom[v] = Freedom::fixed;
  EXPECT_EQ(levels_of(s, limits), 1);  // .04 of the vertices: .16 at level 1, .64 at level 2
}

}  // namespace hooke::adaptation_test
