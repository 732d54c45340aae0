// Pattern search for the place of one vertex where the least angle about it is greatest.
#pragma once

#include <array>

#include "hooke/integrator/relaxation.h"

namespace hooke {

struct VertexSearchOptions {
  int directions = 8;      // that a vertex looks into
  double first_step = .3;  // target lengths, halved ...
  double last_step = .01;  // ... down to this
  double min_gain = 1e-3;  // of the cotangent; less is not worth a move
};

// The worst corners, last: where springs have settled against a guard or against each other, a vertex may
// still find a better place by trying. Maximises the least angle itself, which has no gradient where it
// matters.

struct AngleSearchOptions {
  VertexSearchOptions vertex = {};
  double above_least = 1;           // degrees; faces up to so much above the least angle are worked on
  int max_faces = 500;              // the worst of them
  int rings = 1;                    // about their corners, within which vertices move
  int sweeps = 3;                   // over these in a round
  double edge_error_limit = 1.005;  // of the standard deviation of l / L_e at its start
  double sagitta = .3;              // over the target length, as guards have one: worth a better least angle
  int max_rounds = 40;              // of both; each must raise the least angle by ...
  double min_rise = .02;            // ... this many degrees
};

struct AngleSearchResult {
  int rounds = 0;
  int moves = 0;
  std::vector<int> vertices;  // that may have moved, ascending
};

/// Raises the least angle of all as far as edges may pay for it. No face about a vertex that moves has a
/// smaller angle than the least of them had before; all moves obey the guards, but for a looser limit of
/// sagittas once nothing else helps. After one look at all faces and edges only those about the vertices that
/// may move are looked at again.
AngleSearchResult search_angles(Relaxation& relaxation, const AngleSearchOptions& options);

}  // namespace hooke
