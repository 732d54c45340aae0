// The result of a run: a record of each outer iteration, counts, and the relation of the result to the input.
#pragma once

#include <memory>

#include "hooke/connectivity/connectivity_mode.h"
#include "hooke/filter/filter.h"
#include "hooke/integrator/integration.h"
#include "hooke/integrator/time_step.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/surface_point.h"

namespace hooke {

struct ResultMeasures;
struct Workspace;

/// One outer iteration. If angle optimisation continues on the same field, the figures are those before the
/// final projection.
struct IterationRecord {
  const char* stage = "";
  int outer = 0;  // number of the outer iteration, from 1; 0 for other stages
  int steps = 0;
  int evaluations = 0;  // of the energy
  long long field_evaluations = 0;
  double energy = 0;
  double max_length_error = 0;  // max |l - L_e| / L_e
  double rms_length_error = 0;
  double min_angle = 0;  // degrees
  double seconds = 0;    // since the start of the run
};

/// The record of the workspace after `done`, except `outer` and `seconds`.
IterationRecord iteration_record(const Workspace& work, const char* stage, const IntegrationResult& done);

/// Counts of the detected creases. Mode `adapt` replaces crease edges: then the edges are those of the
/// result.
struct CreaseCounts {
  int curves = 0;  // from corner to corner, or closed
  int edges = 0;
  int corners = 0;         // fixed vertices where curves end
  int curve_vertices = 0;  // all other vertices on creases: they slide along, or stay at bends
  int charts = 1;          // smooth pieces between creases
  int sharp = 0;           // edges of the input sharper than the feature angle
  int dropped = 0;         // those of them that were taken for noise
};

/// The counts for the creases of a result. `order`: from its ids to the adjacency; `vertex_limits`: by these
/// ids, see limiting_factors.h.
CreaseCounts count_creases(const Adjacency& adjacency, const Permutation& order,
                           const std::vector<unsigned char>& vertex_limits);

/// How a result came to keep what it must keep of the input, where the first run did not; of several ways the
/// last one here is told.
enum class Rescue {
  none,
  tips,        // the vertices that were lost stand still
  junctions,   // the vertices of junctions stand still
  closest,     // vertices were projected to the faces of the input
  put_back,    // vertices were put back to where they were, or held there
  kept_faces,  // faces of the input stay, in the modes `flip` and `adapt`
};

/// What became of the steps of a binary mask of which the input is made, see preserving_remesh().
enum class MaskSteps {
  none,      // it is not
  resolved,  // they are kept as edges, as the target lengths resolve them
  smoothed,
};

struct RemeshResult {
  StopReason reason = StopReason::stalled;
  std::vector<IterationRecord> iterations;
  Mat3X input_points;        // of the input mesh, as reference for measures
  MemoryOrder memory_order;  // of the resulting mesh
  MaskSteps steps = MaskSteps::none;
  bool near_regular = false;  // in mode `fixed`, see keep_near_regular()
  int folded_before = 0;
  CreaseCounts creases;
  std::vector<Edge> crease_edges;            // ids of the result
  std::vector<Edge> input_creases;           // ids of the input
  FlipResult flips;                          // in the modes `flip` and `adapt`
  AdaptResult adaptation;                    // in mode `adapt`
  std::vector<MapEntry> map;                 // per vertex of the result
  std::vector<unsigned char> vertex_limits;  // per vertex of the result, see limiting_factors.h
  /// Number of vertices left off the field of the input, because their projection would fold a face.
  int unprojected = 0;
  ProjectionCounts projection;
  long long limited_steps = 0;  // vertex steps shortened by the guards
  /// Of preserving_remesh(), null if not measured; copies of the result share them.
  std::shared_ptr<ResultMeasures> measures;
  Rescue rescue = Rescue::none;
  /// How far the first attempt was from the input, if that alone broke a promise and vertices were put back
  /// or faces kept; in the unit of the points.
  double refused_distance = 0;
  /// Bends by more than 60 degrees within an edge where the input bends by less than 40 or half, see
  /// unresolved_bends().
  int sharp_bends = 0;
  double sharpest_bend = 0;            // degrees
  Vec3 sharpest_place = Vec3::Zero();  // its middle
  /// Places on walls or gaps of the input that the result is away from by more than a quarter of their
  /// thickness, see left_walls(), and the worst one.
  int left_walls = 0;
  double thickness = 0, lost_thickness = 0;  // there, in the unit of the points
  Vec3 thin_place = Vec3::Zero();
  int rescued_shells = 0;  // that were remeshed by themselves and for which that holds; 0: for the whole
  /// Vertices at which preserving_remesh() took less than .8 of the target length asked for, so that the
  /// surface is kept.
  int shortened = 0;
  /// Did preserving_remesh() take the lengths that the input has for target lengths?
  bool has_lengths_of_input = false;
  BoundCounts bound;  // time steps by the test that set them (paper_remesh() only)
  FailedTests jam;    // the tests that no time step passed, if jammed (paper_remesh() only)
  std::vector<TimeStepRecord> time_steps;  // paper_remesh() only
};

}  // namespace hooke
