// The mesh as the optimizer works on it: normalised, in memory order, with its constraints and its surface.
#pragma once

#include <memory>

#include "hooke/constraints.h"
#include "hooke/guards.h"
#include "hooke/length_field.h"
#include "hooke/mesh.h"
#include "hooke/ordering.h"
#include "hooke/sizing.h"
#include "hooke/stopwatch.h"
#include "hooke/surface_field.h"
#include "hooke/sweep_plan.h"

namespace hooke {

/// x = centre + unit * x'. The unit is the mean target length and the centre that of the bounding box, so
/// that a mesh scaled by a power of two has the same normalised coordinates to the last bit.
struct Normalisation {
  Vec3 centre = Vec3::Zero();
  double unit = 1;
};

struct Workspace {
  /// Takes the target lengths from v:target_length.
  Workspace(const TriMesh& mesh, const ConstraintOptions& constraints, const FilterOptions& filter,
            const RetractionOptions& retraction, const GuardOptions& guards, Stopwatch* stopwatch = nullptr);

  /// Fits a new field to the vertices as they lie now and makes it the one that moves are projected to.
  /// [11]-[14]
  void refit();

  /// Projects the vertices to the field of the input, which is what they are to lie on in the end. A vertex
  /// whose landing would break a guard stays where it is; returns their number.
  int land();

  /// Gives the work other faces on the same vertices, whose ids go on to count as those of the input's faces.
  /// The vertices must still be on the field of the input: before the first refit().
  void replace_faces(std::vector<Triangle> faces);

  /// Gives the vertices the target lengths of the places they have come to. Does nothing where these are the
  /// same everywhere. The targets change in place.
  void resample_lengths();

  /// Writes the faces, where they were replaced, the points of all vertices that moved, and v:target_length,
  /// where it was resampled, back to the mesh it was made from.
  void copy_back(TriMesh& target) const;

  ProjectionCounts projection_counts() const;

  Stopwatch* stopwatch;
  Normalisation normalisation;
  Reordered order;
  std::shared_ptr<const Connectivity> connectivity;
  SweepPlan sweeps;
  std::vector<double> vertex_length;  // target lengths, normalised, at the vertices' places when last sampled
  TargetLengths targets;
  Constraints constraints;
  TriMesh mesh;                            // normalised, in memory order; carries velocity and force
  Mat3X start;                             // its points at the start
  Placement placement;                     // of the vertices on the field fitted last
  std::unique_ptr<Retraction> retraction;  // to that field

 private:
  FilterOptions filter_;
  GuardOptions guard_options_;
  RetractionOptions retraction_options_;
  LengthField lengths_;              // on the input
  std::vector<int> length_anchors_;  // where each vertex is tracked on it
  bool faces_replaced_ = false;
  bool lengths_resampled_ = false;
  bool refitted_ = false;                 // until then both fields are the same
  std::vector<int> input_anchors_;        // where each vertex is tracked on the input
  std::unique_ptr<Retraction> to_input_;  // to the field of the input
  ProjectionCounts finished_;             // of the retractions that are gone
};

}  // namespace hooke
