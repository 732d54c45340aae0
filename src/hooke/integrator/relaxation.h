// What a relaxation works on: it moves the vertices of a mesh on its surface toward the rest lengths of their
// springs.
#pragma once

#include "hooke/integrator/guards.h"
#include "hooke/integrator/integration.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/ring_energy.h"

namespace hooke {

struct VertexColoring;
struct VertexTable;
struct Workspace;

/// A mesh with all that a relaxation works on, for its present faces and field. All arguments but the terms
/// and the limits must outlive it.
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
