// The mesh as the optimizer works on it: normalised, in memory order, with its constraints and its surface.
#pragma once

#include <memory>

#include "hooke/constraints.h"
#include "hooke/guards.h"
#include "hooke/mesh.h"
#include "hooke/ordering.h"
#include "hooke/sizing.h"
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
            const RetractionOptions& retraction, const GuardOptions& guards);

  /// Fits a new field to the vertices as they lie now and makes it the one that moves are projected to.
  /// [11]-[14]
  void refit();

  /// Projects the vertices to the field of the input, which is what they are to lie on in the end. A vertex
  /// whose landing would break a guard stays where it is; returns their number.
  int land();

  /// Gives the work other faces on the same vertices, whose ids go on to count as those of the input's faces.
  /// The vertices must still be on the field of the input: before the first refit().
  void replace_faces(std::vector<Triangle> faces);

  /// Writes the faces, where they were replaced, and the points of all vertices that moved back to the mesh
  /// it was made from.
  void copy_back(TriMesh& target) const;

  ProjectionCounts projection_counts() const;

  /// Smooth pieces of the surface: the components of the mesh cut open at its creases.
  int chart_count() const;

  Normalisation normalisation;
  Reordered order;
  std::shared_ptr<const Connectivity> connectivity;  // with its creases
  SweepPlan sweeps;
  std::vector<double> vertex_length;  // target lengths, normalised
  TargetLengths targets;
  Constraints constraints;
  TriMesh mesh;                            // normalised, in memory order; carries velocity and force
  Mat3X start;                             // its points at the start
  Placement placement;                     // of the vertices on the field fitted last
  std::unique_ptr<Retraction> retraction;  // to that field

 private:
  void connect(Connectivity c, const std::vector<Edge>& creases);
  SurfaceField fit(const Mat3X& points) const;

  FilterOptions filter_;
  GuardOptions guard_options_;
  RetractionOptions retraction_options_;
  bool faces_replaced_ = false;
  bool refitted_ = false;                 // until then both fields are the same
  std::vector<int> input_anchors_;        // where each vertex is tracked on the input
  std::unique_ptr<Retraction> to_input_;  // to the field of the input
  ProjectionCounts finished_;             // of the retractions that are gone
};

}  // namespace hooke
