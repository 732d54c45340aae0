// Data of faces and corners of a file that belong to a result with moved vertices, or with new faces.
#pragma once

#include "hooke/mesh/chart_places.h"
#include "hooke/mesh/corner_data.h"
#include "hooke/mesh/face_data.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// The triangles of an input and of its result. Points and adjacencies are in memory order, the adjacencies
/// with their feature edges (see ChartedSurface), the data by face id.
struct Remeshed {
  ChartedSurface input;
  const MemoryOrder& input_order;
  ChartedSurface result;
  const Permutation& result_order;
};

/// The data of the new faces: each takes that of the face at its centre.
FaceData carry_face_data(const FaceData& data, const ChartPlaces& places, const Remeshed& meshes);

/// The texture coordinates and normals of the new faces. Texture coordinates are interpolated linearly in the
/// faces of the input, on the same side of each feature edge, and continuous across all other edges; at a
/// vertex of the input they are its own, and at a pole (see CornerDifferences) each face has those of the
/// face of the input there. Normals are computed from the new faces, with hard edges where those of the input
/// are feature edges; flat if those of the input are, see find_hard_edges().
CornerData carry_corner_data(const CornerData& data, const ChartPlaces& places, const Remeshed& meshes);

/// The normals of moved triangles, see renew_corner_normals().
CornerValues moved_normals(const CornerValues& normals, const std::vector<Triangle>& triangles,
                           const Mat3X& before, const Mat3X& after);

}  // namespace hooke
