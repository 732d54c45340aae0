// The working mesh of the algorithms that change connectivity: a half-edge mesh with the data of its vertices
// (position, constraints, target length).
#pragma once

#include <functional>

#include "hooke/constraints/feature_curves.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/vertex_table.h"

namespace hooke {

struct Workspace;

/// A mesh whose edges are flipped, split and collapsed and whose vertices move on the surface. The table and
/// the retraction must outlive it. From a split or collapse until compact() the rows of the table have the
/// ids of the half-edge mesh.
struct WorkingMesh {
  /// Pre-condition: the rows of the table are those of the adjacency. Numbers vertices.previous_ids anew.
  WorkingMesh(const Adjacency& adjacency, VertexTable& vertices, Retraction& retraction);

  /// Edits the mesh of a workspace, see Workspace::replace_faces() and replace_mesh(). Pre-condition: the
  /// vertices lie on the field of the input.
  explicit WorkingMesh(Workspace& work);

  HalfedgeMesh halfedges;
  VertexTable& vertices;
  Retraction& retraction;
  CurveFinder curve_finder;
  CurveEdges curve_edges;
  /// Called after vertices have moved, to update their target lengths to their new positions.
  std::function<void()> after_move = nullptr;
  /// The target length at a vertex, where these vary faster than along its edges; null: the mean of the ends
  /// of an edge is that of its middle.
  std::function<double(int vertex)> length_at = nullptr;
};

/// The curve on which a feature edge lies; curve -1 if none is known.
CurveFinder::Location curve_of(const WorkingMesh& mesh, int half_edge);

/// Whether the edge is one of a junction; only match_junction_edges() splits or collapses these.
bool is_junction_edge(const WorkingMesh& mesh, int half_edge);

/// Whether the edge is neither flipped nor split, see Constraints::frozen.
bool is_frozen_edge(const WorkingMesh& mesh, int half_edge);

/// Target length of an edge between the vertices.
inline double target_length(const WorkingMesh& m, int v, int w) {
  return .5 * (m.vertices.vertex_length[v] + m.vertices.vertex_length[w]);
}

/// Length of the edge over its target length.
double relative_length(const WorkingMesh& mesh, int half_edge);

/// Updates curve_edges: the edges present per curve, and their target number, which is one per target length,
/// plus what it takes to keep the chords within `chord_error` target lengths of the curve.
void count_curve_edges(WorkingMesh& mesh, double chord_error);

/// Adds the data of a vertex in the middle of the edge, on its curve or on the surface, and of its wedges; no
/// other function adds vertices. The half-edge mesh is not changed. Returns the id that a split of the edge
/// will assign. `middle` is the result of project_midpoint() if known, else null.
int add_vertex(WorkingMesh& mesh, int half_edge, const SurfacePosition* middle = nullptr);

/// The surface position of the midpoint of an edge that is no feature edge; safe for different edges at once.
SurfacePosition project_midpoint(const WorkingMesh& mesh, int half_edge);

/// Removes the data added last, when the split was not made.
void remove_last_vertex(WorkingMesh& mesh);

/// Removes unused ids, numbers the wedges as split_wedges() does, and writes the creases to the constraints.
void compact(WorkingMesh& mesh);

}  // namespace hooke
