#include "hooke/integrator/guards.h"

#include <gtest/gtest.h>

#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/final_projection.h"
#include "hooke/integrator/vertex_ring.h"
#include "support/scene.h"

namespace hooke::guards_test {

const ShapeLimits defaults;

TEST(GuardRules, ACreaseKeepsItsSideOfEachLimit) {
  for (const double limit : {defaults.fold, -defaults.fold}) {
    EXPECT_TRUE(crease_fold_breaks(defaults, limit + .1, limit - .1)) << limit;
    EXPECT_FALSE(crease_fold_breaks(defaults, limit + .1, limit + .01)) << limit;
    EXPECT_FALSE(crease_fold_breaks(defaults, limit - .01, limit - .1)) << limit;
    EXPECT_FALSE(crease_fold_breaks(defaults, limit - .1, limit + .1)) << limit;
  }
}

TEST(GuardRules, ACreaseOnALimitMayFallByLessThanTheSlack) {
  EXPECT_FALSE(crease_fold_breaks(defaults, defaults.fold, defaults.fold - .5 * defaults.slack));
  EXPECT_TRUE(crease_fold_breaks(defaults, defaults.fold, defaults.fold - 2 * defaults.slack));
}

TEST(GuardRules, ASmoothEdgeBelowTheLimitMayOnlyOpen) {
  EXPECT_TRUE(fold_breaks(defaults, .5, defaults.fold - .01));
  EXPECT_FALSE(fold_breaks(defaults, .5, defaults.fold + .01));
  EXPECT_FALSE(fold_breaks(defaults, -.5, -.4));
  EXPECT_TRUE(fold_breaks(defaults, -.5, -.6));
  EXPECT_FALSE(fold_breaks(defaults, -.5, -.5 - .5 * defaults.slack));
}

TEST(GuardRules, AFoldedFaceMayShrinkWhereItTurnsTheRightWay) {
  EXPECT_FALSE(face_breaks(defaults, 1, .01, -.5, -.4));
  EXPECT_TRUE(face_breaks(defaults, 1, .01, -.5, -.5));
  EXPECT_TRUE(face_breaks(defaults, 1, 1, -.5, -.6));
  EXPECT_TRUE(face_breaks(defaults, 1, .19, .9, .9));
  EXPECT_TRUE(face_breaks(defaults, 1, 1, .9, .29));
  EXPECT_FALSE(face_breaks(defaults, 1, .21, .9, .31));
}

TEST(GuardRules, ASagittaAboveItsLimitMayOnlyShrink) {
  const double target = 3;
  EXPECT_FALSE(sagitta_breaks(defaults, target, 0, .99 * defaults.sagitta * target));
  EXPECT_TRUE(sagitta_breaks(defaults, target, 0, 1.01 * defaults.sagitta * target));
  EXPECT_FALSE(sagitta_breaks(defaults, target, 2, 1.9));
  EXPECT_TRUE(sagitta_breaks(defaults, target, 2, 2.1));
}

TEST(GuardRules, OnlyFacesOnTheSurfaceKeepTheirAngles) {
  ShapeLimits o;
  o.cotangent = 2;
  EXPECT_TRUE(angle_breaks(o, .9, 1, 2.1));
  EXPECT_FALSE(angle_breaks(o, .9, 1, 1.9));
  EXPECT_FALSE(angle_breaks(o, .9, 3, 2.5));
  EXPECT_FALSE(angle_breaks(o, -.5, 1, 5));
  EXPECT_FALSE(angle_breaks(defaults, .9, 1, 1e6));
}

/// A grid whose middle vertex is pulled over the edge that faces it: `pull` cells toward +x.
test::Triangles folded_grid(double pull) {
  test::Triangles t = test::grid(4, test::flat);
  t.points(0, 12) += pull / 4;
  return t;
}

/// The rules, written down once more from measures taken here. Returns what breaks.
std::string broken_rule(const test::Scene& s, const SurfacePositions& from, const SurfacePositions& to,
                        const ShapeLimits& o = {}) {
  for (const Triangle& t : s.adjacency.faces) {
    const auto alignment = [&](const SurfacePositions& p) {
      const Vec3 n = test::area_vector(p.points, t);
      return n.normalized().dot(
          (p.normals.col(t[0]) + p.normals.col(t[1]) + p.normals.col(t[2])).normalized());
    };
    const double ratio = test::area_vector(to.points, t).norm() / test::area_vector(from.points, t).norm();
    const bool was_folded = alignment(from) < o.alignment;
    if (!was_folded && ratio < o.area * (1 - 1e-9)) return "area";
    if (!was_folded && alignment(to) < o.alignment - 1e-12) return "alignment";
    const double cotangent = max_cotangent(to.points, t);
    if (!was_folded && cotangent > std::max(max_cotangent(from.points, t), o.cotangent) * (1 + 1e-12))
      return "angle";
    if (was_folded && alignment(to) < alignment(from) - 1.1e-7) return "turned away";
  }
  for (size_t e = 0; e < s.adjacency.edges.size(); ++e) {
    const auto [a, b] = s.adjacency.edges[e];
    const auto sagitta = [a = a, b = b](const SurfacePositions& p) {
      const Vec3 n = p.normals.col(a), m = p.normals.col(b);
      const double theta = std::atan2(n.cross(m).norm(), n.dot(m));
      return .5 * (p.points.col(a) - p.points.col(b)).norm() * std::tan(.25 * theta);
    };
    if (sagitta(to) > std::max(sagitta(from), o.sagitta * s.targets.edge[e]) + 1e-8) return "sagitta";
  }
  return "";
}

TEST(Guards, AlignmentIsTheCosineToTheSurface) {
  const Mat3X p = test::equilateral().points;
  const auto alignment = [&](const Vec3& normal) {
    return face_alignment(p, normal.replicate(1, 3), {0, 1, 2});
  };
  EXPECT_NEAR(alignment(Vec3::UnitZ()), 1, 1e-15);
  EXPECT_NEAR(alignment(-Vec3::UnitZ()), -1, 1e-15);
  EXPECT_NEAR(alignment(Vec3(std::sin(1), 0, std::cos(1))), std::cos(1), 1e-15);
  EXPECT_EQ(face_alignment(p, Vec3::UnitZ().replicate(1, 3), {0, 1, 1}), 0);
}

TEST(Guards, SagittaIsThatOfACircle) {
  for (double theta : {1e-3, .1, 1., 2., 3.}) {
    Mat3X n(3, 2);
    n << -std::sin(theta / 2), std::sin(theta / 2), std::cos(theta / 2), std::cos(theta / 2), 0, 0;
    const double r = 1.7;
    EXPECT_NEAR(edge_sagitta(r * n, n, {0, 1}), r * (1 - std::cos(theta / 2)), 1e-9) << theta;
  }
  EXPECT_EQ(edge_sagitta(Mat3X::Random(3, 2), Mat3X::Ones(3, 2) / std::sqrt(3), {0, 1}), 0);
}

TEST(Guards, DriftedVerticesAreProjectedUnlessThatWouldFoldAFace) {
  constexpr int wild = 40;  // middle of an 8 x 8 grid; its projection lies three cells away
  const Surface surface = [](const Vec3& x, int hint, double) {
    const double jump = hint == wild ? 3. / 8 : 0;
    return Projection{Vec3(x[0] + jump, x[1], 0), Vec3::UnitZ(), hint, ProjectionStatus::converged, 1};
  };
  test::Scene s(test::grid(8, test::flat), test::to_ground);
  Retraction retraction(surface, s.constraints, {});
  SurfacePositions drifted = s.positions, projected;
  for (size_t v = 0; v < drifted.drift.size(); ++v)
    if (s.constraints.freedom[v] == Freedom::surface) {
      drifted.points(2, static_cast<Eigen::Index>(v)) = 1e-3;
      drifted.drift[v] = .01;
    }
  project_drifted(s.guards, retraction, drifted, projected);
  EXPECT_EQ(projected.points.col(wild), drifted.points.col(wild));
  EXPECT_EQ(projected.drift[wild], .01);
  int projected_count = 0;
  for (size_t v = 0; v < drifted.drift.size(); ++v) {
    const auto i = static_cast<Eigen::Index>(v);
    EXPECT_EQ(projected.points(2, i), projected.drift[v] == 0 ? 0 : drifted.points(2, i));
    projected_count += projected.drift[v] == 0;
    EXPECT_EQ(projected.points.col(i).head(2), drifted.points.col(i).head(2));
  }
  EXPECT_GE(projected_count, 81 - 19);  // all but the vertex and its two rings at most
}

TEST(Guards, WhatIsKnownToHaveMovedIsPutBackLikeAll) {
  test::Scene s = test::sphere_scene(.4);
  const std::vector<int> some = {3, 4, 20, 35, 36};
  size_t revert = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Mat3X u = test::random_vectors(s.positions.points.cols(), .8 * s.L(), seed);
    s.retraction.constrain(s.positions, u);
    SurfacePositions to = s.positions;
    s.retraction.step(s.positions, u, some, to);
    SurfacePositions again = to;
    std::vector<int> back = revert_offenders(s.guards, s.positions, to);
    std::vector<int> known = revert_offenders(s.guards, s.positions, some, again);
    revert += back.size();
    EXPECT_EQ(to.points, again.points);
    EXPECT_EQ(to.normals, again.normals);
    std::ranges::sort(back);
    std::ranges::sort(known);
    EXPECT_EQ(back, known);
    EXPECT_TRUE(s.guards.offenders(s.positions, to).empty());
  }
  EXPECT_GT(revert, 0u);
}

TEST(Guards, AnAcceptedStepSatisfiesEveryGuard) {
  const ShapeLimits tight{.area = .8, .alignment = .9, .sagitta = .04, .cotangent = 1.5};
  for (const ShapeLimits& limits : {ShapeLimits{}, tight})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      test::SceneOptions options;
      options.limits = limits;
      test::Scene sphere = test::sphere_scene(.4, options), ground = test::ground_scene(.4, options);
      for (test::Scene* s : {&sphere, &ground}) {
        Mat3X u = test::random_vectors(s->positions.points.cols(), .8 * s->L(), seed);
        s->retraction.constrain(s->positions, u);
        const Mat3X wanted = u;
        SurfacePositions to;
        EXPECT_FALSE(s->guards.step(s->retraction, s->positions, u, to).empty());
        EXPECT_EQ(broken_rule(*s, s->positions, to, limits), "");
        EXPECT_GT((to.points - s->positions.points).norm(), 0);
        for (Eigen::Index v = 0; v < u.cols(); ++v) {
          double part = 1;
          for (int k = 0; k <= 8 && u.col(v) != part * wanted.col(v); ++k) part *= .5;
          EXPECT_TRUE(u.col(v).isZero(0) || u.col(v) == part * wanted.col(v));
        }
        SurfacePositions again;
        s->retraction.step(s->positions, u, again);
        EXPECT_TRUE(test::same(again, to));
      }
    }
}

TEST(Guards, TheUnguardedStepWouldHaveBrokenThem) {
  test::Scene s = test::sphere_scene(.4);
  Mat3X u = test::random_vectors(s.positions.points.cols(), .8 * s.L());
  s.retraction.constrain(s.positions, u);
  SurfacePositions to;
  s.retraction.step(s.positions, u, to);
  EXPECT_NE(broken_rule(s, s.positions, to), "");
}

TEST(Guards, AStepOfZeroAndASmallStepAreTakenAsTheyAre) {
  test::Scene s = test::sphere_scene(.2);
  for (double size : {0., 1e-3}) {
    Mat3X u = size * s.L() * test::random_vectors(s.positions.points.cols(), 1);
    const Mat3X wanted = u;
    SurfacePositions to, unguarded;
    EXPECT_TRUE(s.guards.step(s.retraction, s.positions, u, to).empty());
    EXPECT_EQ(u, wanted);
    s.retraction.step(s.positions, u, unguarded);
    EXPECT_TRUE(test::same(to, unguarded));
  }
}

std::vector<int> folded_faces_of(const test::Scene& s) {
  return s.guards.folded_faces(s.positions);
}

TEST(Guards, NamesFoldedFaces) {
  EXPECT_TRUE(folded_faces_of(test::ground_scene()).empty());
  const test::Scene s(folded_grid(1.5), test::to_ground);
  std::vector<int> folded;
  for (size_t f = 0; f < s.adjacency.faces.size(); ++f)
    if (test::area_vector(s.positions.points, s.adjacency.faces[f])[2] <= 0)
      folded.push_back(static_cast<int>(f));
  ASSERT_FALSE(folded.empty());
  EXPECT_EQ(folded_faces_of(s), folded);
}

TEST(Guards, AFoldedFaceMayOnlyTurnTheRightWay) {
  // The face 0 1 2 on a bent surface leans away; its vertex 2 may lean back but not further away.
  const test::Triangles t = test::equilateral();
  for (double lean : {-.05, .05}) {
    const auto leaning = [&](const Vec3& x, int hint, double) {
      const double angle = 1.5 - (x[1] - .5) * 1.0;  // between the surface's normal and the face
      return Projection{x, Vec3(0, -std::sin(angle), std::cos(angle)), hint, ProjectionStatus::converged, 1};
    };
    test::SceneOptions options;
    options.constraints.boundary = BoundaryRule::free;
    options.limits.sagitta = 10;
    test::Scene s(t, leaning, options);
    ASSERT_EQ(folded_faces_of(s), std::vector<int>{0});
    Mat3X u = Mat3X::Zero(3, 3);
    u(1, 2) = lean;
    SurfacePositions to;
    EXPECT_EQ(s.guards.step(s.retraction, s.positions, u, to).size(), lean > 0 ? 0u : 1u);
    EXPECT_EQ(broken_rule(s, s.positions, to), "");
  }
}

TEST(Guards, AFoldedFaceMayPassThroughZeroArea) {
  test::Scene s(folded_grid(1.5), test::to_ground);
  ASSERT_FALSE(folded_faces_of(s).empty());
  Mat3X u = Mat3X::Zero(3, 25);
  u(0, 12) = -1.5 / 4;
  SurfacePositions to;
  EXPECT_TRUE(s.guards.step(s.retraction, s.positions, u, to).empty());
  EXPECT_TRUE(s.guards.folded_faces(to).empty());
}

/// Moves each vertex alone by a random vector; returns how many were limited by guards.
int limited_moves(test::Scene& s) {
  const Mat3X wanted = test::random_vectors(s.positions.points.cols(), .6 * s.L());
  VertexRing ring(s.coloring.rings, s.targets);
  RingShape before, after;
  int limited = 0;
  for (int v = 0; v < s.adjacency.vertex_count; ++v) {
    Mat3X u = Mat3X::Zero(3, wanted.cols());
    u.col(v) = wanted.col(v);
    ring.gather(s.positions, v);
    ring.shape(s.positions.points.col(v), s.positions.normals.col(v), before);
    SurfacePositions to;
    s.retraction.step(s.positions, u, to);
    ring.shape(to.points.col(v), to.normals.col(v), after);
    const bool obeys = ring.obeys(before, after, s.guards.limits());
    EXPECT_EQ(s.guards.step(s.retraction, s.positions, u, to).empty(), obeys) << v;
    limited += !obeys;
  }
  return limited;
}

TEST(Guards, OneVertexAloneIsJudgedLikeAStepOfAll) {
  test::SceneOptions tight;
  tight.limits = {.area = .8, .alignment = .9, .fold = .9, .sagitta = .04};
  test::Scene scenes[] = {test::sphere_scene(.4), test::ground_scene(.4), test::sphere_scene(.4, tight),
                          test::Scene(folded_grid(1.5), test::to_ground)};
  for (test::Scene& s : scenes) {
    const int limited = limited_moves(s);
    EXPECT_GT(limited, s.adjacency.vertex_count / 20);
    EXPECT_LT(limited, s.adjacency.vertex_count - 2);
  }
}

TEST(Guards, OneThreadAndTwoGiveTheSameBits) {
  std::vector<SurfacePositions> to(2);
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    test::Scene s(test::sphere(4, .4), test::to_unit_sphere);  // more than one block of faces
    Mat3X u = test::random_vectors(s.positions.points.cols(), .8 * s.L());
    EXPECT_FALSE(s.guards.step(s.retraction, s.positions, u, to[threads - 1]).empty());
  }
  EXPECT_TRUE(test::same(to[0], to[1]));
}

}  // namespace hooke::guards_test
