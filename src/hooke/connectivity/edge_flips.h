// Edge flips: whether a flip is allowed, and flips until the mesh is Delaunay.
// C. L. Lawson, "Software for C1 surface interpolation", 1977; on surfaces R. Dyer, H. Zhang and T. Moller,
// "Delaunay mesh construction", 2007.
#pragma once

#include <algorithm>

#include "hooke/core/types.h"

namespace hooke {

struct WorkingMesh;
class HalfedgeMesh;

/// Sum of the two angles opposite an inner edge, radians. The edge is Delaunay if it is at most pi.
double opposite_angles(const HalfedgeMesh& halfedges, const Mat3X& points, int half_edge);

/// The target valence of the corner from which the half-edge starts, 0 if it has none, and its present
/// valence: the edges of the wedge, feature edges included, or of the whole vertex if there is no target.
struct CornerValence {
  int target;
  int present;

  /// May a corner gain or lose an edge? It keeps a face, and gets no farther from its target than by `slack`.
  bool may_gain(int slack) const { return present < target + slack; }
  bool may_lose(int slack) const { return present > std::max(2, target - slack); }
};
CornerValence corner_valence(const WorkingMesh& mesh, int half_edge);

/// Does a flip of the edge keep topology and valences? Not if it is a feature edge; if the new edge exists
/// already; or if a vertex would have fewer than 3 edges (2 at a corner), or a corner valence move away from
/// its target, unless it still differs by no more than `corner_slack`.
bool flip_keeps_topology(const WorkingMesh& mesh, int half_edge, int corner_slack = 0);

/// May the edge be flipped: does that keep the topology, is no new face a sliver, and are the limits of the
/// local shape kept, or is the new shape no worse than that before?
bool may_flip(const WorkingMesh& mesh, int half_edge);

/// Flips edges whose opposite angles sum to more than pi + 1e-9, in the order of a queue, while that lowers
/// the sum and may_flip() allows it. Returns the number of flips.
int flip_to_delaunay(WorkingMesh& mesh);

}  // namespace hooke
