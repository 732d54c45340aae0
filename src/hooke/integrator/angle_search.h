// The worst angles last, where the springs are at rest: rounds that raise the minimum angle of the mesh, by
// angle springs around the worst faces and, where these are stuck, by pattern search on single vertices, as
// the minimum angle has no gradient there. Either alone ends one to two degrees lower.
#pragma once

#include <array>

#include "hooke/core/types.h"
#include "hooke/integrator/integration.h"

namespace hooke {

struct Relaxation;

struct AngleSearchOptions {
  double spring_range = 3;  // degrees above the minimum angle, the threshold of the springs; 0: no springs
  double edge_error_limit = 1.015;  // maximal standard deviation of l / L_e, relative to its start
  double sagitta = .3;              // limit of a second pass, over the target length; looser than the guards'
  int max_rounds = 40;              // of both passes
  int max_set_aside = 3;            // times that faces which cannot rise are set aside for the others
};

struct AngleSearchResult {
  int rounds = 0;
  int moves = 0;              // accepted moves
  std::vector<int> vertices;  // vertices that may have moved, ascending
};

/// Raises the minimum angle of the mesh while the edge lengths stay within `edge_error_limit`. All moves obey
/// the guards; a second pass of pattern searches allows larger sagittas once the first one has ended. All
/// faces and edges are measured once, afterwards only those around vertices that may have moved.
AngleSearchResult search_angles(Relaxation& relaxation, const AngleSearchOptions& options);

}  // namespace hooke
