// The neighbourhood of an edge as a small mesh of its own, in which a change of the edge is tried.
#pragma once

#include <optional>

#include "hooke/filter/retraction.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {

/// An edge with which a patch ends though the mesh goes on, or a crease that ends within it.
struct PatchBoundary {
  int half_edge;  // of the mesh, on the patch's side
  int from, to;   // its ends, in ids of the patch
  Edge beyond;    // those of the half-edge across, if its face is in the patch too; else -1
};

struct EdgePatch {
  /// Of the whole mesh: the edge's ends first, then the others that may move, then those around.
  std::vector<int> vertices, wedges;
  size_t movable = 0;           // so many may move, but for those on creases and boundaries
  std::vector<Triangle> faces;  // all that the movable ones have, in ids of the patch
  std::vector<PatchBoundary> rim;
  SurfacePositions positions;
  std::vector<double> vertex_length;
  Constraints constraints;
};

/// The vertices within so many rings about an inner edge, as far as creases. Nothing where more than `most`
/// vertices would move, or one of them has more edges.
std::optional<EdgePatch> cut_patch(const FlippableMesh& mesh, int half_edge, int rings, size_t most);

/// Only the two faces of the edge, of which no vertex may move.
EdgePatch cut_pair(const FlippableMesh& mesh, int half_edge);

/// The one of these faces that runs along from one vertex to the other. Pre-condition: there is one.
const Triangle& face_along(const std::vector<Triangle>& faces, int from, int to);

/// The faces of the patch after the flip of its edge.
std::vector<Triangle> flipped_faces(const EdgePatch& patch);

/// After its edge has been halved by this vertex.
std::vector<Triangle> split_faces(const EdgePatch& patch, int vertex);

/// After its edge has become one of its ends: 0 or 1.
std::vector<Triangle> collapsed_faces(const EdgePatch& patch, int stays);

/// Appends a vertex that is where another one is, free to move on the surface; the whole mesh has none for it
/// yet. Its target length is that of the middle of the edge. Returns its id.
int append_vertex(EdgePatch& patch, int like);

/// Moves the vertices of the mesh to where those of the patch are.
void move_vertices(const EdgePatch& patch, SurfacePositions& positions);

}  // namespace hooke
