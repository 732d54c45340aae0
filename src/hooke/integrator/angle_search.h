// The worst angles last, where the springs are at rest: rounds that raise the minimum angle of the mesh, by
// angle springs around the worst faces and, where these are stuck, by pattern search on single vertices, as
// the minimum angle has no gradient there. Either alone ends one to two degrees lower.
#pragma once

#include <array>

#include "hooke/core/types.h"
#include "hooke/integrator/integration.h"

namespace hooke {

struct Relaxation;

/// Pattern search for the position of one vertex that maximises the smallest angle around it.
struct VertexSearchOptions {
  static constexpr int directions = 8;      // directions tested in the tangent plane
  double first_step = .3;                   // in target lengths; the step is halved when no direction helps
  static constexpr double last_step = .01;  // in target lengths; the search ends below it
  static constexpr double min_relative_gain = 1e-3;  // minimum relative gain of the cotangent for a move
};

/// Newton's method vertex by vertex on strings and angle springs, around the worst faces only.
struct SpringRoundOptions {
  double range = 3;  // degrees above the minimum angle, the threshold of the springs; 0: no such rounds
  static constexpr double weight = 1000;
  int rings = 2;       // around the corners of the worst faces within which vertices move
  int sweeps = 12;     // per round
  double rest = .003;  // in target lengths; a vertex that moves less skips the next sweep
  static constexpr double min_rise =
      .2;  // of the range, by which a round must raise the minimum angle for another to follow
};

struct AngleSearchOptions {
  SpringRoundOptions springs = {};
  VertexSearchOptions vertex = {};
  static constexpr double angle_range =
      1;  // degrees; faces whose angle exceeds the minimum by less are searched
  static constexpr int max_faces = 500;  // maximal number of these faces, worst first
  int rings = 1;                         // rings around their corners within which vertices move
  int sweeps = 3;                        // per round
  double edge_error_limit = 1.015;       // maximal standard deviation of l / L_e, relative to its start
  double sagitta = .3;  // limit of a second pass, over the target length; looser than the guards'
  int max_rounds = 40;  // of both passes
  static constexpr double min_rise = .02;  // degrees by which a pattern search must raise the minimum angle
  int max_set_aside = 3;                   // times that faces which cannot rise are set aside for the others
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
