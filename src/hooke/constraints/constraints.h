// Boundaries that lie on each other: a surface that is cut open, along a seam of its texture for instance.
#pragma once

#include <vector>

#include "hooke/constraints/crease_detection.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Ids, ascending, of boundary vertices that have exactly the coordinates of another boundary vertex.
std::vector<int> coincident_boundary_vertices(const Mat3X& points, const Connectivity& connectivity);

// What a vertex may do: move on the surface, slide along a curve of the input, or stand still.

enum class Freedom : unsigned char { surface, curve, fixed };

enum class BoundaryRule { slide, fixed, free };

struct ConstraintOptions {
  BoundaryRule boundary = BoundaryRule::slide;
  std::vector<int> fixed_vertices = {};  // ids of vertices that stay where they are
  double corner_angle = 35;  // degrees; a curve that turns by more in 3-D has a corner, which stands still
  // A crease whose longest edge is no longer than this over its shortest (below 1: none) keeps its vertices
  // at bends: where they stand farther off the chord past them than this part of a mean edge.
  double even_crease = 1.5;
  double crease_bend = .01;
  FeatureOptions features = {};
};

/// A polyline of the input along which vertices slide: open between two corners, or closed.
struct Curve {
  Mat3X points;
  Mat3X tangents;  // unit, at the points; the mean of the segments that meet there
  bool closed = false;

  int segment_count() const { return static_cast<int>(points.cols()) - (closed ? 0 : 1); }
};

/// A place on a curve.
struct CurveFoot {
  Vec3 point;
  Vec3 tangent;  // unit
  int segment = 0;
};

/// Closest point of the curve to x, found by walking from `segment`.
CurveFoot project_to_curve(const Curve& curve, const Vec3& x, int segment);

struct Constraints {
  std::vector<Freedom> freedom;  // per vertex
  std::vector<int> curve;        // per vertex: index into curves, -1 without
  std::vector<int> segment;      // per vertex: where on its curve it starts
  std::vector<Curve> curves;
  std::vector<Edge> creases;       // edges, by their vertices, that no change of the connectivity may lose
  std::vector<int> further_sides;  // of vertices on creases, see connectivity.h; each has a normal of its own
  int crease_curves = 0;           // of the curves: the last ones

  // How far each vertex may go from its home; both are empty where there is no limit.
  Mat3X home;
  std::vector<double> reach;

  /// Does the vertex stand still at a bend of the curve that it is on?
  bool at_bend(int vertex) const {
    const auto v = static_cast<size_t>(vertex);
    return freedom[v] == Freedom::fixed && curve[v] >= 0;
  }
};

/// Boundary loops and the creases of the connectivity become curves. They end at corners, where three or more
/// of them meet or one ends, and where a crease meets the boundary: such vertices stand still. So do those at
/// the bends of even creases (see the options), though the curve goes on there; vertices without faces; and
/// those of coincident_boundary_vertices(), between which a gap would open.
Constraints find_constraints(const Mat3X& points, const Connectivity& connectivity,
                             const ConstraintOptions& options);

}  // namespace hooke
