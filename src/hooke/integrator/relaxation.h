// Inputs and results common to all integrators. A relaxation moves the vertices of a mesh on its surface
// toward the rest lengths of their springs.
#pragma once

#include "hooke/integrator/guards.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/ring_energy.h"

namespace hooke {

struct VertexColoring;
struct VertexTable;
struct Workspace;

enum class StopReason {
  converged,    // every edge within the tolerance of its target length
  stalled,      // at rest: the energy no longer falls
  step_limit,   // the allowed number of steps or evaluations is used up
  jammed,       // no step is accepted any more, or none that gets anywhere
  interrupted,  // the observer asked to stop
};

/// Progress of the optimization as reported to the observer. The stage is one of "untangle", "adapt", "flow",
/// "springs", "flips", "relax", "polish", "mend" and "paper".
struct Progress {
  const char* stage = "";
  int outer = 0;
  int step = 0;
  double energy = 0;
};

/// Called after every step; returns false to stop and keep what has been reached.
using Observer = std::function<bool(const Progress&)>;

/// A mesh with all that a relaxation works on, for its present faces. The arguments must outlive it.
struct Relaxation {
  Relaxation(const Adjacency& adjacency, const VertexColoring& coloring, const TargetLengths& targets,
             VertexTable& vertices, Retraction& retraction, const EnergyTerms& terms,
             const ShapeLimits& limits, Stopwatch* stopwatch = nullptr);

  /// Of the mesh of a workspace.
  Relaxation(Workspace& work, const EnergyTerms& terms, const ShapeLimits& limits);

  const Adjacency& adjacency;
  const VertexColoring& coloring;
  const std::vector<double>& vertex_length;  // target length per vertex
  Energy energy;
  RingTerms terms;  // of what works vertex by vertex; differs from the energy within a TermsScope
  Retraction& retraction;
  Guards guards;
  SurfacePositions& positions;
  Stopwatch* stopwatch;

  /// At the present positions.
  double present_energy();
};

/// Puts the terms of a relaxation back at the end of the scope.
class TermsScope {
 public:
  explicit TermsScope(Relaxation& relaxation) : terms_(relaxation.terms), kept_(relaxation.terms) {}
  ~TermsScope() { terms_ = kept_; }
  TermsScope(const TermsScope&) = delete;
  TermsScope& operator=(const TermsScope&) = delete;

 private:
  RingTerms& terms_;
  const RingTerms kept_;
};

struct IntegrationOptions {
  int max_steps = 2000;       // evaluations of the energy (lbfgs) or time steps (damped)
  double energy_drop = 2e-3;  // relative fall of the energy over the window, below which it is at rest
  int window = 3;             // steps
  double max_move = 2;        // of a vertex in one step, in its target lengths
};

struct IntegrationResult {
  int steps = 0;
  int evaluations = 0;          // of the energy or the forces
  double energy = 0;            // at the end
  long long limited_steps = 0;  // vertex displacements shortened by the guards
  StopReason reason = StopReason::stalled;
};

/// Shortens the displacement of every vertex to at most max_move of its target length.
void cap_displacement(const std::vector<double>& vertex_length, double max_move, Mat3X& displacement);

/// Detects when the energy has come to rest. at_rest() is called once per step with the current energy.
class RestDetector {
 public:
  explicit RestDetector(const IntegrationOptions& options) : options_(options) {}
  bool at_rest(double energy);

 private:
  IntegrationOptions options_;
  std::vector<double> history_;
};

}  // namespace hooke
