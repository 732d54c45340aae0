#include "hooke/remesh/mending.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "hooke/remesh/attempts.h"
#include "hooke/remesh/limiting_factors.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::mending_test {

/// A sphere, and a run on it to be damaged.
class Sphere {
 public:
  explicit Sphere(std::optional<double> max_distance = {})
      : mesh_(test::with_length(t_, test::natural(t_))),
        maker(mesh_, memory_order_, options_, {.max_distance = max_distance}, {}, observer_, nullptr, false) {
    run = maker.run();
    maker.judge(run);
    EXPECT_EQ(run.flaws(), 0u);
  }

  const Adjacency& connectivity() const { return *run.result.memory_order.adjacency; }
  Mat3X points() const { return run.result.memory_order.order.gather(vertex_points(run.mesh)); }

  /// Moves vertices away from the centre.
  void raise(const std::vector<int>& vertices, double height) {
    const Mat3X x = points();
    for (int v : vertices) maker.place(v, x.col(v) + height * x.col(v).normalized(), run);
    maker.judge(run);
  }

  /// Moves a vertex beyond its neighbours, so that faces there are turned over.
  void turn_over_at(int vertex) {
    const Mat3X x = points();
    const int n = connectivity().vertex_neighbours[vertex][0];
    maker.place(vertex, x.col(n) + .6 * (x.col(n) - x.col(vertex)), run);
    maker.judge(run);
  }

  /// Moves a vertex nearly onto the edge across from it in one of its faces.
  void squeeze_at(int vertex) {
    const Adjacency& c = connectivity();
    const Mat3X x = points();
    Vec3 middle = Vec3::Zero();
    for (int v : c.faces[c.vertex_faces[vertex][0]])
      middle += v == vertex ? Vec3::Zero().eval() : x.col(v) / 2;
    maker.place(vertex, x.col(vertex) + .95 * (middle - x.col(vertex)), run);
    maker.judge(run);
  }

  void watch(Observer observer) { observer_ = std::move(observer); }

  void hold(int vertex) {
    run.result.vertex_limits[run.result.memory_order.order.old_vertex[vertex]] |= limited_by_request;
  }

 private:
  const test::Triangles t_ = test::sphere(3, .2, 1);
  TriMesh mesh_;
  const MemoryOrder memory_order_ = find_memory_order(mesh_);
  const RemeshOptions options_;  // mode `fixed`
  Observer observer_;

 public:
  AttemptMaker maker;
  Attempt run;
};

/// How many vertices the mending has moved that are farther than these rings from the vertex.
int moved_far_from(int vertex, int rings, const Mat3X& before, const Sphere& sphere) {
  const Adjacency& c = sphere.connectivity();
  std::vector<char> is_near(c.vertex_count, 0);
  is_near[vertex] = 1;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> inner = is_near;
    for (int v = 0; v < c.vertex_count; ++v)
      if (inner[v])
        for (int n : c.vertex_neighbours[v]) is_near[n] = 1;
  }
  const Mat3X after = sphere.points();
  int count = 0;
  for (int v = 0; v < c.vertex_count; ++v) count += !is_near[v] && after.col(v) != before.col(v);
  return count;
}

TEST(Mending, TurnsFacesBackAndMovesNothingElse) {
  for (int vertex : {5, 60, 200, 400}) {
    Sphere sphere;
    sphere.turn_over_at(vertex);
    const Mat3X before = sphere.points();
    ASSERT_GT(sphere.run.preservation().flipped_faces, 0u);
    mend(sphere.maker, sphere.run);
    EXPECT_EQ(sphere.run.flaws(), 0u);
    EXPECT_EQ(moved_far_from(vertex, 4, before, sphere), 0);
  }
}

TEST(Mending, FarVerticesComeOnlyAsNearAsTheyMust) {
  for (int vertex : {5, 60, 200}) {
    Sphere sphere;
    const Vec3 there = sphere.points().col(vertex);
    sphere.raise({vertex}, .3);
    ASSERT_EQ(sphere.run.preservation().far_vertices.size(), 1u);
    const FarVertex far = sphere.run.preservation().far_vertices[0];
    mend(sphere.maker, sphere.run);
    EXPECT_EQ(sphere.run.flaws(), 0u);
    const double distance = (sphere.points().col(vertex) - there).norm();
    EXPECT_LT(distance, far.limit);
    EXPECT_GT(distance, .8 * far.limit);
  }
}

TEST(Mending, UnfoldsRidges) {
  for (int vertex : {5, 60, 200}) {
    Sphere sphere(10.);  // no vertex is far
    const double length = test::natural(test::sphere(3, .2, 1));
    sphere.raise({vertex, sphere.connectivity().vertex_neighbours[vertex][0]}, 1.5 * length);
    ASSERT_GT(sphere.run.preservation().new_folds, 0u);
    mend(sphere.maker, sphere.run);
    EXPECT_EQ(sphere.run.flaws(), 0u);
  }
}

TEST(Mending, NewSliversGoBackAndNothingElse) {
  for (int vertex : {5, 60, 200, 400}) {
    Sphere sphere;
    const double angle = sphere.run.angle;
    sphere.squeeze_at(vertex);
    ASSERT_LT(sphere.run.angle, 8);
    ASSERT_EQ(sphere.run.flaws(), 0u);
    const Mat3X before = sphere.points();
    take_back_slivers(sphere.maker, sphere.run);
    EXPECT_GT(sphere.run.angle, .8 * std::min(20., angle)) << vertex;
    EXPECT_EQ(sphere.run.flaws(), 0u);
    EXPECT_EQ(moved_far_from(vertex, 1, before, sphere), 0);
  }
}

TEST(Mending, SliversThatTheInputHasStay) {
  Sphere sphere;
  sphere.squeeze_at(60);
  const TriMesh squeezed = sphere.run.mesh;
  const MemoryOrder memory_order = find_memory_order(squeezed);
  const RemeshOptions options;
  const Observer observer;
  const AttemptMaker maker(squeezed, memory_order, options, {}, {}, observer, nullptr, false);
  Attempt run = sphere.run;
  maker.judge(run);
  const Mat3X before = vertex_points(run.mesh);
  take_back_slivers(maker, run);
  EXPECT_EQ(vertex_points(run.mesh), before);
}

TEST(Mending, SliversOnCreasesGoAllTheWayBack) {
  Sphere sphere;
  const int vertex = 60, id = sphere.run.result.memory_order.order.old_vertex[vertex];
  sphere.squeeze_at(vertex);
  sphere.run.result.vertex_limits[id] |= limited_by_crease;
  for (int n : sphere.connectivity().vertex_neighbours[vertex])
    sphere.run.result.vertex_limits[sphere.run.result.memory_order.order.old_vertex[n]] |= limited_by_crease;
  take_back_slivers(sphere.maker, sphere.run);
  EXPECT_EQ(vertex_points(sphere.run.mesh).col(id), vertex_points(sphere.maker.mesh()).col(id));
}

TEST(Mending, SliversOfFlippedFacesStay) {
  Sphere sphere;
  sphere.maker.options.connectivity = ConnectivityMode::flip;
  sphere.squeeze_at(60);
  const Mat3X before = sphere.points();
  take_back_slivers(sphere.maker, sphere.run);
  EXPECT_EQ(sphere.points(), before);
}

TEST(Mending, MendsOnePlaceWhereItCannotMendAnother) {
  const int held = 60, free = 400;
  Sphere sphere;
  sphere.turn_over_at(held);
  sphere.hold(held);
  for (int n : sphere.connectivity().vertex_neighbours[held]) {
    sphere.hold(n);
    for (int m : sphere.connectivity().vertex_neighbours[n]) sphere.hold(m);
  }
  const std::size_t at_held = sphere.run.flaws();
  const Vec3 place = sphere.points().col(held);
  sphere.turn_over_at(free);
  ASSERT_GT(sphere.run.flaws(), at_held);
  mend(sphere.maker, sphere.run);
  EXPECT_EQ(sphere.run.flaws(), at_held);
  EXPECT_TRUE(sphere.points().col(held) == place);
}

TEST(Mending, ThinLensesAreMendedWithoutAnotherRun) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    test::Triangles t = test::sphere(2, .4, seed);
    t.points.row(2) *= .03;
    const TriMesh mesh = test::with_length(t, test::natural(t));
    const MemoryOrder memory_order = find_memory_order(mesh);
    RemeshOptions options;
    options.connectivity = ConnectivityMode::adapt;
    options.effort = Effort::fast;
    const Observer observer;
    const AttemptMaker maker(mesh, memory_order, options, {}, {}, observer, nullptr, false);
    Attempt run = maker.run();
    maker.judge(run);
    ASSERT_GT(run.flaws(), 0u);
    mend(maker, run);
    EXPECT_EQ(run.flaws(), 0u) << seed;
  }
}

TEST(Mending, WhatIsStoppedIsInterruptedAndMovesNothing) {
  Sphere sphere;
  sphere.turn_over_at(60);
  const Mat3X before = sphere.points();
  int calls = 0;
  sphere.watch([&](const Progress&) {
    ++calls;
    return false;
  });
  mend(sphere.maker, sphere.run);
  EXPECT_TRUE(sphere.run.is_interrupted());
  EXPECT_TRUE(sphere.points() == before);
  EXPECT_EQ(calls, 1);
}

TEST(Mending, LeavesAResultThatKeepsItsInput) {
  Sphere sphere;
  const Mat3X before = sphere.points();
  mend(sphere.maker, sphere.run);
  EXPECT_TRUE(sphere.points() == before);
}

TEST(Mending, WhatStandsStillDoesNotKeepItsNeighboursFromBeingMended) {
  constexpr double limit = .05;
  Sphere s(limit);
  const Adjacency& c = s.connectivity();
  constexpr int edge = 70;
  const Edge held = c.edges[edge];
  const Triangle& t = c.faces[c.edge_faces[edge][0]];
  const int third = *std::ranges::find_if(t, [&](int v) { return v != held[0] && v != held[1]; });
  const auto is_apart = [&](int v) {
    const auto neighbours = c.vertex_neighbours[v];
    return std::ranges::none_of(held, [&](int h) { return h == v || std::ranges::count(neighbours, h) > 0; });
  };
  const auto neighbours = c.vertex_neighbours[third];
  const auto apart = std::ranges::find_if(neighbours, is_apart);
  ASSERT_NE(apart, neighbours.end());
  s.raise({held[0], held[1], *apart}, 1.3 * limit);
  for (int v : held) s.hold(v);
  mend(s.maker, s.run);
  const Mat3X x = s.points();
  for (int v : held) EXPECT_GT(x.col(v).norm(), 1 + limit);
  EXPECT_LT(x.col(*apart).norm(), 1 + limit);
}

}  // namespace hooke::mending_test
