#include "hooke/filter/thin_plate_spline.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <random>

#include "hooke/core/error.h"
#include "support/scene.h"

namespace hooke::thin_plate_spline_test {

Mat3X test_centres(int count, unsigned seed) {
  return test::random_vectors(count, 1.9, seed);
}

/// A spline with its memory.
template <typename Coordinate>
struct Kept {
  std::vector<Coordinate> coordinates;
  std::vector<double> coefficients;
  StoredSpline<Coordinate> spline;

  Kept(const Mat3X& centres, const SplineCoefficients& c)
      : coordinates(StoredSpline<Coordinate>::coordinates_size(centres.cols()), 7),
        coefficients(StoredSpline<Coordinate>::coefficients_size(centres.cols()), 7),
        spline(store_spline(centres, c, coordinates.data(), coefficients.data())) {}
};

TEST(StoredSpline, SnappedPlacesAreNearAndSnapToThemselves) {
  const Mat3X points = test_centres(100, 1);
  for (const auto& point : points.colwise()) {
    const Vec3 x = snapped(point);
    EXPECT_LE((x - point).cwiseAbs().maxCoeff(), 0x1p-31);
    EXPECT_EQ(snapped(x), x);
    EXPECT_EQ((x * 0x1p30).eval(), (x * 0x1p30).array().floor().matrix().eval());
  }
  EXPECT_EQ(snapped(Vec3(0, 1, -1)), Vec3(0, 1, -1));
  EXPECT_LT(snapped(Vec3(5, 0, 0))[0], 2);
  EXPECT_GT(snapped(Vec3(-5, 0, 0))[0], -2);
}

TEST(StoredSpline, IsTheSumThatItStandsForWithEitherCoordinate) {
  for (const Kernel kernel : {Kernel::r3, Kernel::r2logr})
    for (int count : {0, 1, 4, 23, 40}) {
      Mat3X centres = test_centres(count, 2);
      for (auto&& centre : centres.colwise()) centre = snapped(centre);
      SplineCoefficients c;
      for (int i = 0; i < count; ++i) c.radial.push_back(std::sin(i + 1));
      for (std::size_t k = 0; k < c.polynomial.size(); ++k)
        c.polynomial[k] = std::cos(static_cast<double>(k));
      const Kept<double> exact(centres, c);
      const Kept<SnappedCoordinate> small(centres, c);
      const Mat3X places = test_centres(20, 3);
      for (const auto& place : places.colwise()) {
        const double x = place[0], y = place[1], z = place[2];
        const double monomials[] = {1, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x};
        double value = 0;
        for (std::size_t k = 0; k < std::size(monomials); ++k) value += c.polynomial[k] * monomials[k];
        for (int i = 0; i < count; ++i) {
          const double r = (place - centres.col(i)).norm();
          value += c.radial[i] * (kernel == Kernel::r3 ? r * r * r : r * r * std::log(r));
        }
        const FieldSample a = exact.spline(kernel, place), b = small.spline(kernel, place);
        EXPECT_NEAR(a.value, value, 1e-10);
        EXPECT_EQ(a.value, b.value);
        EXPECT_EQ(a.gradient, b.gradient);
      }
    }
}

Mat3X random_points(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  return Mat3X::NullaryExpr(3, count, [&] { return coordinate(random); });
}

double affine(const Vec3& p) {
  return 2 - p[0] + 3 * p[1] + .5 * p[2];
}
double quadratic(const Vec3& p) {
  return affine(p) + p[0] * p[0] - 2 * p[1] * p[1] + p[0] * p[1] + .7 * p[2] * p[0] - p[2] * p[1];
}

Eigen::VectorXd values_at(const Mat3X& points, double (*f)(const Vec3&)) {
  Eigen::VectorXd values(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) values[i] = f(points.col(i));
  return values;
}

class EveryKernel : public testing::TestWithParam<Kernel> {};
INSTANTIATE_TEST_SUITE_P(ThinPlateSpline, EveryKernel, testing::Values(Kernel::r2logr, Kernel::r3));

TEST_P(EveryKernel, ReproducesThePolynomialsOfItsDegree) {
  const Mat3X centres = random_points(40, 1), elsewhere = 3 * random_points(40, 2);
  const auto first = ThinPlateSpline::fit(centres, values_at(centres, affine), GetParam(), 1);
  const auto second = ThinPlateSpline::fit(centres, values_at(centres, quadratic), GetParam(), 2);
  ASSERT_TRUE(first && second);
  for (const auto& x : elsewhere.colwise()) {
    EXPECT_NEAR((*first)(x).value, affine(x), 1e-9);
    EXPECT_LT(((*first)(x).gradient - Vec3(-1, 3, .5)).norm(), 1e-9);
    EXPECT_NEAR((*second)(x).value, quadratic(x), 1e-9);
  }
}

TEST_P(EveryKernel, TakesItsValuesAtItsCentres) {
  const Mat3X centres = random_points(97, 3);
  const Eigen::VectorXd values = Eigen::VectorXd::Random(97);
  for (SplineDegree degree : {1, 2}) {
    const auto spline = ThinPlateSpline::fit(centres, values, GetParam(), degree);
    ASSERT_TRUE(spline);
    for (Eigen::Index i = 0; i < 97; ++i) EXPECT_NEAR((*spline)(centres.col(i)).value, values[i], 1e-10);
  }
}

TEST_P(EveryKernel, GradientEqualsDifferences) {
  const auto spline =
      ThinPlateSpline::fit(100 * random_points(50, 4), Eigen::VectorXd::Random(50), GetParam(), 2);
  ASSERT_TRUE(spline);
  const double h = 1e-3;
  const Mat3X places = 100 * random_points(20, 5);
  for (const auto& place : places.colwise()) {
    const Vec3 x = place;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      const double difference = ((*spline)(x + step).value - (*spline)(x - step).value) / (2 * h);
      EXPECT_NEAR((*spline)(x).gradient[k], difference, 1e-7);
    }
  }
}

TEST(ThinPlateSpline, NullSpaceSolutionIsThatOfThePapersSystem) {
  const int n = 24;
  const Mat3X y = 5 * random_points(n, 6);
  const Eigen::VectorXd d = Eigen::VectorXd::Random(n);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);  // [31]
  const auto phi = [](double r) { return r > 0 ? r * r * std::log(r) : 0; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) system(i, j) = phi((y.col(i) - y.col(j)).norm());
    system.block<1, 3>(i, n) = y.col(i).transpose();
    system.block<3, 1>(n, i) = y.col(i);
    system(i, n + 3) = system(n + 3, i) = 1;
  }
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 4);
  right.head(n) = d;
  const Eigen::VectorXd solution = system.fullPivLu().solve(right);

  const auto spline = ThinPlateSpline::fit(y, d, Kernel::r2logr, 1);
  ASSERT_TRUE(spline);
  const Mat3X places = 5 * random_points(20, 7);
  for (const auto& x : places.colwise()) {
    double psi = solution.segment<3>(n).dot(x) + solution[n + 3];  // [30]
    for (int i = 0; i < n; ++i) psi += solution[i] * phi((x - y.col(i)).norm());
    EXPECT_NEAR((*spline)(x).value, psi, 1e-9);
  }
}

TEST(ThinPlateSpline, RefusesCentresThatDoNotDetermineIt) {
  const auto fit = [](const Mat3X& centres, SplineDegree degree) {
    return ThinPlateSpline::fit(centres, Eigen::VectorXd::Ones(centres.cols()), Kernel::r2logr, degree);
  };
  EXPECT_FALSE(fit(Mat3X(3, 0), 1));
  EXPECT_FALSE(fit(random_points(3, 1), 1));
  EXPECT_FALSE(fit(random_points(9, 1), 2));
  EXPECT_FALSE(fit(Mat3X::Ones(3, 20), 1));

  Mat3X flat = random_points(30, 1);
  flat.row(2).setZero();
  EXPECT_FALSE(fit(flat, 1));
  Mat3X on_sphere = random_points(30, 1);
  on_sphere.colwise().normalize();
  EXPECT_TRUE(fit(on_sphere, 1));
  EXPECT_FALSE(fit(on_sphere, 2));

  Mat3X doubled = random_points(30, 1);
  doubled.col(7) = doubled.col(21);
  EXPECT_FALSE(fit(doubled, 1));
}

TEST(ThinPlateSpline, RefusesMoreMemoryThanItMayUseAndSaysHowMuch) {
  const Mat3X centres = random_points(200, 1);
  const Eigen::VectorXd values = Eigen::VectorXd::Zero(200);
  EXPECT_GE(spline_fit_bytes(200), sizeof(double) * 200 * 200);
  EXPECT_TRUE(ThinPlateSpline::fit(centres, values, Kernel::r3, 1, spline_fit_bytes(200)));
  try {
    ThinPlateSpline::fit(centres, values, Kernel::r3, 1, spline_fit_bytes(200) - 1);
    FAIL();
  } catch (const LimitError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(spline_fit_bytes(200))), std::string::npos);
  }
}

}  // namespace hooke::thin_plate_spline_test
