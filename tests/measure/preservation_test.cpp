#include "hooke/measure/preservation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hooke/geometry/self_intersection.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/deviation.h"
#include "hooke/measure/measured_surface.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/sagitta.h"
#include "support/crease_solids.h"
#include "support/masks.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::preservation_test {

/// A mesh and its measures.
struct Measured {
  explicit Measured(const test::Triangles& t)
      : adjacency(make_adjacency(static_cast<int>(t.points.cols()), t.faces)),
        surface(t.points, adjacency),
        quality(measure_quality(surface, std::vector<double>(adjacency.edges.size(), 1.))) {}

  Adjacency adjacency;
  MeasuredSurface surface;
  Quality quality;
};

Preservation compare(const test::Triangles& before, const test::Triangles& after,
                     const PreservationOptions& options = {}, const std::vector<Edge>& creases = {},
                     const std::vector<Edge>& creases_after = {}) {
  const Measured a(before), b(after);
  return measure_preservation({a.surface, a.quality, creases}, {b.surface, b.quality, creases_after},
                              measure_deviation(a.surface, b.surface), options);
}

TEST(Preservation, HoldsForTheMeshItself) {
  for (const auto& t : {test::sphere(2), test::sphere(2, .3, 1), test::grid(6, test::flat)}) {
    EXPECT_TRUE(compare(t, t).holds());
    EXPECT_TRUE(compare(t, t, {.keeps_facets = true}).holds());
    EXPECT_TRUE(compare(t, t, {.max_distance = 1e-12}).holds());
  }
}

TEST(Preservation, WhereVerticesAreNearItKnowsWhichSamplesAreNot) {
  const test::Triangles coarse = test::sphere(2), fine = test::sphere(3);  // has the vertices of the coarse
  constexpr double limit = .01;
  for (const bool becomes_fine : {false, true}) {
    const test::Triangles& result = becomes_fine ? fine : coarse;
    const Preservation p = compare(becomes_fine ? coarse : fine, result, {.max_distance = limit});
    ASSERT_FALSE(p.far_samples.empty());
    double farthest = 0;
    for (const FarSample& s : p.far_samples) {
      const double distance = (s.on_result - s.on_reference).norm();
      EXPECT_GT(distance, limit);
      EXPECT_EQ(s.limit, limit);
      farthest = std::max(farthest, distance);
      const Triangle& t = result.faces[s.face];
      const ClosestPoint on_face = closest_point(s.on_result, result.points.col(t[0]),
                                                 result.points.col(t[1]), result.points.col(t[2]));
      EXPECT_LT(on_face.squared_distance, 1e-24);
    }
    EXPECT_NEAR(farthest, p.distance, .1 * p.distance);  // vertices count too
  }
}

/// One face, and the same with a hole about one of its points.
std::array<test::Triangles, 2> face_and_holed(const Vec3& weights) {
  test::Triangles face;
  face.points.resize(3, 3);
  face.points << 0, 3, 0, 0, 0, 3, 0, 0, 0;
  face.faces = {{0, 1, 2}};
  test::Triangles holed;
  holed.points.resize(3, 6);
  const Vec3 middle = face.points * weights;
  for (int k = 0; k < 3; ++k) {
    holed.points.col(k) = face.points.col(k);
    holed.points.col(k + 3) = middle + .1 * (face.points.col(k) - face.points.rowwise().mean());
  }
  holed.faces = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  return {face, holed};
}

TEST(Preservation, AllSamplesOfTheDeviationAreListedIfTheyAreTooFar) {
  for (const Vec3& weights : {Vec3(4, 1, 1), Vec3(1, 4, 1), Vec3(1, 1, 4), Vec3(2, 2, 2)}) {
    const auto [face, holed] = face_and_holed(weights / 6);
    const double distance = compare(face, holed, {.max_distance = 1}).distance;
    ASSERT_GT(distance, .05);
    const Preservation p = compare(face, holed, {.max_distance = .99 * distance});
    EXPECT_FALSE(p.within_max_distance);
    ASSERT_EQ(p.far_samples.size(), 1u) << weights.transpose();
    EXPECT_LT((p.far_samples[0].on_reference - face.points * weights / 6).norm(), 1e-12);
    EXPECT_EQ(p.place, p.far_samples[0].on_reference);
    EXPECT_EQ(p.lost_vertices.size(), 3u);
  }
}

TEST(Preservation, WhateverIsTooFarIsListed) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const test::Triangles before = test::sphere(2, .3, seed), after = test::sphere(2, .3, seed + 100);
    const double farthest = compare(before, after, {.max_distance = 1}).distance;
    ASSERT_GT(farthest, .01);
    const Preservation p = compare(before, after, {.max_distance = (1 - 1e-6) * farthest});
    EXPECT_FALSE(p.within_max_distance);
    double listed = 0;
    for (const auto* list : {&p.far_vertices, &p.lost_vertices})
      for (const FarVertex& far : *list) listed = std::max(listed, far.distance);
    EXPECT_NEAR(listed, farthest, 1e-9) << seed;
    const Measured a(before), b(after);
    const double at_place = std::max(std::sqrt(a.surface.tree.closest(p.place).squared_distance),
                                     std::sqrt(b.surface.tree.closest(p.place).squared_distance));
    EXPECT_NEAR(at_place, farthest, 1e-9) << seed;
  }
}

TEST(Preservation, ASpikeThatComesOrGoesBreaksIt) {
  constexpr int tip = 5;
  const test::Triangles round = test::sphere(3);
  test::Triangles spiked = round;
  spiked.points.col(tip) *= 1.5;
  const Preservation comes = compare(round, spiked), goes = compare(spiked, round);
  ASSERT_EQ(comes.far_vertices.size(), 1u);
  EXPECT_EQ(comes.far_vertices[0].vertex, tip);
  EXPECT_NEAR(comes.distance, .5, .05);
  EXPECT_TRUE(compare(round, spiked, {.max_distance = .6}).far_vertices.empty());
  ASSERT_EQ(goes.lost_vertices.size(), 1u);
  EXPECT_EQ(goes.lost_vertices[0].vertex, tip);
}

/// A round body, and a flat sheet beside one of its vertices, which faces it and lies outside at this height.
test::Triangles ball_with_sheet(int vertex, double height, double size = .2) {
  const test::Triangles ball = test::sphere(2);
  const Vec3 out = ball.points.col(vertex).normalized(), along = out.unitOrthogonal(),
             across = out.cross(along);
  test::Triangles sheet = test::grid(4, test::flat);
  for (Eigen::Index v = 0; v < sheet.points.cols(); ++v) {
    const Vec3 p = size * (sheet.points.col(v) - Vec3(.5, .5, 0));
    sheet.points.col(v) = (1 + height) * out + p[1] * along + p[0] * across;
  }
  return test::both(ball, sheet);
}

TEST(Preservation, AShellIsComparedWithItselfWhereAnotherIsNearer) {
  constexpr int vertex = 20;
  const test::Triangles before = ball_with_sheet(vertex, .05);
  test::Triangles after = before;
  after.points.col(vertex) *= 1.035;  // nearer to the sheet, which has no sagitta, than to the ball
  Measured a(before), b(after);
  const auto far = [&] {
    return measure_preservation({a.surface, a.quality, {}}, {b.surface, b.quality, {}},
                                measure_deviation(a.surface, b.surface))
        .far_vertices;
  };
  ASSERT_EQ(far().size(), 1u);
  EXPECT_EQ(far()[0].vertex, vertex);
  const Eigen::Index of_ball = test::sphere(2).points.cols();
  std::vector<int> shells;
  for (Eigen::Index v = 0; v < before.points.cols(); ++v) shells.push_back(v < of_ball ? 0 : 1);
  a.surface.set_shells(shells, 2);
  b.surface.set_shells(shells, 2);
  EXPECT_TRUE(far().empty());
  after.points.col(vertex) *= 1.5;  // far from both
  Measured c(after);
  c.surface.set_shells(shells, 2);
  EXPECT_EQ(measure_preservation({a.surface, a.quality, {}}, {c.surface, c.quality, {}},
                                 measure_deviation(a.surface, c.surface))
                .far_vertices.size(),
            1u);
}

TEST(Preservation, AFaceOpposesAnotherShellOnlyWhereItOpposesItsOwn) {
  constexpr int vertex = 20;
  const test::Triangles before = ball_with_sheet(vertex, .05, .8);
  test::Triangles after = before;
  const Eigen::Index of_ball = test::sphere(2).points.cols();
  std::vector<int> shells(before.points.cols(), 1);
  for (Eigen::Index v = 0; v < of_ball; ++v) {
    shells[v] = 0;
    if ((before.points.col(v) - before.points.col(vertex)).norm() < .5) after.points.col(v) *= 1.047;
  }
  Measured a(before), b(after);
  EXPECT_FALSE(measure_deviation(a.surface, b.surface).opposing_faces.empty());
  a.surface.set_shells(shells, 2);
  b.surface.set_shells(shells, 2);
  EXPECT_TRUE(measure_deviation(a.surface, b.surface).opposing_faces.empty());
  std::swap(b.adjacency.faces[0][0], b.adjacency.faces[0][1]);  // turned over, of the ball
  Measured c({after.points, b.adjacency.faces});
  c.surface.set_shells(shells, 2);
  EXPECT_EQ(measure_deviation(a.surface, c.surface).opposing_faces, std::vector<int>{0});
}

TEST(Preservation, SizesMayBeThoseOfTheWhole) {
  const test::Triangles t = test::sphere(2);
  test::Triangles after = t;
  after.points.col(5) *= 1.2;
  EXPECT_FALSE(compare(t, after).holds());
  EXPECT_TRUE(compare(t, after, {.scale = ReferenceScale{500, .3}}).holds());
  EXPECT_FALSE(compare(t, after, {.scale = ReferenceScale{2, .3}}).holds());
}

TEST(Preservation, CrossingsAreNewOnlyWhereThereWereNone) {
  const auto two = [](int fineness, const Vec3& shift) {
    const test::Triangles a = test::sphere(fineness), b = test::sphere(fineness, .3, 1);
    test::Triangles both = a;
    const auto n = a.points.cols();
    both.points.conservativeResize(3, n + b.points.cols());
    both.points.rightCols(b.points.cols()) = b.points.colwise() + shift;
    for (const Triangle& t : b.faces)
      both.faces.push_back(
          {t[0] + static_cast<int>(n), t[1] + static_cast<int>(n), t[2] + static_cast<int>(n)});
    return both;
  };
  const Vec3 crosses(1.2, .3, .1), moved(1.2, -.5, .1), apart(3, 0, 0);
  const Measured coarse(two(2, crosses)), fine(two(3, crosses)), elsewhere(two(2, moved)),
      none(two(2, apart));
  EXPECT_GT(fine.quality.self_intersections, coarse.quality.self_intersections);
  EXPECT_TRUE(new_crossings(coarse.surface, fine.surface).empty());
  EXPECT_TRUE(new_crossings(fine.surface, coarse.surface).empty());
  EXPECT_GT(new_crossings(coarse.surface, elsewhere.surface).size(), 0u);
  EXPECT_LT(new_crossings(coarse.surface, elsewhere.surface).size(), *elsewhere.quality.self_intersections);
  EXPECT_EQ(new_crossings(none.surface, coarse.surface).size(), *coarse.quality.self_intersections);
  const Preservation p = compare(two(2, apart), two(2, crosses), {.max_distance = 10});
  EXPECT_EQ(p.new_crossings, *coarse.quality.self_intersections);
  EXPECT_EQ(p.crossings, new_crossings(none.surface, coarse.surface));
  EXPECT_GT(p.place.x(), .2);  // between the spheres
  EXPECT_LT(p.place.x(), 1);
}

/// A shaft in its bore: where the walls lie on each other, other facets of theirs cross.
TEST(Preservation, CrossingsAreNotNewWhereWallsTouch) {
  const auto two = [](double gap, unsigned seed) {
    test::Triangles shaft = test::cylinder(16, 0), bore = test::cylinder(16, seed == 0 ? 0 : .3, seed);
    shaft.points.topRows(2) *= 1 - gap;
    for (Triangle& t : bore.faces) std::swap(t[0], t[1]);
    return test::both(shaft, bore);
  };
  const Measured touching(two(0, 0)), apart(two(1e-3, 0)), turned(two(0, 3));
  EXPECT_GT(find_self_intersections(turned.surface.tree).size(), 0u);
  EXPECT_TRUE(new_crossings(touching.surface, turned.surface).empty());
  EXPECT_GT(new_crossings(apart.surface, turned.surface).size(), 0u);
}

TEST(Preservation, ABodyThatTouchesAnotherMayNotCrossItself) {
  const auto plate_on_block = [](double top) {
    test::Triangles plate = test::cells(
        6, 6, 1, [](int, int, int) { return true; }, 0);
    for (int v = 0; v < plate.points.cols(); ++v) {
      const bool is_inner = plate.points(0, v) > 0 && plate.points(0, v) < 6 && plate.points(1, v) > 0 &&
                            plate.points(1, v) < 6;
      if (plate.points(2, v) > 0) plate.points(2, v) = is_inner ? top : .1;
    }
    test::Triangles block = test::cells(
        6, 6, 1, [](int, int, int) { return true; }, .2);
    block.points.row(2).array() -= 1 + 1e-7;
    return test::both(plate, block);
  };
  const Measured whole(plate_on_block(.1)), through(plate_on_block(-.1));
  EXPECT_EQ(whole.quality.self_intersections, 0u);
  EXPECT_GT(new_crossings(whole.surface, through.surface).size(), 10u);
}

TEST(Preservation, AFaceTurnedOverBreaksIt) {
  const test::Triangles t = test::grid(6, test::flat);
  test::Triangles folded = t;
  const auto [a, b, c] = t.faces[30];
  const Vec3 across = t.points.col(b) + t.points.col(c) - 2 * t.points.col(a);
  folded.points.col(a) += 1.6 * across;
  const Preservation p = compare(t, folded);
  EXPECT_GT(p.flipped_faces, 0u);
  EXPECT_GT(p.new_folds, 0u);
}

TEST(Preservation, AFaceThatLosesItsAreaBreaksIt) {
  const test::Triangles t = test::sphere(2);
  test::Triangles flat = t;
  const auto [a, b, c] = t.faces[30];
  flat.points.col(a) = .5 * (t.points.col(b) + t.points.col(c));
  EXPECT_EQ(compare(t, flat).new_degenerate_faces, 1u);
  EXPECT_EQ(compare(flat, flat).new_degenerate_faces, 0u);
}

/// The face 30 has no area, its first corner on the opposite edge.
test::Triangles with_flat_face() {
  test::Triangles t = test::sphere(2);
  const auto [a, b, c] = t.faces[30];
  t.points.col(a) = .4 * t.points.col(b) + .6 * t.points.col(c);
  return t;
}

/// The edge b c is split at its point x of the way.
test::Triangles with_split_edge(test::Triangles t, int b, int c, double x) {
  const int middle = static_cast<int>(t.points.cols());
  t.points.conservativeResize(3, middle + 1);
  t.points.col(middle) = (1 - x) * t.points.col(b) + x * t.points.col(c);
  const std::vector<Triangle> before = t.faces;
  for (std::size_t f = 0; f < before.size(); ++f)
    if (std::ranges::count(before[f], b) + std::ranges::count(before[f], c) == 2) {
      Triangle half = before[f];
      std::ranges::replace(t.faces[f], b, middle);
      std::ranges::replace(half, c, middle);
      t.faces.push_back(half);
    }
  return t;
}

TEST(Preservation, AFaceWithoutAreaMayBeSplitInTwo) {
  const test::Triangles t = with_flat_face();
  const auto [a, b, c] = t.faces[30];
  test::Triangles split = with_split_edge(t, b, c, .3);
  EXPECT_EQ(Measured(split).quality.degenerate_faces, 2u);
  EXPECT_EQ(compare(t, split).new_degenerate_faces, 0u);
  const auto [d, e, f] = split.faces[100];
  split.points.col(d) = .5 * (split.points.col(e) + split.points.col(f));
  const Preservation p = compare(t, split);
  EXPECT_EQ(p.new_degenerate_faces, 1u);
  EXPECT_EQ(p.degenerate_faces, std::vector{100});
}

TEST(Preservation, EachLostCreaseIsNamed) {
  const test::Triangles cube = test::cube();
  const Adjacency c = make_adjacency(static_cast<int>(cube.points.cols()), cube.faces);
  std::vector<Edge> creases, without_corner, at_corner;
  for (int e : sharp_edges(cube.points, c, 40)) {
    const bool is_there = std::ranges::count(c.edges[e], 0) > 0;
    creases.push_back(c.edges[e]);
    (is_there ? at_corner : without_corner).push_back(c.edges[e]);
  }
  ASSERT_EQ(at_corner.size(), 3u);
  const double side = (cube.points.col(creases[0][0]) - cube.points.col(creases[0][1])).norm();
  const Preservation kept = compare(cube, cube, {}, creases, creases);
  EXPECT_TRUE(kept.holds());
  EXPECT_TRUE(kept.lost_creases.empty());
  const Preservation corner = compare(cube, cube, {}, creases, without_corner);
  EXPECT_FALSE(corner.creases_kept);
  EXPECT_FALSE(corner.holds());
  EXPECT_EQ(corner.lost_creases, at_corner);
  EXPECT_NEAR(corner.crease_loss, side, 1e-12);
  const auto is_middle = [&](const Edge& e) {
    return corner.place.isApprox((cube.points.col(e[0]) + cube.points.col(e[1])) / 2);
  };
  EXPECT_TRUE(std::ranges::any_of(at_corner, is_middle));
  EXPECT_EQ(compare(cube, cube, {}, creases, {}).lost_creases, creases);
  // One edge of a cube is within half a side of those it meets.
  EXPECT_TRUE(compare(cube, cube, {}, creases, {creases.begin() + 1, creases.end()}).holds());
}

TEST(Preservation, AMaximumDistanceHoldsBetweenVerticesToo) {
  const test::Triangles fine = test::sphere(3), coarse = test::sphere(1);
  const double chord = measure_deviation(Measured(fine).surface, Measured(coarse).surface).from_reference.max;
  EXPECT_TRUE(compare(fine, coarse, {.max_distance = 1.01 * chord}).within_max_distance);
  EXPECT_TRUE(compare(fine, coarse, {.max_distance = 1.01 * chord}).holds());
  const Preservation p = compare(fine, coarse, {.max_distance = .99 * chord});
  EXPECT_FALSE(p.within_max_distance);
  EXPECT_FALSE(p.holds());
  EXPECT_NEAR(p.excess, 1 / .99, 1e-3);
}

TEST(Preservation, AnotherTopologyBreaksIt) {
  test::Triangles t = test::sphere(2), open = t;
  open.faces.pop_back();
  EXPECT_FALSE(compare(t, open).topology_kept);
}

TEST(Preservation, FacetsAreMeantWhereTheyAreFlatOrLong) {
  const auto faceted = [](const test::Triangles& t) {
    return is_faceted(t.points, make_adjacency(static_cast<int>(t.points.cols()), t.faces));
  };
  EXPECT_TRUE(faceted(test::grid(6, test::flat)));
  EXPECT_TRUE(faceted(test::sphere(0)));  // few faces, all of them sharp
  EXPECT_FALSE(faceted(test::sphere(1)));
  EXPECT_FALSE(faceted(test::sphere(3)));
  EXPECT_FALSE(faceted(test::sphere(3, .3, 1)));
  EXPECT_FALSE(faceted(test::globe(24, 12)));  // of quadrilaterals
  EXPECT_FALSE(faceted(test::globe(64, 16)));
  EXPECT_TRUE(faceted(test::both(test::globe(24, 12), test::cube())));
  const test::Triangles spheres = test::marched_level(9, [](const Vec3& x) {
    return std::min((x - Vec3(2.3, .2, .1)).norm() - 5.2, (x + Vec3(2.9, .3, .2)).norm() - 5.4);
  });
  EXPECT_GT(
      sharp_edges(spheres.points, make_adjacency(static_cast<int>(spheres.points.cols()), spheres.faces), 40)
          .size(),
      0u);
  EXPECT_FALSE(faceted(spheres));  // in spite of many slivers beside its cells
}

/// The vertices of a part with rounded edges are nearly all in its rounds, the area in its flat sides.
TEST(Preservation, FacetsAreMeantWhereLargeFlatSidesMeetInRounds) {
  const auto is_disc_faceted = [](double radius) {  // its rim is half a torus
    std::vector<double> turns(9);
    for (int i = 0; i < 9; ++i) turns[i] = i * std::numbers::pi / 8;
    const test::Triangles disc = test::rows_of_facets(24, turns, [radius](double turn, double across) {
      const double out = radius + 3 * std::sin(across);
      return Vec3(out * std::cos(turn), out * std::sin(turn), -3 * std::cos(across));
    });
    return is_faceted(disc.points, make_adjacency(static_cast<int>(disc.points.cols()), disc.faces));
  };
  EXPECT_TRUE(is_disc_faceted(40));
  EXPECT_FALSE(is_disc_faceted(5));
}

}  // namespace hooke::preservation_test
