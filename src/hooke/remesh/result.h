// The account of an outer iteration.
#pragma once

#include "hooke/integrator/relaxation.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {

/// One outer iteration. Where the polish goes on from there on the same field, vertices have not landed yet.
struct IterationRecord {
  const char* stage = "";
  int outer = 0;  // outer iteration, from 1; 0 before and after all of them
  int steps = 0;
  int evaluations = 0;  // of the energy
  long long field_evaluations = 0;
  double energy = 0;
  double max_length_error = 0;  // max |l - L_e| / L_e
  double rms_length_error = 0;
  double least_angle = 0;  // degrees
  double seconds = 0;      // since the start
};

/// The state of the work after `done`; all but the seconds.
IterationRecord iteration_record(const Workspace& work, const char* stage, const IntegrationResult& done);

// What has become of the creases.

/// What was found of creases, and what of it is left. Mode `adapt` gives creases other edges: then the edges
/// are those of the result.
struct CreaseCounts {
  int curves = 0;  // from corner to corner, or closed
  int edges = 0;
  int kept = 0;            // of them, still there
  int corners = 0;         // vertices where curves end; they stand still
  int curve_vertices = 0;  // between them: they slide along the crease, or stay at its bends
  int charts = 1;          // smooth pieces between creases
};

/// Of the creases of the work.
CreaseCounts count_creases(const Workspace& work);

/// The ids that these faces of the work have in the result, ascending.
std::vector<int> faces_of_result(const Workspace& work, const std::vector<int>& faces);

}  // namespace hooke
