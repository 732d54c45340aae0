// Seams: edges across which data of faces or corners change. Where vertices and faces are replaced, seams are
// kept like creases (ConstraintOptions::seams), so that the data can be carried over.
#pragma once

#include <vector>

#include "hooke/mesh/corner_data.h"
#include "hooke/mesh/face_data.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// Which changes across an edge make it a seam.
struct SeamKinds {
  bool texture = true;     // texture coordinates, at either end
  bool hard_edges = true;  // normals, see find_hard_edges()
  bool materials = true;   // channels of LabelKind::material
  bool groups = true;      // channels of LabelKind::group

  bool operator==(const SeamKinds&) const = default;
};

struct Seams {
  std::vector<int> edges;  // of the adjacency, ascending
  std::vector<Edge> ends;  // of these edges, as vertex ids of the mesh
  std::vector<int> poles;  // vertex ids of the mesh
  // Numbers of edges across which these change; an edge may count for several.
  std::size_t texture = 0, hard_edges = 0, materials = 0, groups = 0;
};

/// Finds the seams: edges with different texture coordinates at either end (see CornerDifferences), hard
/// edges of the normals, and edges with different labels on both sides. The boundary is no seam, and neither
/// are the edges at a pole of the texture that only differ there. `corners` and `faces`: by face id of the
/// mesh.
Seams find_seams(const MemoryOrder& memory_order, const CornerData& corners, const FaceData& faces,
                 const SeamKinds& kinds = {});

}  // namespace hooke
