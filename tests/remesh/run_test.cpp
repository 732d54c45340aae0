// Runs that go on from their results: only what is near shorter target lengths is made anew.
#include "hooke/remesh/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/memory_order.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/run_options.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::run_test {

const Vec3 pole(0, 0, 1);

/// A sphere, adapted, of which the run goes on with shorter lengths near the pole.
class GoesOn : public testing::Test {
 protected:
  static RunOptions options() {
    RemeshOptions options;
    options.connectivity = ConnectivityMode::adapt;
    options.effort = Effort::fast;
    options.map = true;
    return RunOptions(options);
  }

  void SetUp() override {
    mesh_ = input_;
    before_ = run_.remesh(mesh_);
    points_ = vertex_points(mesh_);
  }

  /// Of the vertices of the input in memory order: a share of their lengths within the distance of the pole.
  std::vector<double> shorter(double share, double distance) const {
    const Mat3X points = order_.order.gather(vertex_points(input_));
    std::vector<double> lengths(points.cols(), length_);
    for (Eigen::Index v = 0; v < points.cols(); ++v)
      if ((points.col(v) - pole).norm() < distance) lengths[v] *= share;
    return lengths;
  }

  const test::Triangles t_ = test::sphere(3, .2);
  const double length_ = test::natural(t_);
  const TriMesh input_ = test::with_length(t_, length_);
  const MemoryOrder order_ = find_memory_order(input_);
  const Observer observer_;
  hooke::Run run_{input_, order_, options(), observer_, nullptr};
  TriMesh mesh_;
  RemeshResult before_;
  Mat3X points_;
};

TEST_F(GoesOn, OnlyNearShorterLengths) {
  TriMesh next = input_;
  const auto result = run_.go_on(next, before_, {}, points_, shorter(.5, .4));
  ASSERT_TRUE(result);
  EXPECT_LT(run_.share_of_last(), .5);
  const Mat3X after = vertex_points(next);
  std::set<std::array<double, 3>> places;
  for (const auto& x : after.colwise()) places.insert({x[0], x[1], x[2]});
  int stay = 0, far = 0;
  for (const auto& x : points_.colwise()) {
    if (x[2] > 0) continue;
    ++far;
    stay += static_cast<int>(places.contains({x[0], x[1], x[2]}));
  }
  EXPECT_EQ(stay, far);
  EXPECT_GT(far, 100);
  EXPECT_GT(next.n_faces(), mesh_.n_faces());
  EXPECT_GT(min_angle(after, triangles_of(next)), 25);
  const auto near_pole = [](const TriMesh& mesh) {
    const Mat3X points = vertex_points(mesh);
    double sum = 0, count = 0;
    for (const auto e : mesh.edges()) {
      const Vec3 a = points.col(e.v0().idx()), b = points.col(e.v1().idx());
      if (((a + b) / 2 - pole).norm() > .3) continue;
      sum += (a - b).norm();
      ++count;
    }
    return sum / count;
  };
  EXPECT_NEAR(near_pole(next) / near_pole(mesh_), .5, .1);
}

TEST_F(GoesOn, TellsAllThatWasDone) {
  TriMesh next = input_;
  const auto result = run_.go_on(next, before_, {}, points_, shorter(.5, .4));
  ASSERT_TRUE(result);
  EXPECT_GT(result->adaptation.splits, before_.adaptation.splits);
  EXPECT_EQ(result->adaptation.levels, before_.adaptation.levels);
  ASSERT_GT(result->iterations.size(), before_.iterations.size());
  EXPECT_TRUE(std::ranges::is_sorted(result->iterations, {}, &IterationRecord::seconds));
  EXPECT_EQ(result->map.size(), next.n_vertices());
  // No vertex is said to be limited by more than a free one on a sphere may be.
  constexpr int of_held = limited_by_boundary | limited_by_crease | limited_at_corner | limited_by_request |
                          VertexLimit::put_back;
  EXPECT_TRUE(std::ranges::none_of(result->vertex_limits,
                                   [](unsigned char limits) { return (limits & of_held) != 0; }));
  EXPECT_EQ(run_.results(), 2);
}

TEST_F(GoesOn, FromWhereVerticesWerePlacedSince) {
  Eigen::Index far = 0;
  points_.row(2).minCoeff(&far);
  points_.col(far) *= 1.001;
  TriMesh next = input_;
  ASSERT_TRUE(run_.go_on(next, before_, {static_cast<int>(far)}, points_, shorter(.5, .4)));
  const Mat3X after = vertex_points(next);
  double nearest = 1;
  for (const auto& x : after.colwise()) nearest = std::min(nearest, (x - points_.col(far)).norm());
  EXPECT_LT(nearest, 1e-12);
}

TEST_F(GoesOn, AgainAndAgain) {
  RemeshResult result = before_;
  std::size_t faces = mesh_.n_faces();
  for (const double share : {.7, .5, .35}) {
    TriMesh next = input_;
    auto further = run_.go_on(next, result, {}, points_, shorter(share, .4));
    ASSERT_TRUE(further) << share;
    EXPECT_GT(next.n_faces(), faces) << share;
    EXPECT_GT(min_angle(vertex_points(next), triangles_of(next)), 20) << share;
    faces = next.n_faces();
    points_ = vertex_points(next);
    result = std::move(*further);
  }
}

TEST_F(GoesOn, NotWhereNothingOrMostWouldChange) {
  TriMesh next = input_;
  EXPECT_FALSE(run_.go_on(next, before_, {}, points_, shorter(1, 4)));
  hooke::Run other(input_, order_, options(), observer_, nullptr);
  TriMesh mesh = input_;
  const RemeshResult before = other.remesh(mesh);
  EXPECT_FALSE(other.go_on(next, before, {}, vertex_points(mesh), shorter(.5, 4)));
}

TEST_F(GoesOn, NearShorterLengthsWithinFaces) {
  TriMesh next = input_;
  const auto result = run_.go_on(next, before_, {}, points_, shorter(1, 1), {{pole, pole, .4 * length_}});
  ASSERT_TRUE(result);
  EXPECT_LT(run_.share_of_last(), .2);
  double nearest = 4;
  for (const auto e : next.edges()) {
    const Vec3 a = vertex_points(next).col(e.v0().idx()), b = vertex_points(next).col(e.v1().idx());
    if ((.5 * (a + b) - pole).norm() < .5 * length_) nearest = std::min(nearest, (a - b).norm());
  }
  EXPECT_LT(nearest, .6 * length_);
  EXPECT_GT(min_angle(vertex_points(next), triangles_of(next)), 20);
}

/// A drum of long facets, with creases around its caps, open or closed.
test::Triangles drum(bool is_open) {
  test::Triangles t = test::drum(16, 1);
  if (is_open) t.faces.resize(32);  // its sides
  return t;
}

TEST(GoesOnBesideCreases, WhichStayAsTheyAre) {
  constexpr double length = .25;
  const Observer observer;
  for (const bool is_open : {false, true}) {
    const TriMesh input = test::with_length(drum(is_open), length);
    const MemoryOrder order = find_memory_order(input);
    RemeshOptions options;
    options.connectivity = ConnectivityMode::adapt;
    options.effort = Effort::fast;
    hooke::Run run(input, order, RunOptions(options), observer, nullptr);
    TriMesh mesh = input, next = input;
    const RemeshResult before = run.remesh(mesh);
    const Vec3 rim(1, 0, 0);
    const auto result = run.go_on(next, before, {}, vertex_points(mesh),
                                  std::vector<double>(input.n_vertices(), length), {{rim, rim, .3 * length}});
    ASSERT_TRUE(result) << is_open;
    EXPECT_GT(next.n_faces(), mesh.n_faces()) << is_open;
    EXPECT_EQ(result->creases.sharp, before.creases.sharp) << is_open;
    EXPECT_EQ(result->crease_edges.empty(), is_open);
    EXPECT_GE(result->crease_edges.size(), before.crease_edges.size()) << is_open;
    EXPECT_GT(min_angle(vertex_points(next), triangles_of(next)), 15) << is_open;
    const auto rims = [](const TriMesh& m, const RemeshResult& r) {
      const Mat3X points = vertex_points(m);
      double sum = 0;
      for (const auto& [a, b] : r.crease_edges) sum += (points.col(a) - points.col(b)).norm();
      for (const auto e : m.edges())
        if (e.is_boundary()) sum += (points.col(e.v0().idx()) - points.col(e.v1().idx())).norm();
      return sum;
    };
    EXPECT_NEAR(rims(next, *result), rims(mesh, before), .02 * rims(mesh, before)) << is_open;
  }
}

TEST_F(GoesOn, UntilItIsStopped) {
  int calls = 0, last_call = 1 << 30;
  const Observer observer = [&](const Progress&) { return ++calls < last_call; };
  hooke::Run run(input_, order_, options(), observer, nullptr);
  TriMesh mesh = input_, next = input_;
  const RemeshResult before = run.remesh(mesh);
  last_call = calls + 2;
  const auto result = run.go_on(next, before, {}, vertex_points(mesh), shorter(.5, .4));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->reason, StopReason::interrupted);
  EXPECT_TRUE(vertex_points(next).allFinite());
  EXPECT_EQ(result->map.size(), next.n_vertices());
}

}  // namespace hooke::run_test
