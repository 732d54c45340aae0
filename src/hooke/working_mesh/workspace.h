// The workspace of the optimizer: the normalised mesh in memory order, with its constraints, target lengths
// and surface fields.
#pragma once

#include <memory>
#include <optional>

#include "hooke/core/stopwatch.h"
#include "hooke/filter/surface_field.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/placed_lengths.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/vertex_table.h"

namespace hooke {

/// x = centre + unit * x'. The unit is the mean target length and the centre that of the bounding box, so
/// that a mesh scaled by a power of two has bitwise the same normalised coordinates.
struct Normalisation {
  Vec3 centre = Vec3::Zero();
  double unit = 1;
};

/// Vertices are tracked on two surface fields: that of the input, on which they lie in the end, and the one
/// fitted last. Both are the same until the first refit().
struct Workspace {
  /// Reads the target lengths from v:target_length. `memory_order` must belong to `mesh`. Keeps no reference
  /// to the mesh. `shorter`: see set_lengths().
  Workspace(const TriMesh& mesh, MemoryOrder memory_order, const ConstraintOptions& constraints,
            const FilterOptions& filter, const RetractionOptions& retraction, Stopwatch* stopwatch = nullptr,
            const std::vector<PlacedLength>& shorter = {});

  /// Fits a new field to the current vertices; displacements are projected to it from now on. [11]-[14]
  void refit();

  /// The positions of the vertices projected to the field of the input, on which they are tracked from now
  /// on. `positions` does not change.
  SurfacePositions project_to_input();

  /// Sets the hints for projections to the field of the input, one per wedge.
  void track_on_input(std::vector<int> hints) { input_hints_ = std::move(hints); }

  /// The retraction to the field of the input.
  Retraction& to_input() { return *to_input_; }

  /// Is the field fitted last another one than that of the input?
  bool refitted() const { return refitted_; }

  /// Reverts refit(): the vertices, which must be projected to the input, are tracked on its field again.
  void return_to_input();

  /// Sets the target valences of the corners, see corner_valences().
  void set_corner_valences();

  /// Replaces the faces and keeps the vertices; in the result the new faces take the ids of the input's
  /// faces. Pre-condition: the vertices are tracked on the field of the input, that is before the first
  /// refit() or after return_to_input().
  void replace_faces(std::vector<Triangle> faces);

  /// Replaces vertices and faces: `vertices` has changed already, and `faces` and the `wedges` of their
  /// corners are its rows. Everything is put into memory order; in the result the kept vertices keep their
  /// order, and new ones follow. Pre-condition as for replace_faces().
  void replace_mesh(std::vector<Triangle> faces, const std::vector<Triangle>& wedges);

  /// Lets target lengths in narrow regions between the creases and boundaries of the input be as short as
  /// `shortest`, in the unit of the points that the workspace was made from; see lengths_of_narrow_regions().
  /// They change when they are sampled next. Returns whether there are such regions. Pre-condition:
  /// replace_faces() and replace_mesh() were not called yet.
  bool shorten_in_narrow_regions(double shortest, double gradation);

  /// Sets other target lengths: of the vertices of the input, in its memory order, and where they are
  /// `shorter` than between these. All are in the unit of the points that the workspace was made from.
  void set_lengths(const std::vector<double>& of_input, const std::vector<PlacedLength>& shorter);

  /// Lets all vertices but those that `may_move`, by a mark for each, stand still, and the edges between them
  /// stay, until release(). Pre-condition: there are no junctions.
  void hold_others(const std::vector<char>& may_move);
  void release();
  bool has_held_vertices() const { return !vertices.constraints.held.empty(); }

  /// Do the target lengths vary?
  bool has_varying_lengths() const;

  /// Do they vary faster than along the edges of the input?
  bool has_placed_lengths() const { return !narrow_regions_.empty() || !short_places_.empty(); }

  /// Are they given for each edge by itself (`e:target_length`), not by the place on the surface?
  bool has_edge_lengths() const { return edge_by_edge_; }

  /// Have the edges ratios of their own, `e:rest_ratio`, by which these lengths are multiplied?
  bool has_rest_ratios() const { return !rest_ratios_.empty(); }

  /// Target lengths of the input, interpolated linearly in its faces at the positions of the vertices, or
  /// those of its narrow regions and of where they are shorter.
  std::vector<double> input_lengths() const;

  /// The same at one vertex.
  double input_length(int vertex) const;

  /// Updates varying target lengths to the current positions of the vertices, unless each edge has its own.
  /// References to the targets stay valid.
  void resample_lengths();

  /// The points of the result, by its ids. `input`: those of the mesh that the workspace was made from, which
  /// vertices that did not move keep.
  Mat3X points_of_result(const Mat3X& input) const;

  /// Moves these vertices, by their ids in the result, to other points near the surface, given by these ids.
  void place(const std::vector<int>& ids, const Mat3X& points);

  /// Writes the points to `target`, the mesh that the workspace was made from; vertices that did not move
  /// keep their coordinates. Also writes v:target_length where it varies, and the new faces, or a new mesh if
  /// vertices were replaced. Returns the previous points of `target`.
  Mat3X copy_back(TriMesh& target) const;

  /// The memory order of the result.
  MemoryOrder memory_order() const;

  /// The id of a vertex in the mesh that the workspace was made from; -1 for a new one.
  int vertex_of_input(int vertex) const;

  /// The positions of the result's vertices, in their order there, on the mesh that the workspace was made
  /// from.
  std::vector<MapEntry> map() const;

  ProjectionCounts projection_counts() const;

  Stopwatch* stopwatch;
  Normalisation normalisation;
  Permutation order;  // to the ids of the result, those of the input until replace_mesh(); `faces` is empty
  std::shared_ptr<const Adjacency> adjacency;  // with its creases, seams included
  VertexColoring coloring;
  VertexTable vertices;  // on the field fitted last, with the target lengths at the positions sampled last
  TargetLengths targets;
  std::shared_ptr<const Mat3X> start;      // points of the input, to which vertices.origins refer
  std::unique_ptr<Retraction> retraction;  // to the field fitted last

 private:
  SurfacePoint locate_on_input(int vertex) const;
  void place_lengths(const std::vector<PlacedLength>& shorter);
  double length_at(const Vec3& x, double of_vertices) const;
  std::vector<int> joined_in_result() const;
  const Permutation& input_order() const { return input_order_ ? *input_order_ : order; }
  void connect(std::shared_ptr<const Adjacency> smooth, const std::vector<Edge>& creases);
  /// Sets the targets of edges and faces from those of the vertices.
  void spread_lengths();
  std::shared_ptr<const Adjacency> surface() const;
  SurfaceField fit(std::shared_ptr<const Mat3X> points,
                   const std::shared_ptr<const Adjacency>& surface) const;

  FilterOptions filter_;
  RetractionOptions retraction_options_;
  bool faces_replaced_ = false;
  bool vertices_replaced_ = false;
  std::optional<Permutation> input_order_;          // ids in the input, once vertices were replaced
  std::optional<std::vector<Edge>> sharp_;          // creases where the surface is sharp; none: all are
  std::shared_ptr<const Adjacency> input_surface_;  // with the points `start`, and wedges where it is sharp
  UniformVector start_length_;                      // target lengths with the points `start`
  bool starts_even_ = true;                         // do they differ at most between parts of the mesh?
  PlacedLengths narrow_regions_;                    // see shorten_in_narrow_regions()
  PlacedLengths short_places_;                      // see set_lengths()
  bool refitted_ = false;                           // false: both fields are the same
  bool edge_by_edge_ = false;                       // see has_edge_lengths()
  std::vector<double> rest_ratios_;                 // `e:rest_ratio`, by edge; empty without it
  bool faceted_ = false;                            // are the facets of the input meant?
  std::vector<int> input_hints_;                    // per wedge: hint on the field of the input
  std::unique_ptr<Retraction> to_input_;            // to the field of the input
  ProjectionCounts past_counts_;                    // of retractions that no longer exist
};

}  // namespace hooke
