#include "hooke/measure/deviation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "support/crease_solids.h"
#include "support/solids.h"

namespace hooke::deviation_test {

Deviation measure(const test::Triangles& reference, const test::Triangles& result) {
  return measure_deviation(reference.points, test::connect(reference), result.points, test::connect(result));
}

test::Triangles shifted(test::Triangles t, const Vec3& by) {
  t.points.colwise() += by;
  return t;
}

TEST(Deviation, OfAMeshFromItselfIsZero) {
  for (const test::Triangles& t : {test::sphere(3, .2), test::grid(8, test::paraboloid, .3), test::cube()}) {
    const Deviation d = measure(t, t);
    EXPECT_EQ(d.displacement->max, 0);
    EXPECT_LT(d.to_reference.max, 1e-15);
    EXPECT_LT(d.from_reference.max, 1e-15);
    EXPECT_NEAR(d.normal_deviation.max, 0, 1e-6);
    EXPECT_EQ(d.flipped_faces.size(), 0u);
    EXPECT_EQ(d.area_change, 0);
  }
}

TEST(Deviation, OfAPlaneLiftedAlongItsNormalIsTheLift) {
  const test::Triangles plane = test::grid(6, test::flat);
  const Deviation d = measure(plane, shifted(plane, {0, 0, .25}));
  EXPECT_DOUBLE_EQ(d.displacement->max, .25);
  EXPECT_DOUBLE_EQ(d.displacement->rms, .25);
  for (const MaxRms& m : {d.to_reference, d.from_reference}) {
    EXPECT_DOUBLE_EQ(m.max, .25);
    EXPECT_DOUBLE_EQ(m.rms, .25);
  }
  EXPECT_EQ(d.normal_deviation.max, 0);
  EXPECT_DOUBLE_EQ(*d.boundary_to_reference, .25);
  EXPECT_DOUBLE_EQ(*d.boundary_from_reference, .25);
  EXPECT_DOUBLE_EQ(d.diagonal, std::numbers::sqrt2);
  EXPECT_FALSE(d.volume_change);
}

TEST(Deviation, RmsIntegratesQuadraticsExactly) {
  // The lift grows linearly from 0 at one corner to 3 at the opposite edge of a triangle: the square's mean
  // over the area is 3^2 * (mean of (1 - s)^2) = 9 / 2.
  const auto flat = test::triangles({{-90, -90, 0}, {90, -90, 0}, {0, 90, 0}}, {{0, 1, 2}});
  const auto tilted = test::triangles({{0, 0, 0}, {1e-4, 0, 3}, {0, 1e-4, 3}}, {{0, 1, 2}});
  EXPECT_NEAR(measure(flat, tilted).to_reference.rms, std::sqrt(4.5), 1e-12);
  EXPECT_NEAR(measure(flat, tilted).to_reference.max, 3, 1e-12);
}

TEST(Deviation, OfConcentricSpheresIsTheGap) {
  test::Triangles inner = test::sphere(4), outer = inner;
  outer.points *= 1.5;
  const Deviation d = measure(inner, outer);
  EXPECT_NEAR(d.to_reference.max, .5, .01);
  EXPECT_NEAR(d.from_reference.rms, .5, .01);
  EXPECT_NEAR(*d.area_change, 1.25, 1e-12);
  EXPECT_NEAR(*d.volume_change, 2.375, 1e-12);
  inner.points *= -1, outer.points *= -1;
  EXPECT_NEAR(*measure(inner, outer).volume_change, 2.375, 1e-12) << "inside out";
  EXPECT_FALSE(d.boundary_to_reference);
}

TEST(Deviation, WorksBetweenDifferentConnectivities) {
  const Deviation d = measure(test::grid(3, test::flat), test::grid(10, test::flat, .3));
  EXPECT_FALSE(d.displacement);
  EXPECT_LT(d.to_reference.max, 1e-15);
  EXPECT_LT(d.from_reference.max, 1e-15);
  EXPECT_LT(*d.boundary_to_reference, 1e-15);
  EXPECT_NEAR(*d.area_change, 0, 1e-14);
  EXPECT_EQ(d.flipped_faces.size(), 0u);
}

TEST(Deviation, DirectionsAreToldApart) {  // the small square lies in the large one, not the other way round
  test::Triangles large = test::grid(4, test::flat);
  large.points.topRows(2) *= 3;
  const Deviation d = measure(large, test::grid(4, test::flat));
  EXPECT_LT(d.to_reference.max, 1e-15);
  EXPECT_DOUBLE_EQ(d.from_reference.max, 2 * std::numbers::sqrt2);
  EXPECT_DOUBLE_EQ(*d.boundary_from_reference, 2 * std::numbers::sqrt2);
  EXPECT_DOUBLE_EQ(*d.boundary_to_reference, 1);
}

TEST(Deviation, NormalDeviationIsTheTiltInDegrees) {
  const auto flat = test::triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const double s = std::sin(std::numbers::pi / 6), c = std::cos(std::numbers::pi / 6);
  const auto tilted = test::triangles({{0, 0, 0}, {1, 0, 0}, {0, c, s}}, {{0, 1, 2}});
  EXPECT_NEAR(measure(flat, tilted).normal_deviation.max, 30, 1e-12);
  EXPECT_NEAR(measure(flat, tilted).normal_deviation.rms, 30, 1e-12);
}

TEST(Deviation, FacesTurnedOverAreCounted) {
  const test::Triangles t = test::grid(4, test::flat);
  test::Triangles folded = t;
  folded.points.col(12) += Vec3(.3, .0, 0);  // past its right neighbour
  size_t expected = 0;
  for (const Triangle& f : t.faces) {
    const Vec3 a = folded.points.col(f[0]), b = folded.points.col(f[1]), c = folded.points.col(f[2]);
    expected += (b - a).cross(c - a).z() < 0;
  }
  EXPECT_GT(expected, 0u);
  EXPECT_EQ(measure(t, folded).flipped_faces.size(), expected);
  EXPECT_GE(measure(t, folded).opposing_faces.size(), expected);

  test::Triangles inside_out = test::sphere(2);
  for (Triangle& f : inside_out.faces) std::swap(f[0], f[1]);
  EXPECT_EQ(measure(test::sphere(2), inside_out).flipped_faces.size(), inside_out.faces.size());
}

TEST(Deviation, AFaceWellBeyondTheMiddleOfAWallIsTurnedOver) {
  const auto wall = test::triangles({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                                    {{0, 1, 2}, {3, 4, 5}});
  const auto is_turned_over = [&](double z) {
    return !measure(wall, test::triangles({{.1, .1, z}, {.4, .1, z}, {.1, .4, z}}, {{0, 1, 2}}))
                .flipped_faces.empty();
  };
  EXPECT_FALSE(is_turned_over(.6));
  EXPECT_FALSE(is_turned_over(.47));
  EXPECT_TRUE(is_turned_over(.42));
  EXPECT_TRUE(is_turned_over(.1));
}

TEST(Deviation, WhereBodiesCrossNoFaceIsTurnedOverForTheOtherBody) {
  for (const double apart : {1.8, 1.9, 1.95}) {
    const auto two = [&](int levels) {
      return test::both(test::sphere(levels, .3, 1), shifted(test::sphere(levels, .3, 2), {apart, .1, 0}));
    };
    const test::Triangles fine = two(4), coarse = two(2);
    EXPECT_TRUE(measure(fine, coarse).flipped_faces.empty()) << apart;
    test::Triangles turned = coarse;
    for (Triangle& t : turned.faces) std::swap(t[0], t[1]);
    EXPECT_GT(measure(fine, turned).flipped_faces.size(), .9 * static_cast<double>(turned.faces.size()));
  }
}

/// A round dish of two sheets, this far apart in the middle, that meet at a sharp rim.
test::Triangles dish(int around, int rings, double thickness) {
  std::vector<Vec3> points;
  std::vector<Triangle> faces;
  const auto point = [&](double radius, int k, double height) {
    const double angle = 2 * std::numbers::pi * k / around;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), height * (1 - radius * radius));
  };
  for (int k = 0; k < around; ++k) points.push_back(point(1, k, 0));
  for (const bool upper : {true, false}) {
    const double height = upper ? .2 : .2 - thickness;
    std::vector<int> outer(around), inner(around);
    for (int k = 0; k < around; ++k) outer[k] = k;
    const auto add = [&](int a, int b, int c) {
      faces.push_back(upper ? Triangle{a, b, c} : Triangle{b, a, c});
    };
    for (int r = rings - 1; r >= 0; --r) {
      for (int k = 0; k < around; ++k) {
        if (r == 0 && k > 0) {
          inner[k] = inner[0];
          continue;
        }
        inner[k] = static_cast<int>(points.size());
        points.push_back(point(static_cast<double>(r) / rings, k, height));
      }
      for (int k = 0; k < around; ++k) {
        const int next = (k + 1) % around;
        add(outer[k], outer[next], inner[k]);
        if (r > 0) add(outer[next], inner[next], inner[k]);
      }
      outer = inner;
    }
  }
  Mat3X columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v) columns.col(static_cast<Eigen::Index>(v)) = points[v];
  return {columns, faces};
}

TEST(Deviation, AFaceThatCutsDeeperThanAWallIsThickIsNotTurnedOver) {
  for (const double thickness : {.02, .05, .1})
    EXPECT_TRUE(measure(dish(48, 24, thickness), dish(6, 1, thickness)).flipped_faces.empty()) << thickness;
}

TEST(Deviation, AFaceThatFoldsBackOnAThinWallIsTurnedOver) {
  test::Triangles plate = test::cells(4, 4, 1, [](int, int, int) { return true; });
  plate.points.row(2) *= .02;
  Eigen::Index middle = 0;
  const Vec3 top = plate.points.rowwise().maxCoeff();
  (plate.points.colwise() - Vec3(top.x() / 2, top.y() / 2, top.z())).colwise().norm().minCoeff(&middle);
  test::Triangles folded = plate;
  folded.points.col(middle).x() += .3 * top.x();  // past its neighbour
  std::size_t turned = 0;
  for (const Triangle& t : folded.faces)
    turned += doubled_area_vector(folded.points, t).dot(doubled_area_vector(plate.points, t)) < 0;
  EXPECT_GT(turned, 0u);
  EXPECT_EQ(measure(plate, folded).flipped_faces.size(), turned);
}

test::Triangles plate_of(double thickness) {
  test::Triangles plate = test::cells(
      4, 4, 1, [](int, int, int) { return true; }, 0);
  plate.points.row(2) *= thickness;
  return plate;
}

TEST(Deviation, AThinPlateInsideOutIsTurnedOver) {
  for (const double thickness : {.02, .1, .2}) {
    const test::Triangles plate = plate_of(thickness);
    test::Triangles turned = plate;
    for (Triangle& f : turned.faces) std::swap(f[0], f[1]);
    test::Triangles swapped = plate;  // its sides, and thereby its rim
    swapped.points.row(2) = thickness - plate.points.row(2).array();
    for (const test::Triangles& result : {turned, swapped})
      EXPECT_GE(measure(plate, result).flipped_faces.size(), 16u) << thickness;  // those off its rim
  }
}

TEST(Deviation, WhereTheSidesOfAThinPlateChangePlacesFacesAreTurnedOver) {
  const double thickness = .1;
  const test::Triangles plate = plate_of(thickness);
  test::Triangles swapped = plate;
  for (Eigen::Index v = 0; v < plate.points.cols(); ++v)
    if ((plate.points.col(v).head<2>() - Eigen::Vector2d(2, 2)).cwiseAbs().maxCoeff() < 1.5)
      swapped.points(2, v) = thickness - plate.points(2, v);
  EXPECT_GE(measure(plate, swapped).flipped_faces.size(), 16u);  // those with no corner elsewhere
}

TEST(Deviation, FacesAtFoldsOfTheReferenceAreNamed) {
  // Its second face is folded back over the first; the result lies over it, the right way up.
  const auto folded =
      test::triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.1, .1, .1}}, {{0, 1, 2}, {2, 1, 3}});
  const auto above = test::triangles({{.3, .3, .2}, {.5, .3, .2}, {.3, .5, .2}, {5, 0, 0}}, {{0, 1, 2}});
  EXPECT_EQ(measure(folded, above).opposing_faces, std::vector<int>{0});
  const test::Triangles t = test::grid(4, test::flat);
  EXPECT_TRUE(measure(t, t).opposing_faces.empty());
}

TEST(Deviation, WhichOfTwoFacesAtAFoldIsTheCloserDoesNotMatter) {
  // The reference is folded back along the y axis, and the result's face lies beyond that edge.
  const auto beyond = test::triangles({{.1, 0, 0}, {.3, 0, 0}, {.2, .3, 0}}, {{0, 1, 2}});
  for (const bool upper_first : {true, false}) {
    test::Triangles folded =
        test::triangles({{0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, 0, -.2}}, {{0, 1, 2}, {1, 0, 3}});
    if (!upper_first) std::swap(folded.faces[0], folded.faces[1]);
    EXPECT_EQ(measure(folded, beyond).opposing_faces, std::vector<int>{0});
  }
}

TEST(Deviation, RigidMotionOfBothChangesNothingAndScaleScales) {
  const test::Triangles a = test::sphere(3, .1, 1), b = test::sphere(3, .3, 2);
  const Deviation d = measure(a, b), e = measure(test::moved(a, 10), test::moved(b, 10));
  EXPECT_NEAR(e.to_reference.max, 10 * d.to_reference.max, 1e-9);
  EXPECT_NEAR(e.from_reference.rms, 10 * d.from_reference.rms, 1e-9);
  EXPECT_NEAR(e.displacement->max, 10 * d.displacement->max, 1e-9);
  EXPECT_NEAR(e.normal_deviation.rms, d.normal_deviation.rms, 1e-6);
  EXPECT_NEAR(*e.volume_change, *d.volume_change, 1e-10);
  EXPECT_EQ(e.flipped_faces, d.flipped_faces);
}

TEST(Deviation, ThreadsChangeNothing) {
  const test::Triangles a = test::grid(40, test::paraboloid, .2), b = test::grid(40, test::paraboloid, .4, 2);
  const Deviation many = measure(a, b);
  const ThreadLimit one(1);
  const Deviation single = measure(a, b);
  EXPECT_EQ(single.to_reference.rms, many.to_reference.rms);
  EXPECT_EQ(single.from_reference.max, many.from_reference.max);
  EXPECT_EQ(single.normal_deviation.rms, many.normal_deviation.rms);
  EXPECT_EQ(single.boundary_to_reference, many.boundary_to_reference);
}

TEST(Deviation, WhereAllFacesLookToOneSideThoseThatLookAwayAreOverhangs) {
  const auto step = [](double x, double) { return 10 * std::clamp(x - .5, 0., .05); };
  for (const auto& [axis, sign] : {std::pair(2, 1.), std::pair(2, -1.), std::pair(0, 1.)}) {
    test::Triangles terrain = test::grid(40, step);
    test::Triangles leaning = terrain;
    for (auto x : leaning.points.colwise())
      if (std::abs(x[0] - .55) < 1e-9)
        x[0] -= .06;  // its step leans over by a degree, and lies close to where it was
    const auto turn = [axis = axis, sign = sign](test::Triangles& t) {
      t.points.row(2).swap(t.points.row(axis));
      t.points *= sign;
    };
    turn(terrain);
    turn(leaning);
    EXPECT_EQ(measure(terrain, terrain).overhangs, 0);
    EXPECT_EQ(measure(terrain, leaning).overhangs, 80);
    EXPECT_EQ(measure(leaning, leaning).overhangs, 0) << "as in the reference";
  }
  EXPECT_EQ(measure(test::globe(20, 10), test::globe(8, 4)).overhangs, 0);
}

TEST(Deviation, FromAnEmptyReferenceIsInfinite) {
  const test::Triangles empty{Mat3X(3, 0), {}};
  const Deviation d = measure(empty, test::cube());
  EXPECT_TRUE(std::isinf(d.to_reference.max));
  EXPECT_FALSE(d.displacement || d.area_change || d.volume_change);
  EXPECT_EQ(d.flipped_faces.size(), 0u);
}

}  // namespace hooke::deviation_test
