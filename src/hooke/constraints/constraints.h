// Constraints on the motion of vertices: which of them move on the surface, slide along a feature curve of
// the input, or stand still, and the target valences of corners.
#pragma once

#include <optional>
#include <vector>

#include "hooke/constraints/constraint_options.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Ids, ascending, of the boundary vertices with exactly the coordinates of another boundary vertex, as where
/// a surface is cut open along a texture seam.
std::vector<int> coincident_boundary_vertices(const Mat3X& points, const Adjacency& adjacency);

/// What a vertex may do: move on the surface, slide along a curve of the input, or stand still.
enum class Freedom : unsigned char { surface, curve, fixed };

/// A vertex of a junction, with all its copies.
struct JunctionVertex {
  int curve = -1;       // index into junction_curves; -1 where curves end and off them
  bool slides = false;  // along that curve; else it stands still
};

struct JunctionEdge {
  Edge ends;  // numbers of vertices, smaller one first
  int curve;  // index into junction_curves
};

struct Constraints {
  std::vector<Freedom> freedom;  // per vertex
  std::vector<int> curve;        // per vertex: index into curves, -1 without one
  std::vector<int> segment;      // per vertex: segment of its curve on which it starts; not kept up to date
  std::vector<char> frozen;  // per vertex: do its edges to other such vertices stay? empty if there are none
  /// Per vertex what it may do again when it is released, see Workspace::hold_others(); none for one that is
  /// not held. Empty if none is. Held ones are fixed and frozen.
  std::vector<std::optional<Freedom>> held;
  std::vector<Curve> curves;
  std::vector<Edge> creases;      // crease edges, by their vertices, which no change of the faces may lose
  std::vector<int> extra_wedges;  // vertex of each extra wedge at creases, see mesh/adjacency.h
  int crease_curves = 0;          // number of curves that are creases; they are the last ones

  // Junctions, see mesh/junctions.h and junction_curves.h. A number stands for all copies of a vertex, which
  // are `fixed` for all that moves a vertex by itself.
  std::vector<int> junction;  // per vertex its number, -1 off junctions; empty without any
  std::vector<JunctionVertex> junction_vertices;  // by number
  std::vector<JunctionEdge> junction_edges;       // sorted by their ends
  std::vector<Curve> junction_curves;

  // Rest position and maximal travel from it of each vertex; both are empty if there is no limit.
  Mat3X rest_position;
  std::vector<double> max_travel;

  /// Whether the vertex stands still, and would if it were not held.
  bool is_fixed(int vertex) const {
    const size_t v = vertex;
    return (held.empty() ? freedom[v] : held[v].value_or(freedom[v])) == Freedom::fixed;
  }

  /// Whether the vertex stands still at a bend of the curve that it is on.
  bool at_bend(int vertex) const { return is_fixed(vertex) && curve[vertex] >= 0; }

  /// Whether the edge between the vertices is neither flipped nor split. None of its ends is removed.
  bool is_frozen(int v, int w) const { return !frozen.empty() && frozen[v] && frozen[w]; }

  /// Whether the face stays: one of the input, or one between held vertices.
  bool is_frozen(const Triangle& t) const { return is_frozen(t[0], t[1]) && is_frozen(t[1], t[2]); }

  /// What the vertex shares with its copies; null off junctions.
  const JunctionVertex* junction_vertex(int vertex) const {
    const size_t v = vertex;
    return v < junction.size() && junction[v] >= 0 ? &junction_vertices[junction[v]] : nullptr;
  }

  /// Whether the vertex slides along a curve of a junction, together with its copies.
  bool slides_with_copies(int vertex) const {
    const JunctionVertex* const at = junction_vertex(vertex);
    return at && at->slides;
  }
};

/// Turns the boundary loops and creases of the adjacency into curves. Curves end at corners, where three or
/// more of them meet or one ends, and where a crease meets the boundary; such vertices stand still. So do the
/// vertices at the bends of even creases (see ConstraintOptions), where the curve goes on;
/// options.fixed_vertices; options.frozen_vertices, where curves end; vertices without faces; and
/// coincident_boundary_vertices(), between which a gap would open.
Constraints find_constraints(const Mat3X& points, const Adjacency& adjacency,
                             const ConstraintOptions& options);

/// Target valence of each corner: 1 + max(1, round(angle / 60 degrees)) edges, by the angle that its faces
/// span; per wedge, 0 for those that are not corners. A corner is a wedge, between two feature edges, of a
/// vertex that stands still, unless its faces span a straight angle to within
/// ConstraintOptions::corner_angle.
std::vector<int> corner_valences(const Mat3X& points, const Adjacency& adjacency,
                                 const Constraints& constraints);

}  // namespace hooke
