// Quality of the triangles of a mesh: statistics of angles, shapes and edge lengths, defects, and the worst
// faces.
#pragma once

#include <cstddef>
#include <optional>

#include "hooke/core/stopwatch.h"
#include "hooke/core/uniform_vector.h"
#include "hooke/measure/angle_bound.h"
#include "hooke/measure/measured_surface.h"
#include "hooke/measure/polygon_angles.h"
#include "hooke/measure/statistics.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/topology.h"

namespace hooke {

/// Range of a curvature; NaN if it is nowhere defined.
struct Range {
  double min = Statistics::none;
  double mean = Statistics::none;
  double max = Statistics::none;
};

/// Of the finite values.
Range range_of(std::vector<double> values);

/// A face with one of the smallest angles of the mesh.
struct WorstFace {
  int face = -1;
  double min_angle = 0;  // degrees
  Triangle vertices{};
  Vec3 centre = Vec3::Zero();
  double height = 0;  // over its longest edge
  AngleBound bound;   // upper bound of the angle for the given connectivity
  /// What limits the angle, see limiting_factors.h; empty where unknown.
  std::vector<std::string> reasons = {};
};

/// Is this area below 1e-14 times the squared diagonal of the bounding box, or not finite?
bool has_no_area(double area, double diagonal);

/// Lengths are in the unit of the points, angles in degrees.
struct Quality {
  // Per face, see geometry/triangle.h.
  Statistics min_angle;
  std::size_t faces_below_20 = 0, faces_below_30 = 0;  // with a smaller minimum angle, degrees
  Statistics max_angle;
  Statistics shape;
  Statistics radius_ratio;
  Statistics aspect_ratio;
  Statistics edge_ratio;
  // Per edge.
  Statistics edge_length;
  Statistics length_error;  // (l - L_e) / L_e; empty without target lengths

  /// Unit normals on both sides have a dot product below -1e-6; without creases after apply_creases().
  std::size_t folded_edges = 0;
  std::size_t degenerate_faces = 0;               // see has_no_area()
  std::optional<std::size_t> self_intersections;  // pairs of faces; empty if not requested
  Valence valence;
  Range mean_curvature;      // over the interior vertices, see curvature.h
  Range gaussian_curvature;  // likewise
  /// One for each region, so that no two share a vertex; smallest angle first, ties by face id.
  std::vector<WorstFace> worst_faces;

  /// Of a file's polygons, where the faces are their triangles; not set by measure_quality().
  std::optional<PolygonAngles> polygon_angles;

  Topology topology;
  JunctionCounts junctions;
  Extent extent;
};

struct QualityOptions {
  bool self_intersections = true;  // exact, but slow: several times the time of all the rest
  std::size_t worst_faces = 10;    // number to report
};

/// `edge_target_length` holds L_e for every edge of the adjacency, or nothing.
Quality measure_quality(const MeasuredSurface& surface, const UniformVector& edge_target_length,
                        const QualityOptions& options = {}, Stopwatch* stopwatch = nullptr);
Quality measure_quality(const Mat3X& points, const Adjacency& adjacency,
                        const UniformVector& edge_target_length, const QualityOptions& options = {});

/// Is it counted as folded, creases included?
bool is_folded_edge(const Mat3X& points, const Adjacency& adjacency, int edge);

/// Takes the folded edges that are creases, and so meant, from the count, and computes the angle bounds of
/// the worst faces anew for fixed creases, see bound_min_angles(). Creases are pairs of vertices of the
/// adjacency.
void apply_creases(Quality& quality, const MeasuredSurface& surface, const std::vector<Edge>& creases);

}  // namespace hooke
