#include "hooke/remesh/limiting_factors.h"

#include <gtest/gtest.h>

#include "hooke/constraints/constraints.h"
#include "hooke/measure/quality.h"
#include "hooke/remesh/options.h"
#include "support/crease_solids.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::limiting_factors_test {

using Names = std::vector<std::string>;

WorstFace face_with(double angle, double bound, std::vector<int> bound_vertices) {
  WorstFace face;
  face.min_angle = angle;
  face.vertices = {0, 1, 2};
  face.bound = {bound, std::move(bound_vertices)};
  return face;
}

TEST(LimitingFactors, AreWhatSetsTheBoundWhereItIsReached) {
  const std::vector<unsigned char> vertex_limits = {0,
                                                    limited_by_boundary,
                                                    limited_by_crease,
                                                    limited_at_corner | limited_by_boundary,
                                                    limited_by_request,
                                                    limited_by_guard};
  const auto named = [&](std::vector<int> vertices) {
    return limiting_factors(face_with(29.5, 30, std::move(vertices)), vertex_limits);
  };
  EXPECT_EQ(named({0}), Names{"valence"});
  EXPECT_EQ(named({1}), Names{"boundary"});
  EXPECT_EQ(named({2}), Names{"crease"});
  EXPECT_EQ(named({3}), (Names{"corner", "boundary"}));
  EXPECT_EQ(named({4}), Names{"fixed"});
  EXPECT_EQ(named({5}), Names{"valence"});
  EXPECT_EQ(named({0, 2}), (Names{"crease", "valence"}));
}

TEST(LimitingFactors, AreWhatLimitsTheFacesOwnVerticesElsewhere) {
  const auto named = [](const std::vector<unsigned char>& vertex_limits) {
    return limiting_factors(face_with(20, 30, {0}), vertex_limits);
  };
  EXPECT_EQ(named({0, 0, 0}), Names{"lengths"});
  EXPECT_EQ(named({limited_by_guard, 0, 0}), Names{"guard"});
  EXPECT_EQ(named({0, VertexLimit::put_back, 0}), Names{"put_back"});
  EXPECT_EQ(named({limited_by_guard, limited_by_boundary, limited_by_request}),
            (Names{"fixed", "boundary", "guard"}));
}

/// The vertex limits of a remeshed mesh.
std::vector<unsigned char> limits_of(const test::Triangles& t, const RemeshOptions& options = {}) {
  return test::remeshed(t, options).result.vertex_limits;
}

TEST(LimitingFactors, LimitsAreThoseOfTheInputsVertices) {
  const test::Triangles t = test::grid(6, test::flat, .2, 3);
  RemeshOptions options;
  options.constraints.fixed_vertices = {24, 16};
  const auto vertex_limits = limits_of(t, options);
  ASSERT_EQ(std::ssize(vertex_limits), t.points.cols());
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
    const auto on_end = [](double x) { return x == 0 || x == 1; };
    const bool x = on_end(t.points(0, v)), y = on_end(t.points(1, v));
    EXPECT_EQ((vertex_limits[v] & limited_by_boundary) != 0, x || y) << v;
    EXPECT_EQ((vertex_limits[v] & limited_at_corner) != 0, x && y) << v;
    EXPECT_EQ((vertex_limits[v] & limited_by_request) != 0, v == 16 || v == 24) << v;
  }
}

TEST(LimitingFactors, AFixedBoundaryIsARequest) {
  const test::Triangles t = test::grid(6, test::flat, .2, 3);
  RemeshOptions options;
  options.constraints.boundary = BoundaryRule::fixed;
  const auto vertex_limits = limits_of(t, options);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
    const auto on_end = [](double x) { return x == 0 || x == 1; };
    const bool on_boundary = on_end(t.points(0, v)) || on_end(t.points(1, v));
    EXPECT_EQ(vertex_limits[v] & ~limited_by_guard,
              on_boundary ? limited_by_request | limited_by_boundary : 0)
        << v;
  }
}

TEST(LimitingFactors, CreasesLimitTheirVertices) {
  const test::Triangles t = test::irregular_cube(4);
  const auto vertex_limits = limits_of(t);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
    const auto planes = (t.points.col(v).array() == 0 || t.points.col(v).array() == 4).count();
    EXPECT_EQ((vertex_limits[v] & limited_at_corner) != 0, planes == 3) << v;
    EXPECT_EQ((vertex_limits[v] & limited_by_crease) != 0, planes >= 2) << v;
  }
}

}  // namespace hooke::limiting_factors_test
