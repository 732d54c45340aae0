// The account of an outer iteration.
#pragma once

#include "hooke/integrator/integrator.h"
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

}  // namespace hooke
