// What a result must keep of the mesh it was made from: the side of its faces, no new folds and crossings,
// its topology, its creases and tips, and its distance. All figures but the distances are in comparison to
// the reference, so that what is wrong in a file may stay as it is.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "hooke/core/types.h"

namespace hooke {

struct Deviation;
struct MeasuredSurface;
struct Quality;

/// The sizes that limits are shares of.
struct ReferenceScale {
  double diagonal;   // of the bounding box of the reference
  double mean_edge;  // of a result
};

struct PreservationOptions {
  /// Maximum distance between the surfaces, both ways and at all samples, in file units. None: of the
  /// result's vertices from the reference 12 local sagittas (see mesh/sagitta.h), but no more than 2 and half
  /// a mean edge, or 1e-3 of the diagonal, whichever is more; of the reference's vertices from the result as
  /// much or .6 of the edges there.
  std::optional<double> max_distance = {};
  double feature_angle = 40;  // degrees; sharper edges of the reference have no sagitta
  bool faceted = false;       // is_faceted(reference): no half edges and no more than 2 sagittas
  /// Also limits the distances between faces and between creases, at samples, to 2 local sagittas or 1e-3 (on
  /// creases 1e-6) of the diagonal: for results with the vertices of a reference whose facets are meant.
  bool keeps_facets = false;
  /// Those of the whole for a part of it, and of the first result for others; none: those of the surfaces.
  std::optional<ReferenceScale> scale = {};
  /// How many self-intersections more than the reference a result may have, or fewer; crossings where the
  /// reference has none break a promise only beyond that. For a part: what other parts leave to it.
  long long more_crossings = 0;
  /// Are the points of results rounded to 32-bit floats, as in the file that they are for? They are judged as
  /// they stand there.
  bool has_float_points = false;
};

/// A vertex that is too far from the other surface.
struct FarVertex {
  int vertex;  // or a corner of a face or an end of a crease that is
  double distance;
  double limit;  // of the distance
};

/// Points of both surfaces that are too far apart: the worst sample of a face, which may lie between vertices
/// that are near, and what is closest to it.
struct FarSample {
  int face;  // of the result
  Vec3 on_result, on_reference;
  double limit;  // of their distance
};

/// Ids are those of the adjacencies; places and lengths are in file units.
struct Preservation {
  std::size_t flipped_faces = 0;         // of the result, see Deviation
  std::vector<FarVertex> far_vertices;   // of the result: beyond the limit from the reference
  std::vector<FarVertex> lost_vertices;  // of the reference: beyond the limit from the result
  std::vector<FarSample> far_samples;    // at most one for each face of these, whose corners are above
  bool within_max_distance = true;       // are the surfaces, by the samples of the Deviation?
  double excess = 0;                     // the greatest distance of these vertices over its limit
  double distance = 0;                   // the distance there
  /// The vertex there; if no distance is beyond its limit, the centre of a face that is turned over, crosses
  /// another or has no area, if there is one, else the middle of the lost crease edge that is farthest.
  Vec3 place = Vec3::Zero();
  std::size_t new_folds = 0;      // folded edges that are no creases, in excess of the reference's
  std::size_t new_crossings = 0;  // self-intersections, likewise; at most the number of `crossings`
  std::vector<std::array<int, 2>> crossings;  // new_crossings(), if there are more than in the reference
  std::size_t new_degenerate_faces = 0;  // faces without area, likewise; at most that of degenerate_faces
  std::vector<int> degenerate_faces;     // new_degenerate_faces(), if there are more than in the reference
  bool topology_kept = true;             // components, boundary loops, Euler number and junctions
  double crease_loss = 0;          // greatest distance of the reference's creases from those of the result
  bool creases_kept = true;        // within half an edge
  std::vector<Edge> lost_creases;  // of the reference, those that are not; no sharp edges of facets

  /// Is everything kept?
  bool holds() const { return flaws() == 0; }

  /// Number of things that are not.
  std::size_t flaws() const {
    return flipped_faces + far_vertices.size() + lost_vertices.size() + new_folds + new_crossings +
           new_degenerate_faces + (within_max_distance ? 0 : 1) + (topology_kept ? 0 : 1) +
           (creases_kept ? 0 : 1);
  }
};

/// A mesh, its quality after apply_creases(), and its crease edges as vertices of the adjacency.
struct CreasedSurface {
  const MeasuredSurface& surface;
  const Quality& quality;
  const std::vector<Edge>& creases;
};

/// The pairs of faces of the result that intersect where no faces of the reference do: the middle of their
/// crossing_segment() is farther from those of the reference than their longest edge. So surfaces that cross
/// may cross in other faces, and bodies that touch may cross where they do. Ascending pairs of faces of the
/// adjacency.
std::vector<std::array<int, 2>> new_crossings(const MeasuredSurface& reference,
                                              const MeasuredSurface& result);

/// The faces without area of the result whose corners are not on such faces of the reference. So one that is
/// split may become two. Ascending faces of the adjacency.
std::vector<int> new_degenerate_faces(const MeasuredSurface& reference, const MeasuredSurface& result);

Preservation measure_preservation(const CreasedSurface& reference, const CreasedSurface& result,
                                  const Deviation& deviation, const PreservationOptions& options = {});

}  // namespace hooke
