// What a mesh that is good already must not lose. Equal edges and great angles are two aims: a mesh whose
// angles are all good could pay for the one with the other.
#pragma once

#include "hooke/working_mesh/workspace.h"

namespace hooke {

struct HarmOptions {
  double angle = 35;       // degrees; a mesh is near-regular if no angle is below ...
  double deviation = .25;  // ... and the standard deviation of l / L_e is at most this part of its mean
  double reach = .19;      // of its target length, that a vertex of a near-regular mesh may travel
};

/// Keeps the least angle where all edges are to have one length or the mesh is near-regular, and the vertices
/// of a near-regular mesh within reach. Returns whether it is near-regular. Pre-condition: no vertex has
/// moved.
bool do_no_harm(Workspace& work, const HarmOptions& options);

}  // namespace hooke
