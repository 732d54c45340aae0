// Edge flips: whether a flip is allowed, and flips until the mesh is Delaunay.
// C. L. Lawson, "Software for C1 surface interpolation", 1977; on surfaces R. Dyer, H. Zhang and T. Moller,
// "Delaunay mesh construction", 2007.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct WorkingMesh;
class HalfedgeMesh;

struct FlipGuardOptions {
  double area_share = .02;  // minimum share of the area of the two faces in each new face
  // Limits that also admit the value before the flip:
  double alignment = .3;  // minimum cosine between a new face and the surface
  double fold = .1;       // minimum cosine between a new face and its neighbours
  double sagitta = .2;    // maximum sagitta of the new edge over its target length
};

/// Sum of the two angles opposite an inner edge, radians. The edge is Delaunay if it is at most pi.
double opposite_angles(const HalfedgeMesh& halfedges, const Mat3X& points, int half_edge);

/// The target valence of the corner from which the half-edge starts, 0 if it has none, and its present
/// valence: the edges of the wedge, feature edges included, or of the whole vertex if there is no target.
struct CornerValence {
  int target;
  int present;
};
CornerValence corner_valence(const WorkingMesh& mesh, int half_edge);

/// May the edge be flipped? Not if it is a feature edge; if the new edge exists already; if a vertex would
/// have fewer than 3 edges (2 at a corner), or a corner valence move away from its target; or if a new face
/// would be a sliver or folded, or the new edge too far from the surface (see the options).
bool may_flip(const WorkingMesh& mesh, int half_edge, const FlipGuardOptions& options);

/// Flips edges whose opposite angles sum to more than pi + 1e-9, in the order of a queue, while that lowers
/// the sum and may_flip() allows it. Returns the number of flips.
int flip_to_delaunay(WorkingMesh& mesh, const FlipGuardOptions& options);

}  // namespace hooke
