// All data of the vertices of a working mesh and of their wedges, one row each.
#pragma once

#include <vector>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"

namespace hooke {

/// The columns of the vertices and wedges. Between changes of the connectivity the wedges of a vertex follow
/// those of all vertices (see mesh/adjacency.h); while a HalfedgeMesh is edited, both share its ids, every
/// column but an empty one has a row for each id, and the matrices have spare columns.
struct VertexTable {
  SurfacePositions positions;
  Constraints constraints;            // with `freedom` and `curve` per vertex
  std::vector<double> vertex_length;  // per vertex: normalised target length
  std::vector<int> origins;           // per vertex: its index in the input's points, -1 for a new one
  std::vector<int> previous_ids;      // per vertex: its id before the present edit, -1 for a new one
  std::vector<int> corner_valences;   // per wedge: target valence of a corner, else 0; see corner_valences()

  /// Sets the number of rows for vertices and wedges alike; new rows are those of fixed vertices without
  /// curve, origin or length. Matrices that are too small get `spare` columns more, as each growth copies.
  void resize(int ids, int spare = 0);

  /// These rows of vertices and wedges, with the constraints but for their curves, creases and limits.
  VertexTable rows(const std::vector<int>& vertices, const std::vector<int>& wedges) const;

  /// Keeps these rows of vertices and wedges, in this order. `extra_wedges`: vertex of each extra wedge
  /// afterwards, see mesh/adjacency.h.
  void keep(const std::vector<int>& vertices, const std::vector<int>& wedges, std::vector<int> extra_wedges);
};

}  // namespace hooke
