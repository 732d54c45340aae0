#include "hooke/geometry/predicates.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace hooke::predicates_test {

using Rational = boost::multiprecision::cpp_rational;

int rational_orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto q = [](double x) { return Rational(x); };
  const Rational d =
      (q(b.x()) - q(a.x())) * (q(c.y()) - q(a.y())) - (q(b.y()) - q(a.y())) * (q(c.x()) - q(a.x()));
  return d.sign();
}

int rational_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Rational m[3][3];
  const Vec3* rows[] = {&b, &c, &d};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = Rational((*rows[i])[j]) - Rational(a[j]);
  const Rational x = m[0][1] * m[1][2] - m[0][2] * m[1][1];
  const Rational y = m[0][2] * m[1][0] - m[0][0] * m[1][2];
  const Rational z = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const Rational determinant = x * m[2][0] + y * m[2][1] + z * m[2][2];
  return determinant.sign();
}

/// Points whose determinants are zero but for rounding, now and then moved by a last digit.
class NearlyDegenerate {
 public:
  explicit NearlyDegenerate(double scale) : scale_(scale) {}

  template <int n>
  Eigen::Matrix<double, n, 1> point() {
    Eigen::Matrix<double, n, 1> p;
    for (int i = 0; i < n; ++i) p[i] = scale_ * uniform_(random_);
    return p;
  }
  template <typename Point>
  Point combine(const Point& a, const Point& b) {
    const double t = uniform_(random_);
    Point p = (1 - t) * a + t * b;
    if (uniform_(random_) < .5) p[0] = std::nextafter(p[0], uniform_(random_) < .5 ? -1e308 : 1e308);
    return p;
  }

 private:
  double scale_;
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

class PredicatesAtScale : public testing::TestWithParam<double> {};

TEST_P(PredicatesAtScale, Orient2dAgreesWithRationals) {
  NearlyDegenerate make(GetParam());
  int signs[3] = {};
  for (int i = 0; i < 2000; ++i) {
    const Vec2 a = make.point<2>(), b = make.point<2>();
    const Vec2 c = make.combine(a, b);
    const int expected = rational_orient2d(a, b, c);
    ASSERT_EQ(orient2d(a, b, c), expected);
    ASSERT_EQ(orient2d(b, c, a), expected);
    ASSERT_EQ(orient2d(b, a, c), -expected);
    ++signs[expected + 1];
  }
  EXPECT_GT(std::min(signs[0], signs[2]), 100);  // the cases cover both signs
}

TEST_P(PredicatesAtScale, Orient3dAgreesWithRationals) {
  NearlyDegenerate make(GetParam());
  int signs[3] = {};
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = make.point<3>(), b = make.point<3>(), c = make.point<3>();
    const Vec3 d = make.combine(make.combine(a, b), c);
    const int expected = rational_orient3d(a, b, c, d);
    ASSERT_EQ(orient3d(a, b, c, d), expected);
    ASSERT_EQ(orient3d(b, c, a, d), expected);
    ASSERT_EQ(orient3d(b, a, c, d), -expected);
    ASSERT_EQ(orient3d(d, c, b, a), expected);
    ++signs[expected + 1];
  }
  EXPECT_GT(std::min(signs[0], signs[2]), 100);
}

INSTANTIATE_TEST_SUITE_P(All, PredicatesAtScale, testing::Values(1., 1e-150, 1e150, 1e-310, 1e307));

TEST(Predicates, SignsFollowTheRightHand) {
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), -1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0}), 0);
}

TEST(Predicates, MixedMagnitudesAreExact) {
  const double tiny = 5e-324, huge = 1e308;
  EXPECT_EQ(orient2d({0, 0}, {huge, 0}, {-huge, tiny}), 1);
  EXPECT_EQ(orient2d({-huge, -huge}, {huge, huge}, {0, tiny}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {huge, -huge, -tiny}), -1);
  EXPECT_EQ(orient3d({-huge, 0, 0}, {huge, huge, 0}, {0, -huge, tiny}, {1, 1, tiny}),
            rational_orient3d({-huge, 0, 0}, {huge, huge, 0}, {0, -huge, tiny}, {1, 1, tiny}));
  EXPECT_EQ(orient3d({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}, {0, 0, tiny}), 1);
}

TEST(Predicates, CollinearMeansExactlyCollinear) {
  EXPECT_TRUE(is_collinear({0, 0, 0}, {1, 2, 3}, {2, 4, 6}));
  EXPECT_TRUE(is_collinear({1, 1, 1}, {1, 1, 1}, {2, 4, 6}));
  EXPECT_FALSE(is_collinear({0, 0, 0}, {1, 2, 3}, {2, 4, std::nextafter(6., 7.)}));
  EXPECT_FALSE(is_collinear({0, 0, 0}, {0, 0, 1}, {0, 1, 0}));
}

}  // namespace hooke::predicates_test
