// Closest points of a surface's faces, for points that are tracked near one of its vertices. Those of any
// point: bounding_volume_tree.h.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>

#include "hooke/core/types.h"
#include "hooke/filter/surface.h"
#include "hooke/filter/thin_plate_spline.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Refers to the mesh: cheap to make, and must not outlive it.
struct NearFaces {
  const Mat3X& points;
  const Mat3X& normals;  // unit, of the vertices
  const Adjacency& adjacency;

  /// Walks from the vertex over edges while that brings it closer to x: steepest descent of the distance.
  int nearest_vertex(const Vec3& x, int vertex) const;

  /// Has a face at the hint a point within the distance? No more than that: others may be closer.
  bool has_face_within(const Vec3& x, int hint, double distance) const;

  /// Closest point of the faces about the hint and about its neighbours, from where it walks on while that
  /// brings it closer. Its normal is blended from those of the corners, its hint the nearest corner. x
  /// itself, normal zero and no_cover where the hint has no faces.
  Projection closest_point(const Vec3& x, int hint) const;

 private:
  Projection closest_point_of_ring(const Vec3& x, int hint) const;
};

// The surface that a mesh stands for, as a field psi that is zero on it, and the way back to it: Newtonian
// filtering. "Hooke's Optimization for 3D triangular mesh", sections 3.3, 4.4 and 4.5.

/// How points are put back on the surface.
enum class FilterKind {
  local,    // splines on patches, blended: any size
  global,   // the paper's one dense spline [30]: a few thousand vertices
  closest,  // closest point of the faces
  none,     // points stay where they are
};

struct FilterOptions {
  FilterKind kind = FilterKind::local;
  Kernel kernel = Kernel::r3;
  double offset = .3;  // rho of [13] over the mean edge length: at each vertex (local), of the mesh (global)
  std::size_t memory_limit_bytes = SIZE_MAX;  // of the dense fit (global)
  /// Greatest distance of the surface from the faces, over the vertices' lengths, where splines may swing far
  /// out: about long edges along which the normals turn.
  double max_deviation = std::numeric_limits<double>::infinity();
};

/// The field of a mesh with vertices on the surface (the reference). It keeps what it needs, may outlive the
/// mesh, is cheap to copy, and may be asked by several threads at once.
class SurfaceField {
 public:
  /// Throws LimitError when the global fit needs more than the memory limit, NumericalError when it has no
  /// solution (all vertices in one place, or two nearly so).
  /// `pieces` numbers the parts of the surface by vertex, for the global fit to give each a spline of its
  /// own; empty: one spline. `lengths` of the vertices are what options.reach counts in; empty: 1.
  SurfaceField(std::shared_ptr<const Mat3X> points, std::shared_ptr<const Adjacency> adjacency,
               const FilterOptions& options = {}, std::vector<int> pieces = {},
               const std::vector<double>& lengths = {});

  /// Puts x, tracked near the reference vertex `hint`, back on the surface to within `tolerance` (a
  /// length). The hint first walks over mesh edges to the nearest vertex it can reach downhill. Where
  /// Newton fails, the foot is the closest point of the faces about the hint and the status says why; where
  /// options.reach holds it back, as field_reach.h tells. On a
  /// vertex without faces: x itself, normal zero, no_cover.
  Projection project(const Vec3& x, int hint, double tolerance) const;

  /// psi at x: zero on the surface, about the distance near it, growing outward. The hint does not walk.
  /// Zero value and gradient mean that the field does not reach x. For `closest` the signed distance; for
  /// `none` always 0.
  FieldSample sample(const Vec3& x, int hint) const;

  /// project() as the optimizer wants it; keeps the field alive.
  Surface surface() const;

  const Mat3X& points() const;
  /// Unit vertex normals of the reference; zero where there are no faces.
  const Mat3X& normals() const;
  /// Bytes held by the field and its reference, connectivity excluded.
  std::size_t memory_bytes() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace hooke
