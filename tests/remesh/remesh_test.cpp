#include "hooke/remesh/remesh.h"

#include <gtest/gtest.h>

#include "hooke/constraints/constraints.h"
#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/surface_field.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/result.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/workspace.h"
#include "support/remeshed.h"
#include "support/scene.h"
#include "support/solids.h"

namespace hooke::remesh_test {

using test::natural, test::Outcome, test::remeshed;

double wave(double x, double y) {
  return .12 * std::sin(4 * x) * std::cos(3 * y);
}

/// Steep flanks: what the filter keeps there costs angles.
double mountain(double x, double y) {
  return .6 * std::exp(-12 * ((x - .5) * (x - .5) + (y - .4) * (y - .4)));
}

/// Sheared into equilateral triangles in the plane below.
test::Triangles equilateral_grid(int n, double (*height)(double, double), double jitter) {
  test::Triangles t = test::grid(n, height, jitter);
  for (auto x : t.points.colwise()) x = Vec3(x[0] - .5 * x[1], std::sqrt(.75) * x[1], x[2]);
  return t;
}

/// An ellipsoid with axes 1, .92 and .88.
test::Triangles ellipsoid(int levels, double jitter) {
  test::Triangles t = test::sphere(levels, jitter);
  t.points.row(1) *= .92;
  t.points.row(2) *= .88;
  return t;
}

double largest_move(const test::Triangles& t, const Outcome& o) {
  return (o.points - t.points).colwise().norm().maxCoeff();
}

Mat3X vectors_of(TriMesh& mesh, const char* property) {
  return as_matrix(mesh, OpenMesh::getProperty<OpenMesh::VertexHandle, Vec3>(mesh, property));
}

TEST(ResidualForces, AreThoseOfStringsInMeanTargetLengths) {
  // Three strings of length 3 with target lengths 2: each end is pulled by half a target length, twice.
  test::Triangles t = test::equilateral();
  t.points *= 3;
  TriMesh mesh = test::with_length(t, 2);
  set_residual_forces(mesh, find_memory_order(mesh), 1);  // no altitude is too short
  const Mat3X forces = vectors_of(mesh, force_property);
  const Vec3 centre = t.points.rowwise().mean();
  for (Eigen::Index v = 0; v < 3; ++v) {
    const Vec3 inward = (centre - t.points.col(v)).normalized();
    EXPECT_NEAR((forces.col(v) - .5 * std::sqrt(3) * inward).norm(), 0, 1e-12);
  }
}

TEST(ResidualForces, FallAsTheMeshComesToRestInEveryMode) {
  const test::Triangles t = test::sphere(2, .35, 4);
  TriMesh start = test::with_length(t, natural(t));
  set_residual_forces(start, find_memory_order(start), 1);
  const double before = vectors_of(start, force_property).norm();
  for (ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt})
    for (IntegratorKind integrator : {IntegratorKind::lbfgs, IntegratorKind::damped}) {
      TriMesh mesh = test::with_length(t, natural(t));
      RemeshOptions options;
      options.connectivity = mode;
      options.integrator = integrator;
      remesh(mesh, options);
      EXPECT_LT(vectors_of(mesh, force_property).norm(), .5 * before);
      const bool moved = integrator == IntegratorKind::damped && mode != ConnectivityMode::adapt;
      EXPECT_EQ(vectors_of(mesh, velocity_property).norm() > 0, moved);
    }
}

TEST(DoNoHarm, NearRegularMeshesKeepTheirLeastAngleAndTheirPlaces) {
  for (const test::Triangles& t :
       {test::sphere(1), test::sphere(2), test::sphere(3), test::sphere(3, .08, 3), ellipsoid(2, 0),
        ellipsoid(3, .05), equilateral_grid(9, wave, .1), equilateral_grid(12, test::flat, .08),
        test::grid(8, test::flat, .05), test::cube()}) {
    const Outcome o = remeshed(t);
    SCOPED_TRACE(min_angle(t.points, t.faces));
    EXPECT_TRUE(o.result.near_regular);
    EXPECT_GE(min_angle(o.points, t.faces), min_angle(t.points, t.faces));
    EXPECT_LT(largest_move(t, o), .2 * natural(t));
  }
}

TEST(DoNoHarm, NearRegularMeshesStillGetMoreEqualEdges) {
  const test::Triangles t = test::sphere(3, .08, 3);
  const Adjacency c = test::connect(t);
  const TargetLengths targets = spread_target_lengths(c, std::vector<double>(t.points.cols(), 1));
  EXPECT_LT(relative_edge_deviation(remeshed(t).points, c.edges, targets),
            .9 * relative_edge_deviation(t.points, c.edges, targets));
}

TEST(DoNoHarm, NoLeastAngleFalls) {
  for (unsigned seed = 1; seed <= 4; ++seed)
    for (const test::Triangles& t : {test::grid(12, mountain, .1, seed), test::grid(12, mountain, .3, seed),
                                     test::sphere(2, .35, seed)}) {
      const Outcome o = remeshed(t);
      EXPECT_FALSE(o.result.near_regular && min_angle(t.points, t.faces) < 35);
      EXPECT_GE(min_angle(o.points, t.faces), min_angle(t.points, t.faces));
    }
}

TEST(EdgeTargets, AreReachedWhereAMeshWithTheseLengthsLiesOnTheSurface) {
  const test::Triangles wanted = test::grid(9, test::flat, .2, 3), t = test::grid(9, test::flat, .3, 5);
  TriMesh mesh = test::with_length(t, natural(t));
  const MemoryOrder memory_order = find_memory_order(mesh);
  const Adjacency& c = *memory_order.adjacency;
  std::vector<double> lengths;
  const Mat3X points = memory_order.order.gather(wanted.points);
  for (const auto& [v, w] : c.edges) lengths.push_back((points.col(v) - points.col(w)).norm());
  set_edge_values(mesh, edge_length_property, memory_order.order, c, lengths);
  RemeshOptions options;
  options.altitude = 0;
  options.polish_angles = false;
  const auto farthest = [&] { return (vertex_points(mesh) - wanted.points).colwise().norm().maxCoeff(); };
  const double before = farthest();
  EXPECT_FALSE(remesh(mesh, options).near_regular);
  EXPECT_LT(farthest(), 1e-3 * before);
  options.connectivity = ConnectivityMode::flip;
  EXPECT_THROW(remesh(mesh, options), Error);
}

TEST(DoNoHarm, VerticesTravelWhereLengthsAreToDiffer) {
  const test::Triangles t = test::sphere(3);
  TriMesh mesh = test::with_length(t, natural(t));
  VProp<double> length(mesh, target_length_property);
  for (const auto v : mesh.vertices()) length[v] *= 2.5 + 1.5 * mesh.point(v)[2];
  EXPECT_FALSE(remesh(mesh, {}).near_regular);
  EXPECT_GT((vertex_points(mesh) - t.points).colwise().norm().maxCoeff(), natural(t));
}

using test::natural, test::Outcome, test::remeshed, test::with_length;

test::Triangles jittered_grid() {
  return test::grid(9, wave, .35, 4);
}
test::Triangles jittered_sphere() {
  return test::sphere(2, .35, 4);
}
/// A jittered plane of equilateral triangles would be perfect; this is the perfect one.
test::Triangles equilateral_grid(int n) {
  test::Triangles t = test::grid(n, test::flat);
  for (auto x : t.points.colwise()) x = Vec3(x[0] - .5 * x[1], std::sqrt(.75) * x[1], 0);
  return t;
}

/// The outward normals must not be hidden by the surface: here the input's own say where outside is.
int flipped_faces(const test::Triangles& before, const Mat3X& after) {
  const Adjacency c = test::connect(before);
  const auto surface =
      SurfaceField(std::make_shared<const Mat3X>(before.points), std::make_shared<const Adjacency>(c))
          .surface();
  int count = 0;
  for (const Triangle& t : before.faces) {
    Vec3 normal = Vec3::Zero();
    for (int v : t) normal += surface(after.col(v), v, 1e-9).normal;
    count += test::area_vector(after, t).dot(normal) <= 0;
  }
  return count;
}

double deviation(const test::Triangles& t, const Mat3X& points) {
  const Adjacency c = test::connect(t);
  const std::vector<double> one(c.vertex_count, 1);
  return relative_edge_deviation(points, c.edges, spread_target_lengths(c, one));
}

double largest_move(const Mat3X& a, const Mat3X& b) {
  return (a - b).colwise().norm().maxCoeff();
}

/// Largest distance of the points to the field that the input stands for, in target lengths.
double off_the_field(const test::Triangles& t, const Mat3X& points, const RemeshOptions& options) {
  const TriMesh mesh = with_length(t, natural(t));
  const Workspace w(mesh, find_memory_order(mesh), options.constraints, options.filter,
                    RunOptions(options).retraction);
  Mat3X x(3, points.cols());
  for (Eigen::Index v = 0; v < x.cols(); ++v)
    x.col(v) = (points.col(w.order.old_vertex[v]) - w.normalisation.centre) / w.normalisation.unit;
  return largest_move(
      w.retraction->project_all(x, w.vertices.positions.hints, w.vertices.positions.segments).points, x);
}

double off_the_faces(const test::Triangles& t, const Mat3X& points) {
  double worst = 0;
  for (const auto& x : points.colwise()) {
    double least = 1e300;
    for (const auto& [a, b, c] : t.faces)
      least = std::min(least,
                       closest_point(x, t.points.col(a), t.points.col(b), t.points.col(c)).squared_distance);
    worst = std::max(worst, std::sqrt(least));
  }
  return worst;
}

class RemeshLaws : public testing::TestWithParam<bool> {
 protected:
  test::Triangles input_ = GetParam() ? jittered_sphere() : jittered_grid();
  double L_ = natural(input_);
};
INSTANTIATE_TEST_SUITE_P(On, RemeshLaws, testing::Values(true, false),
                         [](const auto& i) { return i.param ? "Sphere" : "Grid"; });

TEST_P(RemeshLaws, TrianglesGetBetterAndNoneFlips) {
  const Outcome o = remeshed(input_);
  EXPECT_GT(min_angle(o.points, input_.faces), min_angle(input_.points, input_.faces) + 5);
  EXPECT_LT(deviation(input_, o.points), .5 * deviation(input_, input_.points));
  EXPECT_EQ(flipped_faces(input_, o.points), 0);
  EXPECT_EQ(o.result.reason, StopReason::stalled);
}

TEST_P(RemeshLaws, IdsAndConnectivityStay) {
  const Outcome o = remeshed(input_);
  EXPECT_EQ(triangles_of(o.mesh), input_.faces);
  EXPECT_EQ(o.mesh.n_vertices(), input_.points.cols());
  EXPECT_EQ(vertex_values(o.mesh, target_length_property), std::vector<double>(input_.points.cols(), L_));
}

TEST_P(RemeshLaws, CornersStayBitForBitAndBoundariesOnTheirPolylines) {
  const Outcome o = remeshed(input_);
  const Constraints c = find_constraints(input_.points, test::connect(input_), {});
  for (size_t v = 0; v < c.freedom.size(); ++v) {
    const auto i = static_cast<Eigen::Index>(v);
    if (c.freedom[v] == Freedom::fixed) {
      EXPECT_EQ(o.points.col(i), input_.points.col(i));
    }
    if (c.freedom[v] == Freedom::curve) {
      EXPECT_LT(test::distance_to(c.curves[c.curve[v]], o.points.col(i)), 1e-14);
    }
  }
}

TEST(Remesh, OneThreadAndTwoGiveTheSameBits) {
  const test::Triangles large = test::grid(70, wave, .35);  // more than one block in every loop
  std::vector<Mat3X> points;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    points.push_back(remeshed(large).points);
  }
  EXPECT_EQ(points[0], points[1]);
}

TEST_P(RemeshLaws, APowerOfTwoScalesTheResultExactly) {
  const Mat3X points = remeshed(input_).points;
  for (double scale : {1024., 1. / 4096}) {
    test::Triangles scaled = input_;
    scaled.points *= scale;
    EXPECT_EQ(remeshed(scaled, scale * L_).points, scale * points);
  }
}

TEST_P(RemeshLaws, TheResultMovesAndScalesWithTheInput) {
  const test::Triangles result{remeshed(input_).points, input_.faces};
  for (double scale : {1., 7.}) {
    const Outcome o = remeshed(test::moved(input_, scale), scale * L_);
    EXPECT_LT(largest_move(o.points, test::moved(result, scale).points), 1e-3 * scale * L_);
  }
}

TEST_P(RemeshLaws, EveryVertexLiesOnTheFieldOfTheInput) {
  for (FilterKind kind : {FilterKind::local, FilterKind::global})
    for (Refit refit : {Refit::each, Refit::once})
      for (double lazy : {0., .05, .3}) {
        RemeshOptions chosen;
        chosen.filter.kind = kind;
        chosen.refit = refit;
        RunOptions options(chosen);
        options.retraction.lazy = lazy;
        const Outcome o = remeshed(input_, options);
        EXPECT_LT(off_the_field(input_, o.points, chosen), 1e-5);
        EXPECT_GT(min_angle(o.points, input_.faces), min_angle(input_.points, input_.faces) + 5);
        if (kind == FilterKind::global) break;  // dense fits take their time
      }
}

TEST_P(RemeshLaws, TheClosestPointFilterKeepsToTheFaces) {
  RemeshOptions chosen;
  chosen.filter.kind = FilterKind::closest;
  RunOptions options(chosen);
  options.retraction.lazy = 0;
  const Outcome o = remeshed(input_, options);
  EXPECT_LT(off_the_faces(input_, o.points), 1e-9 * L_);
  EXPECT_LT(deviation(input_, o.points), .6 * deviation(input_, input_.points));
  EXPECT_EQ(flipped_faces(input_, o.points), 0);
  EXPECT_GT(o.result.projection.calls, 0);
  EXPECT_EQ(o.result.projection.evaluations, 0);
}

TEST_P(RemeshLaws, WithoutAFilterVerticesStayWhereTheTangentsLead) {
  RemeshOptions options;
  options.filter.kind = FilterKind::none;
  const Outcome o = remeshed(input_, options);
  EXPECT_LT(deviation(input_, o.points), .6 * deviation(input_, input_.points));
  EXPECT_GT(off_the_field(input_, o.points, {}), 1e-3);
  EXPECT_TRUE(o.points.allFinite());
}

TEST_P(RemeshLaws, StopsWithAValidMeshWheneverTheObserverSaysSo) {
  RunOptions patient{RemeshOptions()};
  patient.integration.energy_drop = 1e-5;
  int total = 0;
  remeshed(input_, L_, patient, [&](const Progress&) { return ++total > 0; });
  ASSERT_GT(total, 5);
  for (int last : {1, 2, total / 3, total / 2, total - 1}) {
    int calls = 0;
    const Outcome o = remeshed(input_, L_, patient, [&](const Progress&) { return ++calls < last; });
    EXPECT_EQ(calls, last);
    EXPECT_EQ(o.result.reason, StopReason::interrupted);
    EXPECT_EQ(flipped_faces(input_, o.points), 0);
    EXPECT_EQ(triangles_of(o.mesh), input_.faces);
    EXPECT_LT(off_the_field(input_, o.points, {}), 1e-5);
    EXPECT_LT(deviation(input_, o.points), deviation(input_, input_.points));
  }
}

TEST_P(RemeshLaws, TheObserverIsToldWhereTheWorkStands) {
  std::vector<std::string> stages;
  int outer = 0;
  const Outcome o = remeshed(input_, L_, {}, [&](const Progress& p) {
    if (stages.empty() || stages.back() != p.stage) stages.emplace_back(p.stage);
    EXPECT_GE(p.outer, outer);
    outer = p.outer;
    return true;
  });
  ASSERT_FALSE(stages.empty());
  EXPECT_EQ(stages.front(), "relax");
  ASSERT_FALSE(o.result.iterations.empty());
  const IterationRecord& last = o.result.iterations.back();
  EXPECT_STREQ(last.stage, "polish");
  EXPECT_NEAR(last.min_angle, min_angle(o.points, input_.faces), 1e-6);
  EXPECT_GT(last.field_evaluations, 0);
  for (const IterationRecord& record : o.result.iterations)
    EXPECT_GE(record.max_length_error, record.rms_length_error);
}

TEST_P(RemeshLaws, OneOuterIterationMeansOne) {
  RemeshOptions options;
  options.max_outer = 1;
  options.polish_angles = false;
  EXPECT_EQ(remeshed(input_, options).result.iterations.size(), 1u);
}

TEST_P(RemeshLaws, ASecondRunHardlyMovesTheResult) {
  const Mat3X once = remeshed(input_).points;
  const Mat3X twice = remeshed({once, input_.faces}, L_).points;
  EXPECT_LT(largest_move(once, twice), .2 * L_);
}

TEST_P(RemeshLaws, EdgesFollowGradedTargets) {
  TriMesh mesh = with_length(input_, L_);
  VProp<double> length(mesh, target_length_property);
  const double low = input_.points.row(0).minCoeff(), high = input_.points.row(0).maxCoeff();
  for (const auto v : mesh.vertices()) length[v] = L_ * (.8 + .4 * (mesh.point(v)[0] - low) / (high - low));
  const Adjacency c = test::connect(input_);
  const TargetLengths targets = spread_target_lengths(c, vertex_values(mesh, target_length_property));
  remesh(mesh, {});
  EXPECT_LT(relative_edge_deviation(vertex_points(mesh), c.edges, targets),
            relative_edge_deviation(remeshed(input_).points, c.edges, targets));
}

TEST(Remesh, PerfectMeshesHardlyMove) {
  for (const test::Triangles& t :
       {equilateral_grid(6), test::equilateral(), test::tetrahedron(), test::sphere(0)}) {
    const Outcome o = remeshed(t);
    EXPECT_LT(largest_move(o.points, t.points), 1e-5 * natural(t));
    EXPECT_GT(min_angle(o.points, t.faces), min_angle(t.points, t.faces) - 1e-9);
    EXPECT_EQ(o.result.folded_before, 0);
  }
}

TEST(Remesh, HandsBackThePointsOfTheInput) {
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt}) {
    const test::Triangles t = test::sphere(2, .3, 2);
    TriMesh mesh = build_mesh(t.points, test::connect(t));
    set_vertex_values(mesh, target_length_property, std::vector<double>(t.points.cols(), natural(t)));
    RemeshOptions options;
    options.connectivity = mode;
    const RemeshResult result = remesh(mesh, options);
    EXPECT_EQ(result.input_points, t.points);
    EXPECT_NE(vertex_points(mesh).leftCols(20), t.points.leftCols(20));
  }
}

TEST(Remesh, SmallMeshesWork) {
  const test::Triangles sliver = test::triangles({{0, 0, 0}, {3, 0, 0}, {.1, .2, 0}}, {{0, 1, 2}});
  for (const test::Triangles& t : {sliver, test::shaken(test::tetrahedron(), .3), test::cube()})
    for (BoundaryRule rule : {BoundaryRule::slide, BoundaryRule::fixed, BoundaryRule::free}) {
      RemeshOptions options;
      options.constraints.boundary = rule;
      const Outcome o = remeshed(t, options);
      EXPECT_TRUE(o.points.allFinite());
      for (const Triangle& face : t.faces) EXPECT_GT(test::area_vector(o.points, face).norm(), 0);
    }
}

TEST(Remesh, TheBoundaryRuleDecidesWhetherABoundaryMoves) {
  test::Triangles t = jittered_grid();
  t.points(0, 4) += .04;  // an unevenly sampled boundary
  const Constraints fixed = find_constraints(t.points, test::connect(t), {.boundary = BoundaryRule::fixed});
  for (BoundaryRule rule : {BoundaryRule::fixed, BoundaryRule::slide, BoundaryRule::free}) {
    RemeshOptions options;
    options.constraints.boundary = rule;
    const Mat3X points = remeshed(t, options).points;
    int moved = 0;
    for (size_t v = 0; v < fixed.freedom.size(); ++v)
      moved += fixed.freedom[v] == Freedom::fixed &&
               points.col(static_cast<Eigen::Index>(v)) != t.points.col(static_cast<Eigen::Index>(v));
    EXPECT_EQ(moved, rule == BoundaryRule::fixed ? 0 : rule == BoundaryRule::slide ? 32 : 36);
  }
}

TEST(Remesh, GivenVerticesStayBitForBit) {
  const test::Triangles t = jittered_sphere();
  RemeshOptions options;
  options.constraints.fixed_vertices = {5, 77, 160};
  const Mat3X points = remeshed(t, options).points;
  const Mat3X all_free = remeshed(t).points;
  for (int v : options.constraints.fixed_vertices) {
    EXPECT_EQ(points.col(v), t.points.col(v));
    EXPECT_NE(all_free.col(v), t.points.col(v));
  }
}

TEST(Remesh, ComponentsDoNotFeelEachOther) {
  test::Triangles sphere = jittered_sphere();
  sphere.points.colwise() += Vec3(0, 0, 9);
  const test::Triangles two = test::both(jittered_grid(), sphere);
  const Outcome o = remeshed(two);
  EXPECT_EQ(flipped_faces(two, o.points), 0);
  EXPECT_GT(min_angle(o.points, two.faces), min_angle(two.points, two.faces) + 3);
  EXPECT_LT(off_the_field(two, o.points, {}), 1e-5);
}

TEST(Remesh, SeveralBoundaryLoopsWork) {
  test::Triangles t = test::grid(12, wave, .3);
  std::erase_if(t.faces, [&](const Triangle& f) {
    const Vec3 middle = (t.points.col(f[0]) + t.points.col(f[1]) + t.points.col(f[2])) / 3;
    return (middle.head(2) - Eigen::Vector2d(.3, .3)).norm() < .15 ||
           (middle.head(2) - Eigen::Vector2d(.7, .65)).norm() < .15;
  });
  const Outcome o = remeshed(t);
  EXPECT_EQ(flipped_faces(t, o.points), 0);
  EXPECT_LT(deviation(t, o.points), deviation(t, t.points));
  const Constraints c = find_constraints(t.points, test::connect(t), {});
  for (size_t v = 0; v < c.freedom.size(); ++v)
    if (c.freedom[v] == Freedom::fixed) {
      EXPECT_EQ(o.points.col(static_cast<Eigen::Index>(v)), t.points.col(static_cast<Eigen::Index>(v)));
    }
}

TEST(Remesh, VerticesWithoutFacesStayBitForBit) {
  test::Triangles t = jittered_sphere();
  const Eigen::Index n = t.points.cols();
  t.points.conservativeResize(3, n + 3);
  t.points.rightCols(3) << .1, 5, -.3, .2, 1. / 3, -.7, .3, 0, .1;
  for (FilterKind kind : {FilterKind::local, FilterKind::closest, FilterKind::none}) {
    RemeshOptions options;
    options.filter.kind = kind;
    const Outcome o = remeshed(t, options);
    EXPECT_EQ(o.points.rightCols(3), t.points.rightCols(3));
    EXPECT_LT(deviation(t, o.points), .6 * deviation(t, t.points));
  }
}

TEST(Remesh, AVertexWithoutFacesMayBeAnywhere) {
  test::Triangles t = jittered_sphere();
  const Eigen::Index n = t.points.cols();
  t.points.conservativeResize(3, n + 1);
  t.points.col(n) = Vec3(.1, 0, 0);
  const Outcome near = remeshed(t);
  for (const double far : {1e6, 1e12, 1e20}) {
    t.points.col(n) = Vec3(far, 0, 0);
    const Outcome o = remeshed(t);
    EXPECT_LT((o.points - near.points).leftCols(n).cwiseAbs().maxCoeff(), 1e-6) << far;
    EXPECT_EQ(o.points.col(n), t.points.col(n)) << far;
  }
}

TEST(Remesh, FacesWithoutAreaAreOpened) {
  test::Triangles t = test::grid(8, test::flat, .1);
  const auto [a, b, c] = t.faces[60];
  t.points.col(c) = .5 * (t.points.col(a) + t.points.col(b));
  ASSERT_LT(min_angle(t.points, t.faces), 1e-6);
  const Outcome o = remeshed(t);
  EXPECT_GT(o.result.folded_before, 0);
  EXPECT_GT(min_angle(o.points, t.faces), 25);
  for (const Triangle& face : t.faces) EXPECT_GT(test::area_vector(o.points, face)[2], 0);
}

TEST(Remesh, VerticesInOnePlacePart) {
  test::Triangles t = test::grid(8, test::flat, .1);
  t.points.col(40) = t.points.col(41);
  const Outcome o = remeshed(t);
  EXPECT_GT(min_angle(o.points, t.faces), 25);
}

TEST(Remesh, ConvergesWhereEveryEdgeCanHaveItsLength) {
  test::Triangles t = equilateral_grid(6);
  const Mat3X perfect = t.points;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-.04, .04);
  const Constraints c = find_constraints(t.points, test::connect(t), {});
  for (size_t v = 0; v < c.freedom.size(); ++v)
    if (c.freedom[v] == Freedom::surface)
      t.points.col(static_cast<Eigen::Index>(v)) += Vec3(shift(random), shift(random), 0);
  RemeshOptions options;
  options.tolerance = .02;
  const Outcome o = remeshed(t, 1. / 6, options);
  EXPECT_EQ(o.result.reason, StopReason::converged);
  EXPECT_LT(largest_move(o.points, perfect), .05 / 6);
}

}  // namespace hooke::remesh_test
