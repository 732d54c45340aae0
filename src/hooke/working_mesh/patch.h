// The neighbourhood of an edge as a small mesh of its own, in which a flip, split or collapse is tested.
#pragma once

#include <optional>

#include "hooke/working_mesh/working_mesh.h"

namespace hooke {

/// An edge at which the patch ends but the mesh does not, or a crease within the patch.
struct PatchBoundary {
  int half_edge;   // of the mesh, on the side of the patch
  int from, to;    // its ends, as ids of the patch
  Edge twin_ends;  // ends of the twin, as ids of the patch; -1 if its face is not in the patch
};

/// The faces, vertices and constraints around an edge, whose ends are the vertices 0 and 1 of the patch.
struct EdgePatch {
  /// Ids in the whole mesh: the ends of the edge, then the other movable vertices, then those around them.
  std::vector<int> vertex_ids, wedge_ids;
  size_t movable = 0;           // the first vertices, of which those on feature edges stay fixed
  std::vector<Triangle> faces;  // all faces of the movable vertices, in ids of the patch
  std::vector<PatchBoundary> boundary;
  VertexTable vertices;
};

/// The vertices within `rings` rings around an inner edge, up to creases. Empty if there would be more than
/// `max_vertices` movable vertices, or if one of them has a valence above `max_vertices`.
std::optional<EdgePatch> cut_patch(const WorkingMesh& mesh, int half_edge, int rings, size_t max_vertices);

/// Only the two faces of the edge, without movable vertices.
EdgePatch cut_pair(const WorkingMesh& mesh, int half_edge);

/// The face with the half-edge `from` -> `to`. Pre-condition: there is one.
const Triangle& face_along(const std::vector<Triangle>& faces, int from, int to);

/// The faces of the patch after the flip of its edge.
std::vector<Triangle> flipped_faces(const EdgePatch& patch);

/// The faces of the patch after the split of its edge by this vertex.
std::vector<Triangle> split_faces(const EdgePatch& patch, int vertex);

/// The faces of the patch after the collapse of its edge to the end `stays`, 0 or 1.
std::vector<Triangle> collapsed_faces(const EdgePatch& patch, int stays);

/// Appends a vertex at the position of the vertex `source`, free on the surface and with the target length of
/// the edge's midpoint; the whole mesh has no such vertex yet. Returns its id in the patch.
int append_vertex(EdgePatch& patch, int source);

/// Writes the positions of the patch's free vertices to those of the whole mesh.
void move_vertices(const EdgePatch& patch, SurfacePositions& positions);

}  // namespace hooke
