// What remeshing made of a solid with sharp edges. For tests.
#pragma once

#include <gtest/gtest.h>

#include "support/crease_solids.h"
#include "support/remeshed.h"
#include "support/scene.h"

namespace hooke::test {

inline double volume(const Mat3X& X, const std::vector<Triangle>& faces) {
  double sum = 0;
  for (const auto& [a, b, c] : faces) sum += X.col(a).dot(X.col(b).cross(X.col(c))) / 6;
  return sum;
}

/// Every face of an axis-parallel solid lies in one of its planes; its outside has not turned.
inline void expect_flat_faces(const Triangles& t, const Outcome& o, double tolerance) {
  for (const Triangle& f : o.faces) {
    const Vec3 n = area_vector(o.points, f).normalized();
    Eigen::Index axis;
    EXPECT_NEAR(n.cwiseAbs().maxCoeff(&axis), 1, 1e-6);
    for (int v : f) EXPECT_NEAR(o.points(axis, v), std::round(o.points(axis, v)), tolerance);
  }
  EXPECT_NEAR(volume(o.points, o.faces) / volume(t.points, t.faces), 1, 1e-6);
}

inline double total_length(const Mat3X& X, const std::vector<Edge>& edges) {
  double length = 0;
  for (const auto& [a, b] : edges) length += (X.col(a) - X.col(b)).norm();
  return length;
}

/// The creases of an axis-parallel solid cover those of the input and nothing else: the same sum of lengths,
/// and all within the axis-parallel edges they started on.
inline void expect_same_creases(const Triangles& t, const Outcome& o, double tolerance) {
  const auto before = bent_edges(t.points, t.faces), after = bent_edges(o.points, o.faces);
  const double length = total_length(t.points, before);
  EXPECT_NEAR(total_length(o.points, after), length, 1e-9 * length);
  EXPECT_EQ(o.result.creases.edges, after.size());
  for (const auto& [a, b] : after) {  // along an axis, on lattice planes in the two others
    const Vec3 d = (o.points.col(a) - o.points.col(b)).cwiseAbs();
    Eigen::Index along;
    d.maxCoeff(&along);
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (k == along) continue;
      for (int v : {a, b}) EXPECT_NEAR(o.points(k, v), std::round(o.points(k, v)), tolerance);
    }
  }
}

}  // namespace hooke::test
