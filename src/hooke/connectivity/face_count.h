// Face count control: splits and collapses until each feature curve has its target number of edges and the
// mesh the number of faces that follows from the target lengths.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct VertexTable;
struct WorkingMesh;

/// The number of equilateral triangles of the target length that cover the surface: the sum over the faces of
/// 4 A / (sqrt 3 L^2), or of 1 for a frozen one.
double target_face_count(const VertexTable& vertices, const std::vector<Triangle>& faces);

/// The same as if no face were frozen.
double target_face_count(const Mat3X& points, const std::vector<double>& vertex_length,
                         const std::vector<Triangle>& faces);

struct CountChanges {
  int splits = 0;
  int collapses = 0;
};

/// Splits the longest or collapses the shortest edges of each feature curve until it has its target number.
/// Pre-condition: count_curve_edges().
CountChanges match_curve_edges(WorkingMesh& mesh);

/// The number of edges that approach_face_count() changes where nothing holds them.
int changes_towards(double target, double faces);

/// Brings the number of faces closer to `target` by splits or collapses of inner edges without a common
/// neighbour, preferring the longest or shortest edges and those whose change leaves the best valences.
CountChanges approach_face_count(WorkingMesh& mesh, double target);

}  // namespace hooke
