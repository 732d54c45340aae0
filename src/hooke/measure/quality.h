// How good the triangles of a mesh are.
#pragma once

#include <cstddef>
#include <optional>

#include "hooke/core/stopwatch.h"
#include "hooke/core/uniform_vector.h"
#include "hooke/measure/angle_bound.h"
#include "hooke/measure/measured_surface.h"
#include "hooke/measure/statistics.h"
#include "hooke/mesh/topology.h"

namespace hooke {

/// NaN when the curvature is nowhere defined.
struct Range {
  double min = Statistics::none;
  double mean = Statistics::none;
  double max = Statistics::none;
};

struct WorstFace {
  int face = -1;
  double min_angle = 0;  // degrees
  Triangle vertices{};
  Vec3 centre = Vec3::Zero();
  AngleBound bound;  // what the connectivity about it allows
  std::vector<std::string> reasons =
      {};  // what bounds the angle, see limiting_factors.h; none where it is unknown
};

struct Quality {
  // Per face, see triangle_shape.h.
  Statistics min_angle;
  Statistics max_angle;
  Statistics shape;
  Statistics radius_ratio;
  Statistics aspect_ratio;
  Statistics edge_ratio;
  // Per edge.
  Statistics edge_length;
  Statistics length_error;  // (l - L_e) / L_e; empty when no target lengths were given

  std::size_t folded_edges = 0;                   // the unit normals on both sides have a product below -1e-6
  std::size_t degenerate_faces = 0;               // area below 1e-14 times the squared diagonal of the box
  std::optional<std::size_t> self_intersections;  // pairs of faces; none when not asked for
  Valence valence;
  Range mean_curvature;                // over the interior vertices, see curvature.h
  Range gaussian_curvature;            // likewise
  std::vector<WorstFace> worst_faces;  // smallest angles first, ties by face id

  Topology topology;
  Extent extent;
};

struct QualityOptions {
  bool self_intersections = true;  // the slow part: exact, but several times the time of all the rest
  std::size_t worst_faces = 10;    // how many to name
};

/// `edge_target_length` holds L_e for every edge of the connectivity, or nothing.
Quality measure_quality(const MeasuredSurface& surface, const UniformVector& edge_target_length,
                        const QualityOptions& options = {}, Stopwatch* stopwatch = nullptr);
Quality measure_quality(const Mat3X& points, const Adjacency& adjacency,
                        const UniformVector& edge_target_length, const QualityOptions& options = {});

/// Bounds the least angles of these faces anew for creases that stay, see bound_least_angles().
void bound_between_creases(std::vector<WorstFace>& faces, const MeasuredSurface& surface,
                           const std::vector<Edge>& creases);

}  // namespace hooke
