// Strings and altitude springs [2]-[4] of faces, four at a time: the bulk of every relaxation.
#pragma once

#include "hooke/core/lanes.h"
#include "hooke/core/types.h"

namespace hooke {

/// Four faces, one in each lane. All but `flat` are columns of one entry a lane.
struct FaceSprings {
  static constexpr double least_length = 1e-9;  // of the face's target: a zero edge has a force, not a NaN

  // What is asked:
  double corners[9 * lane_count];      // x, y, z of each corner
  double edge_target[3 * lane_count];  // of the edge across from each corner
  double has_edge[3 * lane_count];     // 1 where that edge counts with this face, else 0
  double face_target[lane_count];
  double has_face[lane_count];  // 1; 0 in a lane without a face, which must hold the numbers of another

  // What is found:
  double energy;                    // of all four, the weights included
  double gradient[9 * lane_count];  // by each corner
  bool flat;                        // a face has no area to speak of: energy and gradient mean nothing
};

/// `string` and `altitude` weigh the terms U(l; L_e) / L_e^2 and U(h; h0) / h0^2, h0 = (sqrt 3 / 2) L_f.
void evaluate_face_springs(double string, double altitude, FaceSprings& faces);

}  // namespace hooke
