// The surface that a mesh represents, as a field psi that is zero on it, and the projection to it: Newtonian
// filtering. "Hooke's Optimization for 3D triangular mesh", sections 3.3, 4.4 and 4.5.
#pragma once

#include <cstddef>
#include <memory>

#include "hooke/core/types.h"
#include "hooke/filter/filter.h"
#include "hooke/filter/surface.h"
#include "hooke/filter/thin_plate_spline.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/surface_point.h"

namespace hooke {

/// Closest points on the faces of a mesh, for points that are tracked near one of its vertices; for arbitrary
/// points see geometry/aabb_tree.h. Refers to the mesh, which must outlive it; cheap to create.
struct NearFaces {
  const Mat3X& points;
  const Mat3X& normals;  // unit vertex normals
  const Adjacency& adjacency;

  /// The vertex reached from `vertex` by steepest descent of the distance to x over mesh edges.
  int nearest_vertex(const Vec3& x, int vertex) const;

  /// Whether a face at the hint has a point within the distance of x. Other faces may be closer.
  bool has_face_within(const Vec3& x, int hint, double distance) const;

  /// The projection of x to a point of a face: the normal is interpolated from the corners, the hint is the
  /// nearest one. If there is none, x with normal zero, the hint given and no_cover.
  Projection projection_to(const ClosestPoint& point, const Vec3& x, int hint) const;

  /// That to closest_point_nearby().
  Projection closest_point(const Vec3& x, int hint) const;
};

/// The field of a reference mesh, whose vertices lie on the surface. Shares ownership of what it needs, is
/// cheap to copy, and is thread-safe.
class SurfaceField {
 public:
  /// Throws LimitError if the global fit needs more than the memory limit, NumericalError if it has no
  /// solution (all vertices coincide, or two nearly do).
  /// `pieces` numbers the parts of the surface by vertex, so that the global fit gives each a spline of its
  /// own; empty: one spline. `lengths`, per vertex, are the unit of options.max_deviation; empty: 1.
  SurfaceField(std::shared_ptr<const Mat3X> points, std::shared_ptr<const Adjacency> adjacency,
               const FilterOptions& options = {}, std::vector<int> pieces = {},
               const std::vector<double>& lengths = {});

  /// Projects x, tracked near the reference vertex `hint`, to within `tolerance` (a length) of the surface.
  /// The hint first walks over mesh edges to the nearest vertex that descent can reach. If Newton's method
  /// fails, the result is the closest point on the faces near the hint and the status tells why. A result
  /// beyond the deviation bound (options.max_deviation) is moved back to it. Over faces that the splines do
  /// not follow the surface is made of curved facets, see curved_facets.h. At a vertex without faces: x,
  /// normal zero, no_cover.
  Projection project(const Vec3& x, int hint, double tolerance) const;

  /// psi at x: zero on the surface, approximately the signed distance near it, positive outside. The hint
  /// does not walk. Zero value and gradient mean that the field does not cover x. For `closest` the exact
  /// signed distance; for `none` always 0.
  FieldSample sample(const Vec3& x, int hint) const;

  /// The projection and the shape operators as a Surface, which keeps the field alive.
  Surface surface() const;

  const Mat3X& points() const;
  /// Unit vertex normals of the reference; zero for vertices without faces.
  const Mat3X& normals() const;
  /// Bytes held by the field and its reference, adjacency excluded.
  std::size_t memory_bytes() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace hooke
