#include "hooke/geometry/triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

/// Parameter in [0, 1] of the point of the segment a b closest to x.
double closest_parameter(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double squared_length = d.squaredNorm();
  return squared_length > 0 ? std::clamp(d.dot(x - a) / squared_length, 0., 1.) : 0;
}

Vec3 closest_on_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  return a + closest_parameter(x, a, b) * (b - a);
}

double cosine_or(const Vec3& a, const Vec3& b, double otherwise) {
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0 ? a.dot(b) / lengths : otherwise;
}

}  // namespace

ClosestPoint closest_point(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  ClosestPoint best;
  const Vec3 n = (b - a).cross(c - a);
  const double nn = n.squaredNorm();
  if (has_reliable_normal(n, b - a, c - b, a - c)) {
    const bool inside =
        n.cross(b - a).dot(x - a) >= 0 && n.cross(c - b).dot(x - b) >= 0 && n.cross(a - c).dot(x - c) >= 0;
    if (inside) {
      const double height = n.dot(x - a);
      best.point = x - (height / nn) * n;
      best.squared_distance = height * height / nn;
      return best;
    }
  }
  for (const Vec3& p :
       {closest_on_segment(x, a, b), closest_on_segment(x, b, c), closest_on_segment(x, c, a)}) {
    const double squared_distance = (x - p).squaredNorm();
    if (squared_distance >= best.squared_distance) continue;
    best.squared_distance = squared_distance;
    best.point = p;
  }
  return best;
}

Vec3 barycentric(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double thin = 1e-12;  // squared doubled area over the fourth power of the longest edge
  const Vec3 n = (b - a).cross(c - a);
  const Vec3 squares((b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm());
  Vec3 weights(n.dot((c - b).cross(x - b)), n.dot((a - c).cross(x - c)), n.dot((b - a).cross(x - a)));
  weights = weights.cwiseMax(0);
  weights /= weights.sum();
  Eigen::Index longest;
  const double length2 = squares.maxCoeff(&longest);
  if (n.squaredNorm() > thin * length2 * length2) return weights;
  const std::array<Vec3, 3> corners = {a, b, c};
  const Eigen::Index next = (longest + 1) % 3;
  const double t = closest_parameter(x, corners[longest], corners[next]);
  Vec3 on_edge = Vec3::Zero();
  on_edge[longest] = 1 - t;
  on_edge[next] = t;
  const auto error = [&](const Vec3& w) { return (w[0] * (a - x) + w[1] * (b - x) + w[2] * (c - x)).norm(); };
  return error(weights) < error(on_edge) ? weights : on_edge;
}

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  return (x - closest_on_segment(x, a, b)).norm();
}

namespace {

/// Twice the area, from the two shorter edges, whose cross product has the smallest rounding error.
double doubled_area_of_edges(const Vec3& ab, const Vec3& bc, const Vec3& ca, const Vec3& lengths) {
  Eigen::Index longest = 0;
  lengths.maxCoeff(&longest);
  return (longest == 0 ? bc.cross(ca) : longest == 1 ? ca.cross(ab) : ab.cross(bc)).norm();
}

/// Angle in degrees; 0 if an edge has no length. The arc tangent keeps all digits near 0 and 180, where the
/// arc cosine loses half of them.
double angle_of(double product, double doubled_area) {
  return std::atan2(doubled_area, product + 0.) * (180 / std::numbers::pi);  // atan2(0, -0) would be 180
}

}  // namespace

double angle_between(const Vec3& a, const Vec3& b) {
  const double product = a.dot(b) + 0.;                                    // atan2(0, -0) would be 180
  return std::atan2(a.cross(b).norm(), product) * 180 / std::numbers::pi;  // 90 exactly for right angles
}

TriangleShape measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const Vec3 lengths(ab.norm(), bc.norm(), ca.norm());
  const double x = lengths[0], y = lengths[1], z = lengths[2];
  const auto [shortest, longest] = std::minmax({x, y, z});
  const double twice = doubled_area_of_edges(ab, bc, ca, lengths), area = .5 * twice;
  const auto [smallest, largest] = std::minmax({-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)});
  const double perimeter = x + y + z;
  const double squares = x * x + y * y + z * z;

  TriangleShape t;
  t.min_angle = angle_of(largest, twice);
  t.max_angle = angle_of(smallest, twice);
  t.shape = squares > 0 ? 4 * std::numbers::sqrt3 * area / squares : 0;
  t.radius_ratio = (x / area) * (y / area) * z * perimeter / 16;  // R = xyz / 4A, r = 2A / perimeter
  t.aspect_ratio = longest * perimeter / (4 * std::numbers::sqrt3 * area);
  t.edge_ratio = longest / shortest;
  return t;
}

double max_cotangent(const Mat3X& points, const Triangle& face) {
  const Vec3 p = points.col(face[0]), q = points.col(face[1]), r = points.col(face[2]);
  const Vec3 a = r - q, b = p - r, c = q - p;
  const double a2 = a.squaredNorm(), b2 = b.squaredNorm(), c2 = c.squaredNorm();
  const double cosine = .5 * (a2 + b2 + c2 - 2 * std::min({a2, b2, c2}));  // times the other two lengths
  const double sine = b.cross(c).norm();
  return sine > 0 ? cosine / sine : std::numeric_limits<double>::infinity();
}

double angle_with_cotangent(double cotangent) {
  return std::atan2(1, cotangent) * 180 / std::numbers::pi;
}

double cotangent_of(double angle) {
  return 1 / std::tan(angle * std::numbers::pi / 180);
}

double max_cotangent(const Mat3X& points, const std::vector<Triangle>& faces) {
  constexpr size_t faces_per_task = 4096;
  std::vector<double> largest((faces.size() + faces_per_task - 1) / faces_per_task);
  parallel_for(largest.size(), 1, [&](size_t begin, size_t end) {
    for (size_t b = begin; b < end; ++b) {
      double cotangent = -std::numeric_limits<double>::infinity();
      for (size_t f = b * faces_per_task; f < std::min(faces.size(), (b + 1) * faces_per_task); ++f)
        cotangent = std::max(cotangent, max_cotangent(points, faces[f]));
      largest[b] = cotangent;
    }
  });
  return largest.empty() ? std::numeric_limits<double>::infinity() : *std::ranges::max_element(largest);
}

double min_angle(const Mat3X& points, const std::vector<Triangle>& faces) {
  return angle_with_cotangent(max_cotangent(points, faces));
}

double face_alignment(const Mat3X& points, const Mat3X& normals, const Triangle& face,
                      const Triangle& wedges) {
  return cosine_or(doubled_area_vector(points, face),
                   Vec3(normals.col(wedges[0]) + normals.col(wedges[1]) + normals.col(wedges[2])), 0);
}

double edge_sagitta(const Mat3X& points, const Mat3X& normals, const Edge& edge, const Edge& wedges) {
  const double c = std::clamp(normals.col(wedges[0]).dot(normals.col(wedges[1])), -1., 1.);
  const double tan_quarter = std::sqrt(.5 * (1 - c)) / (1 + std::sqrt(.5 * (1 + c)));
  return .5 * (points.col(edge[1]) - points.col(edge[0])).norm() * tan_quarter;
}

double cosine_between(const Mat3X& points, const Triangle& face, const Triangle& other) {
  return cosine_between(doubled_area_vector(points, face), doubled_area_vector(points, other));
}

double cosine_between(const Vec3& area_vector, const Vec3& other) {
  return cosine_or(area_vector, other, 1);
}

std::ptrdiff_t count_turned_faces(const Eigen::Ref<const Mat3X>& points, const Eigen::Ref<const Mat3X>& moved,
                                  const std::vector<Triangle>& faces) {
  const auto normal = [](const Eigen::Ref<const Mat3X>& x, const Triangle& t) -> Vec3 {
    const Vec3 a = x.col(t[0]), ab = x.col(t[1]) - a, ac = x.col(t[2]) - a;
    return ab.cross(ac);
  };
  return std::ranges::count_if(faces, [&](const Triangle& t) {
    const Vec3 n = normal(points, t);
    return !n.isZero(0) && !(n.dot(normal(moved, t)) > 0);
  });
}

}  // namespace hooke
