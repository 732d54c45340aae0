// Edge flips: when one is allowed, and flips until the mesh is Delaunay.
// C. L. Lawson, "Software for C1 surface interpolation", 1977; on surfaces R. Dyer, H. Zhang and T. Moller,
// "Delaunay mesh construction", 2007.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct FlippableMesh;
class HalfedgeMesh;

struct FlipGuardOptions {
  double area_share = .02;  // least part of the pair's area that each new face has
  double alignment = .3;    // least cosine between a new face and the surface, unless an old one had less
  double fold = .1;         // least cosine between a new face and its neighbours, unless the old had less
  double sagitta = .2;  // greatest sagitta of the new edge over its target length, unless the old had more
};

/// Sum of the two angles across an inner edge, radians; Delaunay up to pi.
double opposite_angles(const HalfedgeMesh& halfedges, const Mat3X& points, int half_edge);

/// The edges that the corner wants at which h leaves, and those it has: between the creases about h's face,
/// or in all where it wants none (0).
struct CornerValence {
  int wanted;
  int has;
};
CornerValence corner_valence(const FlippableMesh& mesh, int half_edge);

/// May the edge be flipped? It may not on the boundary or on a crease; where the new edge exists already;
/// where a vertex comes to have fewer than 3 edges (2 at a corner) or a corner moves away from the valence it
/// wants; where a new face is a sliver, lies against the surface or its neighbours, or the new edge cuts deep
/// into it (see the options).
bool may_flip(const FlippableMesh& mesh, int half_edge, const FlipGuardOptions& options);

/// Flips edges whose opposite angles exceed pi by more than 1e-9, first come first served, as long as that
/// lowers the sum of the angles and the guard allows it. Returns the number of flips.
int flip_to_delaunay(FlippableMesh& mesh, const FlipGuardOptions& options);

}  // namespace hooke
