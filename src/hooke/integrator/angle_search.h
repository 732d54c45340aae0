// Pattern search on single vertices that raises the minimum angle of the mesh directly. It runs last, where
// the springs are at rest, because the minimum angle has no gradient where it matters.
#pragma once

#include <array>

#include "hooke/integrator/relaxation.h"

namespace hooke {

/// Pattern search for the position of one vertex that maximises the smallest angle around it.
struct VertexSearchOptions {
  int directions = 8;               // directions tested in the tangent plane
  double first_step = .3;           // in target lengths; the step is halved when no direction helps
  double last_step = .01;           // in target lengths; the search ends below it
  double min_relative_gain = 1e-3;  // minimum relative gain of the cotangent for a move
};

struct AngleSearchOptions {
  VertexSearchOptions vertex = {};
  double angle_range = 1;           // degrees; faces whose angle exceeds the minimum by less are treated
  int max_faces = 500;              // maximal number of these faces, worst first
  int rings = 1;                    // rings around their corners within which vertices move
  int sweeps = 3;                   // per round
  double edge_error_limit = 1.005;  // maximal standard deviation of l / L_e, relative to its start
  double sagitta = .3;              // limit of a second pass, over the target length; looser than the guards'
  int max_rounds = 40;              // of both passes
  double min_rise = .02;            // degrees by which each round must raise the minimum angle
};

struct AngleSearchResult {
  int rounds = 0;
  int moves = 0;              // accepted moves
  std::vector<int> vertices;  // vertices that may have moved, ascending
};

/// Raises the minimum angle of the mesh while the edge lengths stay within `edge_error_limit`. Each move
/// raises the smallest angle around the moved vertex. All moves obey the guards; a second pass allows larger
/// sagittas once the first one has ended. All faces and edges are measured once, afterwards only those around
/// vertices that may have moved.
AngleSearchResult search_angles(Relaxation& relaxation, const AngleSearchOptions& options);

}  // namespace hooke
