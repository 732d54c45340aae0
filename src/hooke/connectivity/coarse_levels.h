// How much coarser than asked for a mesh may first be made.
#pragma once

#include "hooke/working_mesh/adapting_mesh.h"

namespace hooke {

struct CoarseLimits {
  int levels = 1;           // times the target lengths are doubled, at most
  double least_faces = 80;  // of the coarsest mesh
  double sagitta = .07;     // greatest of an edge of the coarsest mesh over its length ...
  double bent_share = .01;  // ... but for this part of them
  double rim_share = .25;   // greatest part of the coarsest mesh's vertices that lie on curves or stand still
  // A mesh with no more irregular inner vertices and no more edges beyond these lengths, in parts of all, is
  // regular already: no coarser one comes first.
  double irregular_share = .1, misfit_share = .01;
  double shortest = .8, longest = 4. / 3;  // over the target lengths
};

/// How many times the target lengths can be doubled so that edges as long still follow the surface, judged by
/// how its normals turn along the edges there are; each stands for as many edges of the target length as
/// cover its square. None where there are creases: the narrow faces between them want the lengths that were
/// asked for. Pre-condition: the edges of the curves are counted.
int coarse_levels(const AdaptingMesh& mesh, double wanted_faces, const CoarseLimits& limits);

}  // namespace hooke
