// Geometry of single triangles: closest points, shape measures, angles, areas and normals. For the nearest of
// many triangles see geometry/aabb_tree.h.
#pragma once

#include <algorithm>
#include <limits>

#include "hooke/core/types.h"

namespace hooke {

struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  double squared_distance = std::numeric_limits<double>::infinity();
  int face = -1;  // of several faces; -1: none
};

/// Minimum squared doubled area of a triangle over the fourth power of its longest edge. Thinner triangles
/// have no reliable normal and are treated as their edges.
inline constexpr double min_triangle_squared_area = 1e-24;

/// Is the triangle with these edges, whose normal is as long as twice its area, not thinner?
inline bool has_reliable_normal(const Vec3& normal, const Vec3& ab, const Vec3& bc, const Vec3& ca) {
  const double longest = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  return normal.squaredNorm() > min_triangle_squared_area * longest * longest;
}

/// Closest point to x on the triangle a b c. A triangle without area is treated as its edges.
ClosestPoint closest_point(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Barycentric weights of a point of the triangle a b c: non-negative, with sum 1. In a thin triangle they
/// are those of the longest edge where these give the point more exactly.
Vec3 barycentric(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Distance of x to the segment a b, which may have no length.
double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b);

// Shape measures. Those that need an area are infinite or NaN without one.
// P. P. Pebay and T. J. Baker, "Analysis of triangle quality measures", 2003.

struct TriangleShape {
  double min_angle = 0;     // degrees, 60 at best
  double max_angle = 0;     // degrees, 60 at best
  double shape = 0;         // 4 sqrt(3) area / (sum of squared edges): 1 at best, 0 without area
  double radius_ratio = 0;  // circumradius / (2 inradius): 1 at best, unbounded
  double aspect_ratio = 0;  // longest edge / (2 sqrt(3) inradius): 1 at best, unbounded
  double edge_ratio = 0;    // longest edge / shortest edge: 1 at best, unbounded
};

TriangleShape measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

// The minimum corner angle, by its cotangent, which needs no trigonometry and decreases as the angle grows.

/// Cotangent of the minimum angle of a face, which is opposite its shortest edge; infinite without area.
double max_cotangent(const Mat3X& points, const Triangle& face);

/// Maximum over all faces of the above; infinite without faces.
double max_cotangent(const Mat3X& points, const std::vector<Triangle>& faces);

/// The angle with this cotangent, degrees.
double angle_with_cotangent(double cotangent);

/// Angle between vectors of any length, degrees; 0 if one is zero.
double angle_between(const Vec3& a, const Vec3& b);

/// Cotangent of an angle in degrees.
double cotangent_of(double angle);

/// How many faces turn over or lose their area when the points go elsewhere; those without area do not count.
std::ptrdiff_t count_turned_faces(const Eigen::Ref<const Mat3X>& points, const Eigen::Ref<const Mat3X>& moved,
                                  const std::vector<Triangle>& faces);

/// Minimum corner angle of all faces, degrees; 0 without faces.
double min_angle(const Mat3X& points, const std::vector<Triangle>& faces);

// Area and normal, and the criterion for degenerate faces.

struct FaceShape {
  double area = 0;
  Vec3 normal = Vec3::Zero();  // unit, outward; zero where the face is degenerate
  Vec3 centre = Vec3::Zero();  // mean of the corners

  bool degenerate() const { return normal.isZero(0); }
};

/// Normal of the face with twice the area as its length.
inline Vec3 doubled_area_vector(const Mat3X& points, const Triangle& face) {
  const Vec3 a = points.col(face[0]);
  return (points.col(face[1]) - a).cross(points.col(face[2]) - a);
}

/// A face is degenerate if its doubled area is below 1e-12 of its longest edge squared: then the rounding of
/// the coordinates determines the direction of its normal.
inline FaceShape face_shape(const Eigen::Ref<const Mat3X>& points, const Triangle& face) {
  const Vec3 a = points.col(face[0]), b = points.col(face[1]), c = points.col(face[2]);
  const Vec3 cross = (b - a).cross(c - a);
  const double double_area = cross.norm();
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  FaceShape shape{.5 * double_area, Vec3::Zero(), (a + b + c) / 3};
  if (double_area > 1e-12 * longest) shape.normal = cross / double_area;
  return shape;
}

// Alignment of faces and edges with the normals of a surface, and of faces with each other.

/// Cosine between the normal of the face and the sum of the surface normals at its corners; 0 without area.
/// `wedges` are those of the corners: the columns of their normals.
double face_alignment(const Mat3X& points, const Mat3X& normals, const Triangle& face,
                      const Triangle& wedges);

/// The same away from creases, where the wedges are the vertices.
inline double face_alignment(const Mat3X& points, const Mat3X& normals, const Triangle& face) {
  return face_alignment(points, normals, face, face);
}

/// Sagitta (l / 2) tan(theta / 4) of a circular arc over an edge of length l whose end normals differ by
/// theta. `wedges` are those of the ends: the columns of their normals.
double edge_sagitta(const Mat3X& points, const Mat3X& normals, const Edge& edge, const Edge& wedges);

inline double edge_sagitta(const Mat3X& points, const Mat3X& normals, const Edge& edge) {
  return edge_sagitta(points, normals, edge, edge);
}

/// Cosine between the normals of two faces; 1 where one has no area.
double cosine_between(const Mat3X& points, const Triangle& face, const Triangle& other);

/// The same from the area vectors of the faces.
double cosine_between(const Vec3& area_vector, const Vec3& other);

}  // namespace hooke
