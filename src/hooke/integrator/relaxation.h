// What every integrator takes and returns: a relaxation moves the vertices of a mesh on its surface toward
// the rest lengths of their springs.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct Adjacency;
class Energy;
class Guards;
struct SurfacePositions;
class Retraction;
class Stopwatch;
struct VertexColoring;

enum class StopReason {
  converged,    // every edge within the tolerance of its target length
  stalled,      // at rest as far as the springs allow: the energy no longer falls
  step_limit,   // the allowed number of steps or evaluations is used up
  jammed,       // no step is accepted any more
  interrupted,  // the observer asked to stop
};

/// Where the work stands.
struct Progress {
  const char* stage =
      "";  // "untangle", "adapt", "flow", "springs", "flips", "relax", "polish", "mend", "paper"
  int outer = 0;
  int step = 0;
  double energy = 0;
};

/// Called after every step; returns false to stop the work with what has been reached.
using Observer = std::function<bool(const Progress&)>;

/// The parts that a relaxation works on. All are references to objects that outlive it.
struct Relaxation {
  const Adjacency& adjacency;
  const VertexColoring& coloring;
  const std::vector<double>& vertex_length;  // target length per vertex
  Energy& energy;
  Retraction& retraction;
  Guards& guards;
  SurfacePositions& positions;
  Stopwatch* stopwatch = nullptr;
};

struct IntegrationOptions {
  int max_steps = 2000;       // evaluations of the energy (lbfgs) or time steps (damped)
  double energy_drop = 2e-3;  // at rest when the energy falls by less than this part of itself ...
  int window = 3;             // ... over this many steps
  double max_move = 2;        // of a vertex in a step, in its target lengths
};

struct IntegrationResult {
  int steps = 0;
  int evaluations = 0;          // of the energy or the forces
  double energy = 0;            // at the end
  long long limited_steps = 0;  // vertex steps shortened by the guards
  StopReason reason = StopReason::stalled;
};

/// Shortens the displacement of every vertex to at most max_move of its target length.
void cap_displacement(const std::vector<double>& vertex_length, double max_move, Mat3X& displacement);

/// Tells when the energy has come to rest.
class RestDetector {
 public:
  explicit RestDetector(const IntegrationOptions& options) : options_(options) {}
  bool at_rest(double energy);

 private:
  IntegrationOptions options_;
  std::vector<double> history_;
};

}  // namespace hooke
