#include "hooke/filter/surface_field.h"

#include <gtest/gtest.h>

#include <random>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/partition_of_unity.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/sagitta.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::surface_field_test {

/// A cone of so many faces about vertex 0, and a strip around it.
test::Triangles hub(int valence) {
  test::Triangles t{Mat3X(3, 1 + 2 * valence), {}};
  t.points.col(0) = Vec3(0, 0, .3);
  for (int k = 0; k < valence; ++k) {
    const double angle = 2 * std::numbers::pi * k / valence;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    t.points.col(1 + k) = out;
    t.points.col(1 + valence + k) = 1.2 * out - .2 * Vec3::UnitZ();
    const int next = (k + 1) % valence;
    t.faces.push_back({0, 1 + k, 1 + next});
    t.faces.push_back({1 + k, 1 + valence + k, 1 + valence + next});
    t.faces.push_back({1 + k, 1 + valence + next, 1 + next});
  }
  return t;
}

double squared_distance_to_all(const test::Triangles& t, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : t.faces)
    least =
        std::min(least, closest_point(x, t.points.col(a), t.points.col(b), t.points.col(c)).squared_distance);
  return least;
}

TEST(NearFaces, NoFaceAboutTheAnchorIsCloser) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  for (const test::Triangles& t : {hub(60), hub(5), test::shaken(test::grid(2, test::flat), .2)}) {
    const Adjacency c = test::connect(t);
    const Mat3X normals = vertex_normals(t.points, c);
    const NearFaces faces{t.points, normals, c};
    for (int round = 0; round < 300; ++round) {
      const Vec3 x(coordinate(random), coordinate(random), coordinate(random));
      // All faces of a cone are about its tip or a neighbour of it; so are those of a grid of two by two.
      const int hint = t.faces.size() == 8 ? 4 : 0;
      const Projection projection = faces.closest_point(x, hint);
      EXPECT_EQ(projection.status, ProjectionStatus::converged);
      EXPECT_NEAR((projection.point - x).squaredNorm(), squared_distance_to_all(t, x), 1e-12);
      EXPECT_NEAR(projection.normal.norm(), 1, 1e-12);
    }
  }
}

TEST(NearFaces, AFaceWithinADistanceIsNoFartherThanTheClosestOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  const test::Triangles t = test::shaken(test::grid(4, test::flat), .1);
  const Adjacency c = test::connect(t);
  const Mat3X normals = vertex_normals(t.points, c);
  const NearFaces faces{t.points, normals, c};
  int within = 0;
  for (int round = 0; round < 300; ++round) {
    const Vec3 x(coordinate(random), coordinate(random), .1 * coordinate(random));
    const Projection projection = faces.closest_point(x, 12);
    const double distance = (projection.point - x).norm();
    EXPECT_FALSE(faces.has_face_within(x, 12, .999 * distance));
    within += faces.has_face_within(x, projection.hint, 1.001 * distance);  // on one of its faces
  }
  EXPECT_EQ(within, 300);
}

TEST(NearFaces, AnAnchorWithoutFacesHasNoProjection) {
  test::Triangles t = test::equilateral();
  t.points.conservativeResize(3, 4);
  t.points.col(3) = Vec3(5, 5, 5);
  const Adjacency c = test::connect(t);
  const Mat3X normals = vertex_normals(t.points, c);
  const Projection projection = NearFaces{t.points, normals, c}.closest_point(Vec3(1, 2, 3), 3);
  EXPECT_EQ(projection.status, ProjectionStatus::no_cover);
  EXPECT_EQ(projection.point, Vec3(1, 2, 3));
}

std::shared_ptr<const Adjacency> shared_connectivity(const test::Triangles& t) {
  return std::make_shared<const Adjacency>(make_adjacency(static_cast<int>(t.points.cols()), t.faces));
}

SurfaceField field_of(const test::Triangles& t, const FilterOptions& options = {}) {
  return SurfaceField(std::make_shared<const Mat3X>(t.points), shared_connectivity(t), options);
}

struct Start {
  Vec3 point;
  int hint;
};

/// Random points on the faces, moved along the face normals by up to `off`.
std::vector<Start> starts_near(const test::Triangles& t, double off, int per_face = 1) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Start> starts;
  for (const auto& [a, b, c] : t.faces)
    for (int i = 0; i < per_face; ++i) {
      double u = unit(random), v = unit(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 p = t.points.col(a), ab = t.points.col(b) - p, ac = t.points.col(c) - p;
      starts.push_back({p + u * ab + v * ac + (2 * unit(random) - 1) * off * ab.cross(ac).normalized(), a});
    }
  return starts;
}

double mean_edge(const test::Triangles& t) {
  const auto c = shared_connectivity(t);
  double sum = 0;
  for (const auto& [a, b] : c->edges) sum += (t.points.col(a) - t.points.col(b)).norm();
  return sum / static_cast<double>(c->edges.size());
}

test::Triangles joined(const test::Triangles& a, const test::Triangles& b) {
  test::Triangles t{Mat3X(3, a.points.cols() + b.points.cols()), a.faces};
  t.points << a.points, b.points;
  const int shift = static_cast<int>(a.points.cols());
  for (const auto& [i, j, k] : b.faces) t.faces.push_back({i + shift, j + shift, k + shift});
  return t;
}

class EveryField : public testing::TestWithParam<FilterOptions> {};
INSTANTIATE_TEST_SUITE_P(SurfaceField, EveryField,
                         testing::Values(FilterOptions{FilterKind::local, Kernel::r2logr, .3},
                                         FilterOptions{FilterKind::local, Kernel::r3, .3},
                                         FilterOptions{FilterKind::global, Kernel::r2logr, .02},
                                         FilterOptions{FilterKind::global, Kernel::r3, .3}));

TEST_P(EveryField, IsZeroAtEveryVertex) {
  for (const auto& t : {test::sphere(2, .3), test::grid(12, test::paraboloid, .4)}) {
    const SurfaceField field = field_of(t, GetParam());
    const auto c = shared_connectivity(t);
    const double h = mean_edge(t);
    for (int v = 0; v < c->vertex_count; ++v) {
      const FieldSample s = field.sample(t.points.col(v), v);
      EXPECT_LT(std::abs(s.value), 1e-10 * h);
      EXPECT_GT(s.gradient.dot(field.normals().col(v)), .8);
      for (int n : c->vertex_neighbours[v])  // other patches: they agree, but not to the last digit
        EXPECT_LT(std::abs(field.sample(t.points.col(v), n).value), 1e-3 * h);
    }
  }
}

TEST_P(EveryField, FindsTheSphereBetweenItsVertices) {
  const auto t = test::sphere(3, .3);
  const double h = mean_edge(t);
  const SurfaceField field = field_of(t, GetParam());
  double sum = 0;
  const auto starts = starts_near(t, .2 * h);
  for (const Start& s : starts) {
    const Projection projection = field.project(s.point, s.hint, 1e-8 * h);
    ASSERT_EQ(projection.status, ProjectionStatus::converged);
    EXPECT_LT(std::abs(field.sample(projection.point, projection.hint).value), 2e-8 * h);
    EXPECT_NEAR(projection.normal.dot(projection.point), 1, 1e-3);
    EXPECT_LT((projection.point - s.point.normalized()).norm(), .01 * h);
    sum += std::pow(projection.point.norm() - 1, 2);
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(starts.size())), 5e-4 * h);
}

TEST_P(EveryField, FindsAPlaneExactly) {
  const auto t = test::grid(10, test::flat, .4);
  const SurfaceField field = field_of(t, GetParam());
  for (const Start& s : starts_near(t, .02)) {
    const Projection projection = field.project(s.point, s.hint, 1e-14);
    EXPECT_EQ(projection.status, ProjectionStatus::converged);
    EXPECT_LT((projection.point - Vec3(s.point[0], s.point[1], 0)).norm(), 1e-11);
    EXPECT_LT((projection.normal - Vec3::UnitZ()).norm(), 1e-9);
  }
}

TEST_P(EveryField, HasSaneProjectionsAtOpenBoundaries) {
  const int n = 12;
  const auto t = test::grid(n, test::paraboloid, .3);
  const SurfaceField field = field_of(t, GetParam());
  for (int i = 0; i < n; ++i) {
    const double along = (i + .5) / n;
    const Vec3 x(along, 0, test::paraboloid(along, 0) + .3 / n);
    const Projection projection = field.project(x, i, 1e-9);
    EXPECT_EQ(projection.status, ProjectionStatus::converged);
    EXPECT_LT(std::abs(projection.point[2] - test::paraboloid(projection.point[0], projection.point[1])),
              .02 / n);
    EXPECT_GT(projection.normal.dot(Vec3(-x[0], 0, 1).normalized()), .99);
  }
}

TEST_P(EveryField, MovesAndTurnsWithTheMesh) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, .5).normalized()).toRotationMatrix();
  const Vec3 shift(3, -4, 5);
  for (const auto& t : {test::sphere(2), test::sphere(2, .3), test::grid(12, test::paraboloid)}) {
    test::Triangles moved = t;
    moved.points = (turn * t.points).colwise() + shift;
    const SurfaceField field = field_of(t, GetParam()), moved_field = field_of(moved, GetParam());
    for (const Start& s : starts_near(t, .02)) {
      const Projection projection = field.project(s.point, s.hint, 1e-12);
      const Projection there = moved_field.project(turn * s.point + shift, s.hint, 1e-12);
      EXPECT_LT((turn * projection.point + shift - there.point).norm(), 1e-9);
      EXPECT_LT((turn * projection.normal - there.normal).norm(), 1e-8);
    }
  }
}

TEST_P(EveryField, ScalesExactlyByPowersOfTwo) {
  const auto t = test::sphere(2, .3);
  for (double scale : {1024., 1 / 4096.}) {
    test::Triangles scaled = t;
    scaled.points *= scale;
    const SurfaceField field = field_of(t, GetParam()), scaled_field = field_of(scaled, GetParam());
    for (const Start& s : starts_near(t, .02)) {
      const Projection projection = field.project(s.point, s.hint, 1e-7);
      const Projection there = scaled_field.project(scale * s.point, s.hint, scale * 1e-7);
      EXPECT_EQ(there.point, scale * projection.point);
      EXPECT_EQ(there.normal, projection.normal);
    }
  }
}

TEST_P(EveryField, DoesNotDependOnTheNumberOfThreads) {
  const auto t = test::sphere(3, .3);
  const auto projections = [&](int threads) {
    const ThreadLimit limit(threads);
    const SurfaceField field = field_of(t, GetParam());
    std::vector<Projection> result;
    for (const Start& s : starts_near(t, .02)) result.push_back(field.project(s.point, s.hint, 1e-7));
    return result;
  };
  const auto one = projections(1), many = projections(4);
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].point, many[i].point);
    EXPECT_EQ(one[i].normal, many[i].normal);
  }
}

TEST(SurfaceField, KeepsCloseSheetsApart) {
  const auto lower = test::grid(24, test::paraboloid, .3);
  auto upper = lower;
  const double h = mean_edge(lower);
  upper.points.row(2).array() += .3 * h;
  for (Triangle& f : upper.faces) std::swap(f[1], f[2]);
  const auto t = joined(lower, upper);
  const SurfaceField field = field_of(t);
  const int on_lower = static_cast<int>(lower.points.cols());
  for (const Start& s : starts_near(t, .25 * h, 3)) {
    const bool is_lower = s.hint < on_lower;
    const Projection projection = field.project(s.point, s.hint, 1e-6 * h);
    EXPECT_EQ(projection.hint < on_lower, is_lower);
    const double height = projection.point[2] - test::paraboloid(projection.point[0], projection.point[1]);
    EXPECT_NEAR(height, is_lower ? 0 : .3 * h, .03 * h);
    EXPECT_GT((is_lower ? 1 : -1) * projection.normal[2], 0);
  }
}

TEST(SurfaceField, WorksOnTheSmallestComponents) {
  test::Triangles triangle{Mat3X(3, 3), {{0, 1, 2}}};
  triangle.points << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  test::Triangles tetrahedron{Mat3X(3, 4), {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  tetrahedron.points << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  tetrahedron.points.array() += 10;
  const auto strip = test::grid(2, test::paraboloid);
  const auto t = joined(joined(triangle, tetrahedron), joined(test::sphere(0), strip));
  const SurfaceField field = field_of(t);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
    const Vec3 p = t.points.col(v);
    const Projection projection = field.project(p, static_cast<int>(v), 1e-9);
    EXPECT_LT((projection.point - p).norm(), 1e-9) << v;
  }
  const Projection projection = field.project({.3, .3, .1}, 0, 1e-12);
  EXPECT_LT((projection.point - Vec3(.3, .3, 0)).norm(), 1e-12);
}

TEST(SurfaceField, OfDegenerateFacesFallsBackToTheFacesThemselves) {
  test::Triangles t{Mat3X(3, 5), {{0, 1, 2}, {0, 2, 3}}};
  t.points << 0, 1, 2, 3, 9, 0, 0, 0, 0, 9, 0, 0, 0, 0, 9;  // all faces on a line; vertex 4 has none
  const SurfaceField field = field_of(t);
  const Projection projection = field.project({.5, 1, 0}, 0, 1e-9);
  EXPECT_NE(projection.status, ProjectionStatus::converged);
  EXPECT_LT((projection.point - Vec3(.5, 0, 0)).norm(), 1e-15);
  const Projection lonely = field.project({9, 9, 8}, 4, 1e-9);
  EXPECT_EQ(lonely.status, ProjectionStatus::no_cover);
  EXPECT_EQ(lonely.point, Vec3(9, 9, 8));
  EXPECT_TRUE(lonely.normal.isZero(0));
}

TEST(SurfaceField, SurvivesDoubledVerticesAndFoldedFaces) {
  auto t = test::grid(12, test::paraboloid, .3);
  t.points.col(6 * 13 + 6) = t.points.col(6 * 13 + 7);  // two faces collapse
  t.points.col(3 * 13 + 3) +=
      1.6 * (t.points.col(3 * 13 + 4) - t.points.col(3 * 13 + 3));  // a ring folds over
  const double h = 1 / 12.;
  const SurfaceField field = field_of(t);
  for (const Start& s : starts_near(test::grid(12, test::paraboloid, .3), .1 * h)) {
    const Projection projection = field.project(s.point, s.hint, 1e-6 * h);
    EXPECT_LT(std::abs(projection.point[2] - test::paraboloid(projection.point[0], projection.point[1])),
              .05 * h);
    EXPECT_GT(projection.normal[2], 0);
  }
}

TEST(SurfaceField, FarFromTheSurfaceAnswersWithTheClosestPointAndSaysSo) {
  const auto t = test::sphere(2, .2);
  const Projection projection = field_of(t).project({3, .2, .1}, 0, 1e-9);
  EXPECT_EQ(projection.status, ProjectionStatus::no_cover);
  const Projection closest = field_of(t, {.kind = FilterKind::closest}).project({3, .2, .1}, 0, 1e-9);
  EXPECT_EQ(projection.point, closest.point);
  EXPECT_EQ(projection.normal, closest.normal);
  EXPECT_NEAR(projection.normal.norm(), 1, 1e-12);
}

test::Triangles lens(double height) {
  test::Triangles t = test::sphere(2);
  t.points.row(2) *= height;
  return t;
}

TEST(SurfaceField, ClosestToAPointOfAFaceIsThePointWhicheverCornerItIsTrackedAt) {
  for (const double height : {.3, .02}) {
    const auto t = lens(height);
    const SurfaceField field = field_of(t, {.kind = FilterKind::closest});
    for (const Triangle& face : t.faces)
      for (const Vec3& weights : {Vec3(1, 1, 1), Vec3(4, 1, 1), Vec3(1, 8, 2), Vec3(1, 1, 30)}) {
        Vec3 x = Vec3::Zero();
        for (int k = 0; k < 3; ++k) x += weights[k] / weights.sum() * t.points.col(face[k]);
        for (int hint : face) ASSERT_LT((field.project(x, hint, 1e-9).point - x).norm(), 1e-12);
      }
  }
}

TEST(SurfaceField, ClosestStaysOnItsSideOfAThinBody) {
  const auto t = lens(.02);
  const SurfaceField field = field_of(t, {.kind = FilterKind::closest});
  for (int v = 0; v < t.points.cols(); ++v) {
    const Vec3 top = t.points.col(v);
    if (top.z() < .015) continue;
    const Projection projection =
        field.project(top - Vec3(0, 0, 1.2 * top.z()), v, 1e-9);  // nearer the other side
    EXPECT_GT(projection.point.z(), 0);
    EXPECT_GT(projection.normal.z(), 0);
  }
}

TEST(SurfaceField, ClosestIsThatOfAllFaces) {
  const auto t = test::sphere(2, .3);
  const SurfaceField field = field_of(t, {.kind = FilterKind::closest});
  for (const Start& s : starts_near(t, .1)) {
    double least = INFINITY;
    for (const auto& [a, b, c] : t.faces)
      least = std::min(
          least, closest_point(s.point, t.points.col(a), t.points.col(b), t.points.col(c)).squared_distance);
    const Projection projection = field.project(s.point, 0, 1e-9);  // whatever the hint it comes from
    EXPECT_NEAR((projection.point - s.point).norm(), std::sqrt(least), 1e-12);
    EXPECT_EQ(projection.status, ProjectionStatus::converged);
    EXPECT_NEAR(field.sample(s.point, projection.hint).value,
                (projection.point.dot(projection.normal) < s.point.dot(projection.normal) ? 1 : -1) *
                    std::sqrt(least),
                1e-12);
  }
}

/// A sphere whose cap is cut off and closed by long triangles about one vertex.
test::Triangles capped_sphere() {
  test::Triangles t = test::sphere(3);
  const int opposite_vertex = 0;
  const double height = .6;
  const auto gone = [&](int v) { return t.points(2, v) > height; };
  t.points.col(opposite_vertex) = Vec3(0, 0, 1);
  std::vector<Triangle> faces;
  for (Triangle face : t.faces) {
    const auto of_cap = std::ranges::count_if(face, gone);
    if (of_cap > 1) continue;
    for (int& v : face)
      if (gone(v)) v = opposite_vertex;
    faces.push_back(face);
  }
  t.points.col(opposite_vertex) = Vec3(0, 0, height);
  return {t.points, faces};
}

TEST(SurfaceField, StaysWithinReachOfTheFaces) {
  const auto t = capped_sphere();
  const Adjacency c = *shared_connectivity(t);
  const std::vector<double> sagittas = face_sagittas(edge_arcs(t.points, c), c);
  const double h = mean_edge(t), sagitta = *std::ranges::max_element(sagittas);
  const SurfaceField faces = field_of(t, {.kind = FilterKind::closest});
  for (double max_deviation : {.3 * h, .6 * h}) {
    const SurfaceField limited = field_of(t, {.max_deviation = max_deviation});
    for (const Start& s : starts_near(t, .01 * h, 20)) {
      const Projection projection = limited.project(s.point, s.hint, 1e-9);
      EXPECT_LE((faces.project(projection.point, projection.hint, 1e-9).point - projection.point).norm(),
                (1 + 1e-6) * std::max(max_deviation, 2 * sagitta));
    }
  }
}

/// The side of a cylinder of 32 sides and its radius 1, whose only vertices lie on the two rims.
test::Triangles long_facets() {
  constexpr int sides = 32;
  test::Triangles t;
  t.points.resize(3, 2 * sides);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    t.points.col(2 * i) << std::cos(angle), std::sin(angle), -3;
    t.points.col(2 * i + 1) << std::cos(angle), std::sin(angle), 3;
    const int a = 2 * i, b = 2 * ((i + 1) % sides);
    t.faces.push_back({a, b, b + 1});
    t.faces.push_back({a, b + 1, a + 1});
  }
  return t;
}

TEST(SurfaceField, LongFacetsAreArcsAndStraightAlongTheirRulings) {
  const auto t = long_facets();
  const SurfaceField field = field_of(t);
  const double sagitta = 1 - std::cos(std::numbers::pi / 32);
  for (int i = 0; i < 60; ++i) {
    const double angle = .1 * i, z = -2.9 + .09 * i;
    const Vec3 x((1 - .5 * sagitta) * std::cos(angle), (1 - .5 * sagitta) * std::sin(angle), z);
    int hint = 0;
    (t.points.colwise() - x).colwise().squaredNorm().minCoeff(&hint);
    const Projection projection = field.project(x, hint, 1e-9);
    EXPECT_LE(projection.point.head(2).norm(), 1 + .1 * sagitta);
    EXPECT_GE(projection.point.head(2).norm(), 1 - 1.01 * sagitta);
    EXPECT_NEAR(projection.point[2], z, 1e-9);
  }
}

/// Where all vertices lie in two rows, a spline fits them with anything between the rows.
TEST(SurfaceField, OfVerticesInTwoRowsDoesNotFitTheirRounding) {
  constexpr int facets = 28;
  const auto half_pipe = [](double rounding) {
    test::Triangles t;
    t.points.resize(3, 2 * facets + 2);
    for (int i = 0; i <= facets; ++i) {
      const double angle = .1 * i;
      t.points.col(2 * i) << 44 * std::cos(angle), 0, 44 * std::sin(angle);
      t.points.col(2 * i + 1) << 44 * std::cos(angle), 10, 44 * std::sin(angle);
    }
    for (int a = 0; a < 2 * facets; a += 2) {
      t.faces.push_back({a, a + 1, a + 3});
      t.faces.push_back({a, a + 3, a + 2});
    }
    std::mt19937 random(5);
    std::uniform_real_distribution<double> shift(-rounding, rounding);
    for (double& x : t.points.reshaped()) x += shift(random);
    return t;
  };
  const auto radii = [&](double rounding) {
    const test::Triangles t = half_pipe(rounding);
    const SurfaceField field = field_of(t);
    std::vector<double> found;
    for (double angle = .05; angle < 2.8; angle += .1)
      for (double y = 1; y < 10; ++y) {
        const Vec3 x(44 * std::cos(angle), y, 44 * std::sin(angle));
        int hint = 0;
        (t.points.colwise() - x).colwise().squaredNorm().minCoeff(&hint);
        const Vec3 point = field.project(x, hint, 1e-9).point;
        found.push_back(std::hypot(point[0], point[2]));
      }
    return found;
  };
  const double sagitta = 44 * (1 - std::cos(.05));
  const std::vector<double> exact = radii(0);
  EXPECT_LE(*std::ranges::max_element(exact), 44 + 3 * sagitta);
  for (const double rounding : {1e-9, 1e-6, 1e-4}) {
    const std::vector<double> rounded = radii(rounding);
    double farthest = 0;
    for (size_t i = 0; i < exact.size(); ++i) farthest = std::max(farthest, std::abs(rounded[i] - exact[i]));
    EXPECT_LE(farthest, .3 * sagitta) << rounding;
  }
}

/// Its side is a cylinder up to z = 15, where the surface bends to a cone; nothing holds a spline between.
TEST(SurfaceField, RisesOverLongFacetsNoMoreThanAnArcOverTheBendAtTheirEnd) {
  const test::Triangles t = test::reducer(64);
  const SurfaceField field = field_of(t);
  const double bend = std::atan(.4), sagitta = .5 * std::hypot(4, 10) * std::tan(bend / 4);
  for (double z = .5; z < 15; z += .5) {
    const Vec3 x = 10 * Vec3(std::cos(.7), std::sin(.7), 0) + Vec3(0, 0, z);
    int hint = 0;
    (t.points.colwise() - x).colwise().squaredNorm().minCoeff(&hint);
    const Projection projection = field.project(x, hint, 1e-9);
    EXPECT_NEAR(projection.point.head(2).norm(), 10, 1.05 * sagitta) << z;
  }
}

TEST(SurfaceField, ReachCountsInTheLengthsOfTheVertices) {
  const auto t = capped_sphere();
  const double h = mean_edge(t);
  const std::vector<double> lengths(t.points.cols(), h);
  const SurfaceField a = field_of(t, {.max_deviation = .5 * h});
  const SurfaceField b(std::make_shared<const Mat3X>(t.points), shared_connectivity(t), {.max_deviation = .5},
                       {}, lengths);
  for (const Start& s : starts_near(t, .01 * h))
    EXPECT_LT((a.project(s.point, s.hint, 1e-9).point - b.project(s.point, s.hint, 1e-9).point).norm(),
              1e-6 * h);
}

TEST(SurfaceField, NoneLeavesPointsAlone) {
  const SurfaceField field = field_of(test::sphere(1), {.kind = FilterKind::none});
  const Projection projection = field.project({0, 0, 1.5}, 0, 1e-9);
  EXPECT_EQ(projection.point, Vec3(0, 0, 1.5));
  EXPECT_GT(projection.normal[2], .8);
}

TEST(SurfaceField, GlobalRefusesWhatItCannotDo) {
  const auto t = test::sphere(2);
  EXPECT_THROW(field_of(t, {.kind = FilterKind::global, .memory_limit_bytes = 1000}), LimitError);
  test::Triangles point = t;
  point.points.setOnes();
  EXPECT_THROW(field_of(point, {.kind = FilterKind::global}), NumericalError);
}

TEST(SurfaceField, SurfaceOutlivesItsField) {
  const Surface surface = field_of(test::sphere(2)).surface();  // the field is gone
  EXPECT_NEAR(surface({1.05, 0, 0}, 0, 1e-9).point.norm(), 1, 1e-3);
}

TEST(PartitionOfUnity, LeavesNoVertexWithoutAPatchAndFitsThemAllAsWanted) {
  const auto t = test::sphere(3, .3);
  const auto c = shared_connectivity(t);
  const Mat3X normals = vertex_normals(t.points, *c);
  const PartitionOfUnity psi(t.points, *c, normals, mean_edge_lengths(t.points, *c));
  EXPECT_EQ(psi.count(PatchFit::as_requested), psi.patch_count());
  EXPECT_LT(psi.memory_bytes() / 642, 500u);
  for (int v = 0; v < c->vertex_count; ++v) EXPECT_NEAR(psi(t.points.col(v), v).gradient.norm(), 1, .1);
}

}  // namespace hooke::surface_field_test
