#include "hooke/mesh/curvature.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/mesh/topology.h"

namespace hooke {
namespace {

/// Cotangent of the angle at `apex`; negative when it is obtuse.
double cotangent_at(const Vec3& apex, const Vec3& next, const Vec3& last, double twice_area) {
  return (next - apex).dot(last - apex) / twice_area;
}

/// Angles between 0 and pi, added as complex numbers are multiplied: with one arc tangent for all.
class AngleSum {
 public:
  /// The angle of (x, y), y > 0.
  void add(double x, double y) {
    const double u = x_ * x - y_ * y, v = x_ * y + y_ * x;
    const double size = std::abs(u) + std::abs(v);
    turns_ += y_ < 0 && v >= 0;
    x_ = u / size;
    y_ = v / size;
  }

  double value() const {
    const double angle = std::atan2(y_, x_);
    return 2 * std::numbers::pi * (turns_ + (angle < 0)) + angle;
  }

 private:
  double x_ = 1, y_ = 0;
  int turns_ = 0;
};

/// What the faces around one vertex add up to.
struct RingSums {
  Vec3 normal = Vec3::Zero();  // sum of (cot a + cot b) (x - x_j), Meyer et al. [8]
  AngleSum angle;
  double mixed_area = 0;  // Meyer et al., figure 4
  bool defined = true;
};

void add_face(const Vec3& p, const Vec3& q, const Vec3& r, RingSums& sums) {
  const double twice_area = (q - p).cross(r - p).norm();
  if (!(twice_area > 0)) {
    sums.defined = false;
    return;
  }
  const double cot_p = cotangent_at(p, q, r, twice_area);
  const double cot_q = cotangent_at(q, r, p, twice_area);
  const double cot_r = cotangent_at(r, p, q, twice_area);
  sums.normal += cot_r * (p - q) + cot_q * (p - r);
  sums.angle.add((q - p).dot(r - p), twice_area);
  if (cot_p < 0) {
    sums.mixed_area += twice_area / 4;
  } else if (cot_q < 0 || cot_r < 0) {
    sums.mixed_area += twice_area / 8;
  } else {  // the vertex's Voronoi cell, Meyer et al. [7]
    sums.mixed_area += (cot_r * (p - q).squaredNorm() + cot_q * (p - r).squaredNorm()) / 8;
  }
}

}  // namespace

VertexCurvature measure_curvature(const Mat3X& points, const Connectivity& connectivity) {
  const auto n = static_cast<size_t>(connectivity.vertex_count);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  VertexCurvature curvature{std::vector<double>(n, none), std::vector<double>(n, none)};
  const std::vector<char> on_boundary = boundary_vertices(connectivity);
  parallel_for(n, 1024, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      const auto ring = connectivity.vertex_faces[static_cast<int>(v)];
      if (on_boundary[v] || ring.empty()) continue;
      RingSums sums;
      for (int f : ring) {
        const Triangle& t = connectivity.faces[static_cast<size_t>(f)];
        const size_t k = t[0] == static_cast<int>(v) ? 0 : t[1] == static_cast<int>(v) ? 1 : 2;
        add_face(points.col(t[k]), points.col(t[(k + 1) % 3]), points.col(t[(k + 2) % 3]), sums);
      }
      if (!sums.defined || !(sums.mixed_area > 0)) continue;
      curvature.mean[v] = sums.normal.norm() / (4 * sums.mixed_area);
      curvature.gaussian[v] = (2 * std::numbers::pi - sums.angle.value()) / sums.mixed_area;
    }
  });
  return curvature;
}

}  // namespace hooke
