// Count control: as many edges on each curve as it wants, and as many faces as the target lengths ask for.
#pragma once

#include "hooke/connectivity/collapse_passes.h"
#include "hooke/connectivity/edge_splits.h"

namespace hooke {

struct CountOptions {
  double largest_part = .02;   // of the edges, changed in one go
  double valence_weight = .1;  // of an irregular valence against l / L when edges are chosen
  SplitOptions split{.longest = 0};
  CollapseOptions collapse{.longest = 1.6, .valence = 8};
};

/// 4 A / (sqrt 3 L^2), summed over the faces: the number of equilateral triangles of the target length that
/// cover the surface.
double wanted_face_count(const Mat3X& points, const std::vector<Triangle>& faces,
                         const std::vector<double>& vertex_length);

struct CountChanges {
  int splits = 0;
  int collapses = 0;
};

/// Splits the longest and collapses the shortest edges of each curve until it has as many as it wants.
CountChanges match_curve_edges(WorkingMesh& mesh, const CountOptions& options);

/// Brings the number of faces closer to `wanted` by splits or collapses of inner edges that are far apart:
/// those that are the longest or shortest and leave the best valences.
CountChanges approach_count(WorkingMesh& mesh, double wanted, const CountOptions& options);

}  // namespace hooke
