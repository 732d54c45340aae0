// Boundaries that lie on each other: a surface that is cut open, along a seam of its texture for instance.
#pragma once

#include <vector>

#include "hooke/constraints/crease_detection.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Ids, ascending, of boundary vertices that have exactly the coordinates of another boundary vertex.
std::vector<int> coincident_boundary_vertices(const Mat3X& points, const Adjacency& adjacency);

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
  CreaseOptions features = {};
};

struct Constraints {
  std::vector<Freedom> freedom;  // per vertex
  std::vector<int> curve;        // per vertex: index into curves, -1 without
  std::vector<int> segment;      // per vertex: where on its curve it starts
  std::vector<Curve> curves;
  std::vector<Edge> creases;      // edges, by their vertices, that no change of the connectivity may lose
  std::vector<int> extra_wedges;  // of vertices on creases, see connectivity.h; each has a normal of its own
  int crease_curves = 0;          // of the curves: the last ones

  // How far each vertex may go from its home; both are empty where there is no limit.
  Mat3X rest_position;
  std::vector<double> max_travel;

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
Constraints find_constraints(const Mat3X& points, const Adjacency& adjacency,
                             const ConstraintOptions& options);

/// Per side: the number of edges that each corner wants: 1 + max(1, round(angle / 60 degrees)), by the angle
/// that its faces span. 0 for all others. A corner is a side, between two creases or boundary edges, of a
/// vertex that stands still, where the faces span no straight angle to within `corner_angle` degrees.
std::vector<int> corner_valences(const Mat3X& points, const Adjacency& adjacency,
                                 const Constraints& constraints, double corner_angle);

}  // namespace hooke
