#include "hooke/constraints/feature_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hooke/geometry/triangle.h"

namespace hooke {
namespace {

CurveProjection project_to_segment(const Curve& curve, const Vec3& x, int segment) {
  const int next = (segment + 1) % static_cast<int>(curve.points.cols());
  const Vec3 a = curve.points.col(segment);
  const Vec3 ab = curve.points.col(next) - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((x - a).dot(ab) / length2, 0., 1.) : 0;
  // Interpolated tangents let a vertex pass a point of the polyline without a kink in its direction.
  const Vec3 tangent = (1 - t) * curve.tangents.col(segment) + t * curve.tangents.col(next);
  return {t < 1 ? Vec3(a + t * ab) : Vec3(curve.points.col(next)), tangent.stableNormalized(), segment};
}

std::array<double, 3> key_of(const Vec3& point) {
  return {point[0], point[1], point[2]};
}

/// Arc length up to each point of the curve; a closed curve ends with its first point again.
std::vector<double> arc_lengths(const Curve& curve) {
  const Eigen::Index n = curve.points.cols();
  std::vector<double> lengths = {0};
  for (int s = 0; s < curve.segment_count(); ++s)
    lengths.push_back(lengths.back() + (curve.points.col((s + 1) % n) - curve.points.col(s)).norm());
  return lengths;
}

/// Maximum distance of the points of the curve from `count` chords of equal arc length.
double chord_error_of(const Curve& curve, const std::vector<double>& arcs, int count) {
  const Eigen::Index n = curve.points.cols();
  const auto at = [&](double arc, size_t& s) -> Vec3 {
    while (s + 2 < arcs.size() && arcs[s + 1] < arc) ++s;
    const double length = arcs[s + 1] - arcs[s], t = length > 0 ? (arc - arcs[s]) / length : 0;
    return (1 - t) * curve.points.col(static_cast<Eigen::Index>(s)) +
           t * curve.points.col(static_cast<Eigen::Index>(s + 1) % n);
  };
  double worst = 0;
  size_t segment = 0;
  Vec3 a = at(0, segment);
  for (int i = 0; i < count; ++i) {
    const size_t first = segment + 1;
    const Vec3 b = at(arcs.back() * (i + 1) / count, segment);
    for (size_t s = first; s <= segment; ++s)
      worst = std::max(worst, distance_to_segment(curve.points.col(static_cast<Eigen::Index>(s) % n), a, b));
    a = b;
  }
  return worst;
}

}  // namespace

Curve make_curve(Mat3X points, bool closed) {
  Curve curve{.points = std::move(points), .tangents = {}, .closed = closed};
  const int n = static_cast<int>(curve.points.cols());
  curve.tangents = Mat3X::Zero(3, n);
  for (int s = 0; s < curve.segment_count(); ++s) {
    const int next = (s + 1) % n;
    const Vec3 direction = (curve.points.col(next) - curve.points.col(s)).stableNormalized();
    curve.tangents.col(s) += direction;
    curve.tangents.col(next) += direction;
  }
  for (int i = 0; i < n; ++i) curve.tangents.col(i).stableNormalize();
  return curve;
}

bool turns(const Vec3& before, const Vec3& at, const Vec3& after, double cosine) {
  const Vec3 in = at - before, out = after - at;
  return in.dot(out) < cosine * in.norm() * out.norm();
}

std::vector<int> bends_of_even_curve(const Curve& curve, double even) {
  constexpr double bend = .01;
  const int n = static_cast<int>(curve.points.cols()), segments = curve.segment_count();
  const auto point = [&](int i) { return curve.points.col(i % n); };
  double sum = 0, shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (int i = 0; i < segments; ++i) {
    const double length = (point(i + 1) - point(i)).norm();
    sum += length;
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  std::vector<int> bends;
  if (longest > even * shortest) return bends;
  const double limit = bend * sum / segments;
  const int first = curve.closed ? n : 1;
  for (int i = first; i < segments + (curve.closed ? n : 0); ++i)
    if (distance_to_segment(point(i), point(i - 1), point(i + 1)) > limit) bends.push_back(i % n);
  return bends;
}

CurveProjection project_to_curve(const Curve& curve, const Vec3& x, int segment) {
  const int n = curve.segment_count();
  CurveProjection best = project_to_segment(curve, x, segment);
  double best2 = (x - best.point).squaredNorm();
  for (int direction : {1, -1}) {
    // The search ends after two segments without gain: a closer one may lie behind a reflex point.
    for (int s = segment + direction, misses = 0, steps = 0; misses < 2 && steps < n;
         s += direction, ++steps) {
      if (!curve.closed && (s < 0 || s >= n)) break;
      const CurveProjection projection = project_to_segment(curve, x, ((s % n) + n) % n);
      const double distance2 = (x - projection.point).squaredNorm();
      if (distance2 < best2) {
        best = projection;
        best2 = distance2;
        misses = 0;
      } else {
        ++misses;
      }
    }
  }
  return best;
}

int target_edge_count(const Curve& curve, double target_length, double chord_error) {
  const std::vector<double> arcs = arc_lengths(curve);
  const int max_count = std::max(curve.segment_count(), 3);
  int count = std::max(curve.closed ? 3 : 1, static_cast<int>(std::lround(arcs.back() / target_length)));
  while (count < max_count && chord_error_of(curve, arcs, count) > chord_error * target_length)
    count = std::min(max_count, count + std::max(1, count / 16));
  return count;
}

CurveFinder::CurveFinder(const std::vector<Curve>& curves) : curves_(&curves) {
  for (size_t c = 0; c < curves.size(); ++c)
    for (Eigen::Index i = 0; i < curves[c].points.cols(); ++i)
      locations_[key_of(curves[c].points.col(i))].push_back(
          {static_cast<int>(c), std::min(static_cast<int>(i), curves[c].segment_count() - 1)});
}

CurveFinder::Location CurveFinder::common(const Vec3& a, const Vec3& b) const {
  const auto at_a = locations_.find(key_of(a)), at_b = locations_.find(key_of(b));
  if (at_a == locations_.end() || at_b == locations_.end()) return {};
  const Vec3 middle = .5 * a + .5 * b;
  Location best;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Location& p : at_a->second)
    for (const Location& q : at_b->second) {
      if (p.curve != q.curve) continue;
      const int halfway = (p.segment + q.segment) / 2;
      const CurveProjection projection = project_to_curve((*curves_)[p.curve], middle, halfway);
      const double distance = (projection.point - middle).squaredNorm();
      if (distance >= smallest) continue;
      smallest = distance;
      best = {p.curve, projection.segment};
    }
  return best;
}

}  // namespace hooke
