// Attempts to remesh an input so that the result keeps it: each is a run of remesh(), measured and judged.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "hooke/measure/measured_surface.h"
#include "hooke/mesh/mirror.h"
#include "hooke/remesh/preserving_remesh.h"
#include "hooke/springs/placed_lengths.h"

namespace hooke {

struct PartOfMesh;
class Run;

/// Target lengths to make an attempt with.
struct AskedLengths {
  std::vector<double> of_vertices;    // of the input in memory order
  std::vector<PlacedLength> shorter;  // than between these
};

/// The result of an attempt, with its judgement.
struct Attempt {
  TriMesh mesh;
  RemeshResult result;        // without measures until it is judged, and where a vertex is not finite
  double angle = 0;           // minimum angle, degrees
  double unmended_angle = 0;  // at the first judgement, before vertices are moved to the input
  double least_angle = 0;  // that it must keep: AttemptMaker::least_angle(), or what unfolding has left of it
  bool lost_angle = false;  // is it less?
  double made_faces = 0;    // of its faces, those that were made anew for it, about
  AskedLengths lengths;     // that it was made with
  /// That it is from, and can be gone on from: in mode `adapt` with a maximum distance. Copies share it.
  std::shared_ptr<Run> run;
  int result_of_run = 0;  // its number among the results of the run

  bool is_interrupted() const { return result.reason == StopReason::interrupted; }

  const Preservation& preservation() const { return result.measures->preservation; }

  std::size_t flaws() const { return result.measures ? preservation().flaws() : std::size_t(-1); }

  /// Faces that lie against the surface where others lie like them, as a chord across a sharp rounding: no
  /// broken promise, but better avoided. None if there are so many that the input is rough.
  std::size_t chords() const;

  /// Does nothing break a promise?
  bool keeps_promises() const { return flaws() == 0 && !lost_angle; }

  /// The same, and have angles not become small for it?
  bool is_good() const;

  /// Has it fewer flaws or, with as many, a larger minimum angle?
  bool is_better_than(const Attempt& other) const;
};

/// Makes attempts from one input. Keeps references to the mesh, its memory order and the observer. Where
/// nothing else is said, ids are those of vertices of the input in memory order.
class AttemptMaker {
 public:
  /// `smooths_steps`: do attempts start from smoothed points if the input is the surface of a binary mask?
  AttemptMaker(const TriMesh& mesh, const MemoryOrder& memory_order, const RemeshOptions& options,
               const PreservationOptions& preservation, const KnownInput& known, const Observer& observer,
               Stopwatch* stopwatch, bool smooths_steps);

  RemeshOptions options;  // of the attempts to come; adapt them between these
  AskedLengths lengths;   // likewise

  /// Lets all attempts be judged by the sizes of this one.
  void judge_by_scale_of(const Attempt& attempt);

  /// Makes attempts for a part of the input, which must outlive it, with its memory order, as does this. They
  /// are to mend the part in this attempt for the whole.
  AttemptMaker for_part(const PartOfMesh& part, const MemoryOrder& part_order, const Attempt& whole) const;

  bool adapts() const { return options.connectivity == ConnectivityMode::adapt; }

  const TriMesh& mesh() const { return mesh_; }
  const MeasuredSurface& input() const { return input_; }
  /// The points, rounded if those of results are.
  Mat3X as_written(const Eigen::Ref<const Mat3X>& points) const;
  const Quality& input_quality() const { return input_quality_; }
  /// The minimum angle that faces must keep, degrees: that of the input, in mode `flip` up to a thousandth
  /// and 25 at most; 0 in mode `adapt`, and where a sizing asks for other lengths.
  double least_angle() const;
  /// Are the facets of the input meant?
  bool has_facets() const { return preservation_.faceted; }
  /// Is the same length asked for all edges of each part of the mesh?
  bool has_even_lengths() const { return has_even_lengths_; }
  /// Do attempts start from smoothed points?
  bool smooths_mask() const { return is_mask_; }
  /// The id that the caller knows the vertex by.
  int id_of(int vertex) const { return memory_order_.order.old_vertex[vertex]; }
  /// The shell of the input that a vertex of the result, in memory order, is on; -1 if there is one shell
  /// only.
  int shell_of_vertex(int vertex, const Attempt& attempt) const;
  /// The point of the input, of the shell that the vertex of the result is on, that is closest to x.
  ClosestPoint closest_on_input(int vertex, const Vec3& x, const Attempt& attempt) const;
  /// The vertices with all copies of those at junctions.
  std::vector<int> with_copies(const std::vector<int>& vertices) const;

  /// Has the attempt worse faces on average than the input, by more than the margin of their shape? Where
  /// clearly more of them are slivers there is no margin. Of known polygons these tell.
  bool has_worse_faces(const Attempt& attempt, double margin = 0) const;

  /// Those of the input, with its known polygons or its triangles.
  std::vector<Mirror> mirrors() const;

  /// Have the known polygons worse angles on the whole than in the input?
  bool has_worse_polygons(const Attempt& attempt) const;

  /// Does it keep its promises, and its polygons?
  bool keeps_all(const Attempt& attempt) const {
    return attempt.keeps_promises() && !has_worse_polygons(attempt);
  }

  /// The vertices of the known polygons whose own angles are worse by more than the margin, degrees.
  std::vector<int> vertices_of_worse_polygons(const Attempt& attempt, double margin) const;

  /// One run, not judged yet.
  Attempt run() const;

  /// Is a maximum distance asked for?
  bool has_tolerance() const;

  /// Goes on from this attempt with the present lengths: only what is near those that have become shorter is
  /// made anew. It is not judged yet. None if its run is not at hand or has gone on already, where
  /// Run::go_on() does not, and of a mask.
  std::optional<Attempt> go_on(const Attempt& last) const;

  /// Measures the result and compares it with the input.
  void judge(Attempt& attempt) const;

  /// How many flaws a judged result would have with this maximum distance.
  std::size_t flaws_within(double max_distance, const Attempt& attempt) const;

  /// The creases of the input that the attempt found, as vertices of its adjacency.
  std::vector<Edge> input_creases(const Attempt& attempt) const;

  /// The surface of the result, which must outlive it.
  MeasuredSurface surface_of(const Attempt& attempt) const;

  /// Does the observer ask to stop?
  bool is_stopped() const { return observer_ && !observer_({.stage = "mend"}); }

  /// Moves a vertex of the result, by its index in memory order, to the point, rounded as the results are,
  /// and finds it on the input again.
  void place(int vertex, const Vec3& point, Attempt& attempt) const;

 private:
  bool is_marched_mask_at_any_length() const;
  void smooth_steps();
  void allow_for_rounding();

  const TriMesh& mesh_;
  const MemoryOrder& memory_order_;
  const Observer& observer_;
  Stopwatch* stopwatch_;
  MeasuredSurface input_;
  PreservationOptions preservation_;
  const Quality input_quality_;
  bool has_even_lengths_ = true;
  double least_angle_ = 0;
  double least_mean_shape_ = 0;  // of the faces of the input
  const IntLists* polygons_;
  double polygon_deviation_ = 0;    // of the input, degrees
  bool is_mask_ = false;            // of a binary mask whose steps are smoothed
  bool resolves_steps_ = false;     // of one whose steps the lengths resolve
  Mat3X smoothed_;                  // of a mask: the points that attempts start from, by the caller's id
  int steps_ = 0;                   // sharp edges of a mask
  double share_of_whole_ = 1;       // of the faces, where the input is a part
  std::vector<int> shell_of_face_;  // of the input, by the caller's id; empty if there is one
};

}  // namespace hooke
