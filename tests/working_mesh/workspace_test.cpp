#include "hooke/working_mesh/workspace.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "hooke/filter/retraction.h"
#include "hooke/filter/surface_field.h"
#include "hooke/integrator/final_projection.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/remesh.h"
#include "support/scene.h"

namespace hooke::workspace_test {

TriMesh with_length(const test::Triangles& t, double length) {
  TriMesh mesh = test::to_mesh(t);
  set_vertex_values(mesh, target_length_property, length);
  return mesh;
}

TriMesh with_natural_length(const test::Triangles& t) {
  return with_length(t, natural_length(total_area(t.points, t.faces), t.faces.size()));
}

test::Triangles wavy() {
  const auto wave = [](double x, double y) { return .1 * std::sin(5 * x) * std::cos(4 * y); };
  return test::grid(8, wave, .3);
}

Workspace on(const TriMesh& mesh, const FilterOptions& filter = {}) {
  return Workspace(mesh, find_memory_order(mesh), {}, filter, {});
}

/// Moves the vertices by up to a twentieth of a target length in each direction.
void shake(Workspace& w) {
  Mat3X u = test::random_vectors(w.start->cols(), .05);
  w.retraction->constrain(w.vertices.positions, u);
  SurfacePositions to;
  w.retraction->step(w.vertices.positions, u, to);
  w.vertices.positions = to;
}

/// Largest distance of the points to the field of the input.
double off_the_input(const TriMesh& input, const Mat3X& points) {
  const Workspace w = on(input);
  const SurfacePositions p =
      w.retraction->project_all(points, w.vertices.positions.hints, w.vertices.positions.segments);
  return (p.points - points).colwise().norm().maxCoeff();
}

TEST(Workspace, IsCentredAndHasAMeanTargetLengthOfOne) {
  const Workspace w = on(with_length(test::moved(wavy(), 40), 5));
  EXPECT_LT((w.start->rowwise().minCoeff() + w.start->rowwise().maxCoeff()).norm(), 1e-12);
  EXPECT_EQ(w.vertices.vertex_length, std::vector<double>(81, 1));
  EXPECT_EQ(w.normalisation.unit, 5);
}

TEST(Workspace, TheMeshIsTheInputInAnotherOrder) {
  const test::Triangles t = test::moved(wavy());
  const Workspace w = on(with_natural_length(t));
  for (size_t f = 0; f < w.adjacency->faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const int fresh = w.adjacency->faces[f][k], old = t.faces[w.order.old_face[f]][k];
      EXPECT_EQ(w.order.old_vertex[fresh], old);
      const Vec3 x = w.normalisation.centre + w.normalisation.unit * w.start->col(fresh);
      EXPECT_LT((x - t.points.col(old)).norm(), 1e-14);
    }
}

TEST(Workspace, APowerOfTwoChangesNoBit) {
  test::Triangles large = wavy();
  large.points *= 1024;
  const Workspace a = on(with_length(wavy(), .125)), b = on(with_length(large, 128));
  EXPECT_EQ(*a.start, *b.start);
  EXPECT_TRUE(test::same(a.vertices.positions, b.vertices.positions));
}

TEST(Workspace, TheOrderDoesNotDependOnCoordinates) {
  const Workspace a = on(with_natural_length(wavy()));
  const Workspace b = on(with_natural_length(test::moved(test::shaken(wavy(), .02), 3)));
  EXPECT_EQ(a.order.old_vertex, b.order.old_vertex);
  EXPECT_EQ(a.order.old_face, b.order.old_face);
}

TEST(Workspace, VerticesOfTheInputLieOnItsField) {
  for (const test::Triangles& t : {wavy(), test::sphere(2, .2)}) {
    const Workspace w = on(with_natural_length(t));
    EXPECT_LT((w.vertices.positions.points - *w.start).colwise().norm().maxCoeff(), 1e-6);
  }
}

TEST(Workspace, UntouchedVerticesComeBackBitForBit) {
  const test::Triangles t = test::moved(wavy(), 1. / 3);
  TriMesh mesh = with_natural_length(t);
  Workspace w = on(mesh);
  w.vertices.positions.points = *w.start;
  w.vertices.positions.points.col(17) += Vec3(1, 2, 3);
  w.copy_back(mesh);
  const int moved = w.order.old_vertex[17];
  for (int v = 0; v < t.points.cols(); ++v)
    if (v != moved) {
      EXPECT_EQ(vertex_points(mesh).col(v), t.points.col(v));
    }
  EXPECT_LT(
      (vertex_points(mesh).col(moved) - t.points.col(moved) - w.normalisation.unit * Vec3(1, 2, 3)).norm(),
      1e-14);
}

TEST(FinalProjection, EndsOnTheFieldOfTheInput) {
  const TriMesh mesh = with_natural_length(wavy());
  Workspace w = on(mesh);
  FinalProjection projection(w, {});
  for (int turn = 0; turn < 3; ++turn) {
    shake(w);
    projection.project();
    projection.refit();
    shake(w);
    EXPECT_GT(off_the_input(mesh, w.vertices.positions.points), 1e-4);  // off the field of the input
    const int stay = projection.project();
    EXPECT_EQ(stay, 0);
    EXPECT_LT(off_the_input(mesh, w.vertices.positions.points), 1e-5);
  }
}

TEST(FinalProjection, TakesUpWhatMovedSince) {
  const TriMesh mesh = with_natural_length(wavy());
  Workspace w = on(mesh);
  FinalProjection projection(w, {});
  shake(w);
  projection.refit();
  EXPECT_TRUE(w.refitted());
  projection.project();
  w.return_to_input();
  EXPECT_FALSE(w.refitted());
  const SurfacePositions projected = w.vertices.positions;
  const std::vector<int> some = {30, 31, 40};  // of the inside
  w.retraction->step(projected, test::random_vectors(w.start->cols(), .05), some, w.vertices.positions);
  const SurfacePositions moved = w.vertices.positions;
  EXPECT_EQ(projection.project(some), 0);
  for (int v = 0; v < w.adjacency->vertex_count; ++v) {
    const bool is_one = std::ranges::count(some, v) > 0;
    EXPECT_EQ(w.vertices.positions.points.col(v) == projected.points.col(v), !is_one) << v;
    EXPECT_LT((w.vertices.positions.points.col(v) - moved.points.col(v)).norm(), 1e-4);
  }
  const Mat3X points = w.vertices.positions.points;
  projection.project();  // is there already
  EXPECT_LT((w.vertices.positions.points - points).colwise().norm().maxCoeff(), 1e-9);
}

TEST(Workspace, ShortTargetsMakeNoPolyhedronOfARoundBody) {
  const auto t = test::sphere(1);
  const double natural = natural_length(total_area(t.points, t.faces), t.faces.size());
  Workspace w = on(with_length(t, .1 * natural), RemeshOptions{}.filter);
  for (const Triangle& f : w.adjacency->faces) {
    const Vec3 centre = (w.start->col(f[0]) + w.start->col(f[1]) + w.start->col(f[2])) / 3;
    const SurfacePosition place =
        w.retraction->moved(w.vertices.positions, f[0], centre - w.start->col(f[0]));
    EXPECT_NEAR((w.normalisation.centre + w.normalisation.unit * place.point).norm(), 1, .02);
  }
}

TEST(Workspace, RefittingMovesNothing) {
  Workspace w = on(with_natural_length(test::sphere(2, .2)));
  shake(w);
  const Mat3X before = w.vertices.positions.points;
  w.refit();
  EXPECT_LT((w.vertices.positions.points - before).colwise().norm().maxCoeff(), 1e-6);
}

TEST(Workspace, ReturnsToTheFieldOfTheInput) {
  const TriMesh mesh = with_natural_length(wavy());
  Workspace w = on(mesh);
  shake(w);
  w.refit();
  shake(w);
  w.vertices.positions = w.project_to_input();
  const long long calls = w.projection_counts().calls;
  w.return_to_input();
  EXPECT_EQ(w.projection_counts().calls, calls);
  shake(w);
  EXPECT_LT(off_the_input(mesh, w.vertices.positions.points), 1e-5);
}

TEST(Workspace, CountsTheProjectionsOfAllFields) {
  Workspace w = on(with_natural_length(wavy()));
  long long calls = w.projection_counts().calls;
  EXPECT_EQ(calls, 81);
  shake(w);
  w.refit();
  w.vertices.positions = w.project_to_input();
  EXPECT_EQ(w.projection_counts().calls, calls + 77 + 81 + 81);  // the four corners do not move
}

TEST(Workspace, WithoutTargetLengthsThereIsAnError) {
  EXPECT_THROW(on(test::to_mesh(test::cube())), Error);
}

TEST(Workspace, VerticesTakeUpTheTargetLengthsOfTheirPlaces) {
  test::Triangles t = test::grid(8, test::flat, .3);
  TriMesh mesh = test::to_mesh(t);
  const auto length = [](const Vec3& p) { return .1 * (1 + p[0]); };
  std::vector<double> lengths;
  for (const auto p : t.points.colwise()) lengths.push_back(length(p));
  set_vertex_values(mesh, target_length_property, lengths);
  Workspace w = on(mesh);
  shake(w);
  w.resample_lengths();
  w.copy_back(mesh);
  const std::vector<double> resampled = vertex_values(mesh, target_length_property);
  const auto points = vertex_points(mesh);
  EXPECT_NE(resampled, lengths);
  for (size_t v = 0; v < resampled.size(); ++v)
    EXPECT_NEAR(resampled[v], length(points.col(static_cast<Eigen::Index>(v))), 1e-9);
}

TEST(Workspace, EqualTargetLengthsStayToTheLastBit) {
  TriMesh mesh = with_length(wavy(), .1);
  Workspace w = on(mesh);
  const std::vector<double> lengths = w.vertices.vertex_length;
  shake(w);
  w.resample_lengths();
  EXPECT_EQ(w.vertices.vertex_length, lengths);
  w.copy_back(mesh);
  EXPECT_EQ(vertex_values(mesh, target_length_property), std::vector<double>(lengths.size(), .1));
}

}  // namespace hooke::workspace_test
