#include "hooke/filter/thin_plate_spline.h"

#include <gtest/gtest.h>

#include "scene.h"

namespace hooke {
namespace {

Mat3X random_points(int count, unsigned seed) {
  return test::random_vectors(count, 1.9, seed);
}

/// A spline with its memory.
template <typename Coordinate>
struct Kept {
  std::vector<Coordinate> coordinates;
  std::vector<double> coefficients;
  StoredSpline<Coordinate> spline;

  Kept(const Mat3X& centres, const SplineCoefficients& c)
      : coordinates(StoredSpline<Coordinate>::coordinates_size(static_cast<std::size_t>(centres.cols())), 7),
        coefficients(StoredSpline<Coordinate>::coefficients_size(static_cast<std::size_t>(centres.cols())),
                     7),
        spline(store_spline(centres, c, coordinates.data(), coefficients.data())) {}
};

TEST(StoredSpline, SnappedPlacesAreNearAndSnapToThemselves) {
  const Mat3X points = random_points(100, 1);
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
      Mat3X centres = random_points(count, 2);
      for (auto&& centre : centres.colwise()) centre = snapped(centre);
      SplineCoefficients c;
      for (int i = 0; i < count; ++i) c.radial.push_back(std::sin(i + 1));
      for (std::size_t k = 0; k < c.polynomial.size(); ++k)
        c.polynomial[k] = std::cos(static_cast<double>(k));
      const Kept<double> exact(centres, c);
      const Kept<SnappedCoordinate> small(centres, c);
      const Mat3X places = random_points(20, 3);
      for (const auto& place : places.colwise()) {
        const double x = place[0], y = place[1], z = place[2];
        const double monomials[] = {1, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x};
        double value = 0;
        for (std::size_t k = 0; k < std::size(monomials); ++k) value += c.polynomial[k] * monomials[k];
        for (int i = 0; i < count; ++i) {
          const double r = (place - centres.col(i)).norm();
          value += c.radial[static_cast<std::size_t>(i)] *
                   (kernel == Kernel::r3 ? r * r * r : r * r * std::log(r));
        }
        const FieldSample a = exact.spline(kernel, place), b = small.spline(kernel, place);
        EXPECT_NEAR(a.value, value, 1e-10);
        EXPECT_EQ(a.value, b.value);
        EXPECT_EQ(a.gradient, b.gradient);
      }
    }
}

}  // namespace
}  // namespace hooke
