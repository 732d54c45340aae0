// The mesh as the optimizer works on it: normalised, in memory order, with its constraints and its surface.
#pragma once

#include <memory>
#include <optional>

#include "hooke/constraints/constraints.h"
#include "hooke/core/stopwatch.h"
#include "hooke/filter/retraction.h"
#include "hooke/filter/surface_field.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {

/// x = centre + unit * x'. The unit is the mean target length and the centre that of the bounding box, so
/// that a mesh scaled by a power of two has the same normalised coordinates to the last bit.
struct Normalisation {
  Vec3 centre = Vec3::Zero();
  double unit = 1;
};

struct Workspace {
  /// Takes the target lengths from v:target_length. The layout is that of the mesh.
  Workspace(const TriMesh& mesh, MemoryOrder memory_order, const ConstraintOptions& constraints,
            const FilterOptions& filter, const RetractionOptions& retraction, Stopwatch* stopwatch = nullptr);

  /// Fits a new field to the vertices as they lie now and makes it the one that moves are projected to.
  /// [11]-[14]
  void refit();

  /// Where the vertices come to lie on the field of the input, which is what they are to lie on in the end.
  /// From there on they are tracked on it.
  SurfacePositions project_to_input();

  /// Where on the input the vertices are tracked from now on, per side.
  void track_on_input(std::vector<int> hints) { input_hints_ = std::move(hints); }

  /// To the field of the input.
  Retraction& to_input() { return *to_input_; }

  /// Is the field fitted last another one than that of the input?
  bool refitted() const { return refitted_; }

  /// Takes back refit(): the vertices, which have landed, are tracked on the field of the input again.
  void return_to_input();

  /// Gives the work other faces on the same vertices, whose ids go on to count as those of the input's faces.
  /// The vertices must still be on the field of the input: before the first refit(), or after
  /// return_to_input().
  void replace_faces(std::vector<Triangle> faces);

  /// Gives the work other vertices and faces. The caller has changed what the work holds per vertex and side
  /// in public members, `faces` join the vertices as they stand there, `sides` are those of their corners,
  /// and `origins` tells for each vertex which one it was before: -1 for a new one. All are put into memory
  /// order; in the result the vertices that were there keep their order, and new ones follow. Pre-condition
  /// as for replace_faces().
  void replace_mesh(std::vector<Triangle> faces, const std::vector<Triangle>& wedges,
                    const std::vector<int>& origins);

  /// Do target lengths vary?
  bool graded() const;

  /// Target lengths of the input at the places of the vertices, linear in its faces.
  std::vector<double> input_lengths() const;

  /// Gives the vertices the target lengths of the places they have come to, where these vary. The targets
  /// change in place.
  void resample_lengths();

  /// Writes the points of all vertices that moved back to the mesh it was made from, and v:target_length
  /// where it varies; where they were replaced, the faces, or a new mesh. Returns the points that the mesh
  /// had.
  Mat3X copy_back(TriMesh& target) const;

  /// That of the result.
  MemoryOrder memory_order() const;

  /// The id that a vertex of the work had in the mesh the work was made from; -1 for a new one.
  int vertex_of_input(int vertex) const;

  /// Where the vertices of the result, in their order there, lie on the mesh the work was made from.
  std::vector<MapEntry> map() const;

  ProjectionCounts projection_counts() const;

  /// Smooth pieces of the surface: the components of the mesh cut open at its creases.
  int chart_count() const;

  Stopwatch* stopwatch;
  Normalisation normalisation;
  Permutation order;  // ids in the result, those of the input while its vertices stay; without its faces
  std::shared_ptr<const Adjacency> adjacency;  // with its creases
  VertexColoring coloring;
  std::vector<double> vertex_length;  // target lengths, normalised, at the vertices' places when last sampled
  TargetLengths targets;
  Constraints constraints;
  std::shared_ptr<const Mat3X> start;      // the points of the input
  std::vector<int> origins;                // per vertex: which of `start` it was, -1 for a new one
  SurfacePositions positions;              // of the vertices on the field fitted last
  std::unique_ptr<Retraction> retraction;  // to that field

 private:
  SurfacePoint place_on_input(int vertex) const;
  const Permutation& input_order() const { return input_order_ ? *input_order_ : order; }
  void connect(std::shared_ptr<const Adjacency> smooth, const std::vector<Edge>& creases);
  SurfaceField fit(std::shared_ptr<const Mat3X> points) const;

  FilterOptions filter_;
  RetractionOptions retraction_options_;
  bool faces_replaced_ = false;
  bool vertices_replaced_ = false;
  std::optional<Permutation> input_order_;               // the ids in the input, once `order` has others
  std::shared_ptr<const Adjacency> input_connectivity_;  // on `start`
  UniformVector start_length_;                           // target lengths there
  bool refitted_ = false;                                // until then both fields are the same
  std::vector<int> input_hints_;                         // where each vertex is tracked on the input
  std::unique_ptr<Retraction> to_input_;                 // to the field of the input
  ProjectionCounts finished_;                            // of the retractions that are gone
};

}  // namespace hooke
