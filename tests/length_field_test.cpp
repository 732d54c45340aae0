#include "hooke/length_field.h"

#include <gtest/gtest.h>

#include "scene.h"

namespace hooke {
namespace {

double linear(const Vec3& p) {
  return 1 + 2 * p[0] + .5 * p[1];
}

/// A linear function on the unit square.
struct Field {
  test::Triangles t = test::grid(9, test::flat, .4, 2);
  std::vector<double> lengths;
  LengthField field;

  Field() {
    for (const auto p : t.points.colwise()) lengths.push_back(linear(p));
    field = LengthField(t.points, std::make_shared<const Connectivity>(test::connect(t)), lengths);
  }
};

TEST(LengthField, IsWhatWasGivenAtTheVertices) {
  const Field f;
  for (int v = 0; v < f.t.points.cols(); ++v) {
    int anchor = v;
    EXPECT_EQ(f.field.at(f.t.points.col(v), anchor), f.lengths[static_cast<size_t>(v)]);
    EXPECT_EQ(anchor, v);
  }
}

TEST(LengthField, IsLinearBetweenThemHoweverFarThePointHasTravelled) {
  const Field f;
  const Mat3X offset = test::random_vectors(50, .5);
  for (const auto u : offset.colwise()) {
    const Vec3 x(.5 + u[0], .5 + u[1], .01 * u[2]);
    int anchor = 0;
    EXPECT_NEAR(f.field.at(x, anchor), linear(x), 1e-12);
    EXPECT_LT((f.t.points.col(anchor) - x).norm(), .25);
  }
}

TEST(LengthField, BeyondTheRimIsThatOfTheRim) {
  const Field f;
  int anchor = 44;
  EXPECT_NEAR(f.field.at(Vec3(.4, -1, .3), anchor), linear(Vec3(.4, 0, 0)), 1e-12);
}

TEST(LengthField, OfEqualLengthsIsUniform) {
  const Field f;
  EXPECT_FALSE(f.field.uniform());
  EXPECT_TRUE(LengthField().uniform());
  const auto c = std::make_shared<const Connectivity>(test::connect(f.t));
  EXPECT_TRUE(LengthField(f.t.points, c, std::vector<double>(f.lengths.size(), .1)).uniform());
}

TEST(LengthField, AVertexWithoutFacesKeepsItsLength) {
  const test::Triangles t = test::triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2}});
  const LengthField field(t.points, std::make_shared<const Connectivity>(test::connect(t)), {1, 2, 3, 7});
  int anchor = 3;
  EXPECT_EQ(field.at(Vec3(0, 0, 0), anchor), 7);
}

}  // namespace
}  // namespace hooke
