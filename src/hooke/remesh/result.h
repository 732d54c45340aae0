// What a run has done: its outer iterations, and what became of the mesh.
#pragma once

#include "hooke/connectivity/adaptation.h"
#include "hooke/connectivity/flip_mode.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/angle_springs.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/integrator/time_step.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/surface_point.h"

namespace hooke {

struct Workspace;

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
  double min_angle = 0;  // degrees
  double seconds = 0;    // since the start
};

/// The state of the work after `done`; all but the seconds.
IterationRecord iteration_record(const Workspace& work, const char* stage, const IntegrationResult& done);

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

struct RemeshResult {
  StopReason reason = StopReason::stalled;
  int restarts = 1;      // of which this is the best, see attempts.h ...
  int kept_run = 1;      // ... by its number
  int sliver_tries = 0;  // see sliver_trials.h
  std::vector<IterationRecord> iterations;
  Mat3X input_points;         // of the mesh as it was, to measure the result against
  MemoryOrder memory_order;   // of the mesh as it is now
  bool near_regular = false;  // in mode `fixed`: see keep_near_regular.h
  int folded_before = 0;
  std::vector<int> folded_faces;  // still folded away from the surface, ids of the result
  CreaseCounts creases;
  std::vector<Edge> crease_edges;            // ids of the result
  FlipResult flips;                          // in the modes `flip` and `adapt`
  AdaptResult adaptation;                    // in mode `adapt`
  std::vector<MapEntry> map;                 // per vertex of the result
  std::vector<unsigned char> vertex_limits;  // per vertex of the result, see limiting_factors.h
  int unprojected = 0;  // vertices that stay off the input's field, where landing would fold a face
  AngleSpringResult angle_springs;
  ProjectionCounts projection;
  long long limited_steps = 0;  // vertex steps shortened by the guards
  BoundCounts bound;            // time steps by the test that set them (paper_remesh only)
  FailedTests jam;              // what no time step passed, when jammed there
};

/// The ids that these faces of the work have in the result, ascending.
std::vector<int> faces_of_result(const Workspace& work, const std::vector<int>& faces);

}  // namespace hooke
