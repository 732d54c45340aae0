// How good the faces of a small mesh are, and what in it is beyond the limits of the guards.
#pragma once

#include "hooke/filter/retraction.h"
#include "hooke/springs/sizing.h"

namespace hooke {

struct PatchLimits {
  double fair_angle;  // degrees; a face with a smaller one costs the square of what it lacks
  double alignment;   // least cosine between a face and the surface
  double fold;        // least cosine between two neighbouring faces
  double sagitta;     // greatest of an edge, over its target length
  double longest;     // edge over its target length
};

/// What lies beyond the limits.
struct PatchExcess {
  double alignment = 0, fold = 0, sagitta = 0;  // sums over faces and edges
  double length = 0;                            // of the longest edge
  int folds = 0;                                // faces and edges
};

bool is_no_worse(const PatchExcess& now, const PatchExcess& before);

struct PatchLook {
  double angle_cost = 0;     // degrees squared
  double length_errors = 0;  // sum of the squares of l / L_e - 1
  std::size_t edges = 0;
  double cotangent = 0;  // of the least angle
  double area = 0;       // of the surface that it covers: of faces as seen along the surface's normals
  PatchExcess excess;
};

/// Pre-condition: a connectivity without creases.
PatchLook look_at(const Placement& placement, const Connectivity& connectivity, const TargetLengths& targets,
                  const PatchLimits& limits);

}  // namespace hooke
