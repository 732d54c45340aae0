#include "hooke/deviation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/bounding_volume_tree.h"
#include "hooke/extent.h"
#include "hooke/parallel.h"

namespace hooke {
namespace {

constexpr size_t block = 1024;

Vec3 face_centre(const Mat3X& points, const Triangle& t) {
  return (points.col(t[0]) + points.col(t[1]) + points.col(t[2])) / 3;
}

/// Along the normal, twice the area long.
Vec3 area_vector(const Mat3X& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
  return (b - a).cross(c - a);
}

/// One of the two surfaces, ready to be asked.
struct Side {
  Side(const Mat3X& p, const Connectivity& c) : points(p), connectivity(c), tree(p, c.faces) {}

  /// The face of this side with the id of another side's face, if there is one.
  int hint(int face) const { return face < static_cast<int>(connectivity.faces.size()) ? face : -1; }

  const Mat3X& points;
  const Connectivity& connectivity;
  BoundingVolumeTree tree;
};

/// Squared distances to another surface, at the points that measure_distance() asks for.
struct Samples {
  std::vector<double> vertices;  // 0 at isolated ones: they are no part of the surface
  std::vector<double> edges;     // midpoints
  std::vector<ClosestPoint> centres;
  std::vector<std::array<double, 3>> quarters;  // centres of the quarters at the three corners
};

Samples sample_distances(const Side& from, const Side& to) {
  const Connectivity& c = from.connectivity;
  Samples samples;
  samples.vertices.resize(static_cast<size_t>(c.vertex_count));
  samples.edges.resize(c.edges.size());
  samples.centres.resize(c.faces.size());
  samples.quarters.resize(c.faces.size());
  parallel_for(samples.vertices.size(), block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      const auto ring = c.vertex_faces[static_cast<int>(v)];
      if (ring.empty()) continue;
      const Vec3 x = from.points.col(static_cast<Eigen::Index>(v));
      samples.vertices[v] = to.tree.closest(x, to.hint(ring.front())).squared_distance;
    }
  });
  parallel_for(samples.edges.size(), block, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      const Vec3 x = .5 * (from.points.col(c.edges[e][0]) + from.points.col(c.edges[e][1]));
      samples.edges[e] = to.tree.closest(x, to.hint(c.edge_faces[e][0])).squared_distance;
    }
  });
  parallel_for(c.faces.size(), block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const Triangle& t = c.faces[f];
      const Vec3 centre = face_centre(from.points, t);
      samples.centres[f] = to.tree.closest(centre, to.hint(static_cast<int>(f)));
      for (size_t k = 0; k < 3; ++k)
        samples.quarters[f][k] =
            to.tree.closest(.5 * (from.points.col(t[k]) + centre), samples.centres[f].face).squared_distance;
    }
  });
  return samples;
}

/// The rms takes each of the four quarters by the rule that is exact for quadratics: 1/12 at each corner, 3/4
/// at the centre.
MaxRms measure_distance(const Side& from, const Samples& samples) {
  double greatest = 0, area = 0, integral = 0;
  for (size_t f = 0; f < samples.centres.size(); ++f) {
    double corners = 0, midpoints = 0, centres = samples.centres[f].squared_distance;
    greatest = std::max(greatest, centres);
    for (size_t k = 0; k < 3; ++k) {
      const double corner = samples.vertices[static_cast<size_t>(from.connectivity.faces[f][k])];
      const double midpoint = samples.edges[static_cast<size_t>(from.connectivity.face_edges[f][k])];
      const double quarter = samples.quarters[f][k];
      greatest = std::max({greatest, corner, midpoint, quarter});
      corners += corner;
      midpoints += midpoint;
      centres += quarter;
    }
    const double weight = area_vector(from.points, from.connectivity.faces[f]).norm();
    area += weight;
    integral +=
        weight * (corners / 48 + midpoints / 16 + centres * 3 / 16);  // a midpoint is in three quarters
  }
  return {std::sqrt(greatest), area > 0 ? std::sqrt(integral / area) : 0};
}

MaxRms measure_displacement(const Mat3X& before, const Mat3X& after) {
  MaxRms displacement;
  double squares = 0;
  for (Eigen::Index v = 0; v < before.cols(); ++v) {
    const double d = (after.col(v) - before.col(v)).squaredNorm();
    displacement.max = std::max(displacement.max, d);
    squares += d;
  }
  displacement.max = std::sqrt(displacement.max);
  if (before.cols() > 0) displacement.rms = std::sqrt(squares / static_cast<double>(before.cols()));
  return displacement;
}

/// `closest` belongs to the centres of the result's faces.
MaxRms measure_normal_deviation(const Side& reference, const Side& result,
                                const std::vector<ClosestPoint>& closest) {
  MaxRms deviation;
  double area = 0, integral = 0;
  for (size_t f = 0; f < closest.size(); ++f) {
    if (closest[f].face < 0) continue;
    const Vec3 n = area_vector(result.points, result.connectivity.faces[f]);
    const Triangle& across = reference.connectivity.faces[static_cast<size_t>(closest[f].face)];
    const Vec3 m = area_vector(reference.points, across);
    if (!(n.squaredNorm() > 0 && m.squaredNorm() > 0)) continue;  // no normal, no angle
    const double angle = std::atan2(n.cross(m).norm(), n.dot(m)) * (180 / std::numbers::pi);
    deviation.max = std::max(deviation.max, angle);
    area += n.norm();
    integral += n.norm() * angle * angle;
  }
  if (area > 0) deviation.rms = std::sqrt(integral / area);
  return deviation;
}

/// Unit normals; faces weigh by their area, so that a folded sliver does not turn them.
Mat3X vertex_normals(const Side& side) {
  Mat3X normals = Mat3X::Zero(3, side.connectivity.vertex_count);
  for (const Triangle& t : side.connectivity.faces)
    for (int v : t) normals.col(v) += area_vector(side.points, t);
  normals.colwise().normalize();
  return normals;
}

/// The reference's vertex normals, interpolated at a point of its surface.
Vec3 normal_at(const Side& reference, const Mat3X& normals, const ClosestPoint& at) {
  const Triangle& t = reference.connectivity.faces[static_cast<size_t>(at.face)];
  const Vec3 weights = barycentric(at.point, reference.points.col(t[0]), reference.points.col(t[1]),
                                   reference.points.col(t[2]));
  return weights[0] * normals.col(t[0]) + weights[1] * normals.col(t[1]) + weights[2] * normals.col(t[2]);
}

/// `closest` belongs to the centres of the result's faces.
void find_opposing_faces(const Side& reference, const Side& result, const std::vector<ClosestPoint>& closest,
                         Deviation& deviation) {
  const Mat3X normals = vertex_normals(reference);
  for (size_t f = 0; f < closest.size(); ++f) {
    if (closest[f].face < 0) continue;
    const Vec3 n = area_vector(result.points, result.connectivity.faces[f]);
    const Triangle& across = reference.connectivity.faces[static_cast<size_t>(closest[f].face)];
    const bool flipped = n.dot(normal_at(reference, normals, closest[f])) < 0;
    deviation.flipped_faces += flipped;
    if (flipped || n.dot(area_vector(reference.points, across)) < 0)
      deviation.opposing_faces.push_back(static_cast<int>(f));
  }
}

/// Boundary edges as triangles without area, which is how the tree takes segments.
std::vector<Triangle> boundary_segments(const Connectivity& connectivity) {
  std::vector<Triangle> segments;
  for (size_t e = 0; e < connectivity.edges.size(); ++e) {
    const auto [a, b] = connectivity.edges[e];
    if (connectivity.is_boundary_edge(static_cast<int>(e))) segments.push_back({a, b, b});
  }
  return segments;
}

double greatest_distance(const Mat3X& points, const std::vector<Triangle>& segments,
                         const BoundingVolumeTree& to) {
  constexpr int samples = 8;
  std::vector<double> greatest(segments.size());
  parallel_for(segments.size(), block, [&](size_t begin, size_t end) {
    for (size_t s = begin; s < end; ++s)
      for (int k = 0; k < samples; ++k) {
        const double share = static_cast<double>(k) / samples;
        const Vec3 x = (1 - share) * points.col(segments[s][0]) + share * points.col(segments[s][1]);
        greatest[s] = std::max(greatest[s], to.closest(x).squared_distance);
      }
  });
  return std::sqrt(*std::max_element(greatest.begin(), greatest.end()));
}

std::optional<double> relative_change(std::optional<double> before, std::optional<double> after) {
  if (!before || !after || *before == 0) return std::nullopt;
  return (*after - *before) / std::abs(*before);
}

}  // namespace

Deviation measure_deviation(const Mat3X& reference_points, const Connectivity& reference,
                            const Mat3X& result_points, const Connectivity& result) {
  const Side old_side(reference_points, reference), new_side(result_points, result);
  Deviation d;
  if (reference_points.cols() == result_points.cols())
    d.displacement = measure_displacement(reference_points, result_points);

  const Samples outward = sample_distances(new_side, old_side);
  d.to_reference = measure_distance(new_side, outward);
  d.from_reference = measure_distance(old_side, sample_distances(old_side, new_side));
  d.normal_deviation = measure_normal_deviation(old_side, new_side, outward.centres);
  find_opposing_faces(old_side, new_side, outward.centres, d);

  const Extent before = measure_extent(reference_points, reference);
  const Extent after = measure_extent(result_points, result);
  d.diagonal = before.diagonal;
  d.area_change = relative_change(before.area, after.area);
  d.volume_change = relative_change(before.volume, after.volume);

  const auto old_rim = boundary_segments(reference), new_rim = boundary_segments(result);
  if (!old_rim.empty() && !new_rim.empty()) {
    d.boundary_to_reference =
        greatest_distance(result_points, new_rim, BoundingVolumeTree(reference_points, old_rim));
    d.boundary_from_reference =
        greatest_distance(reference_points, old_rim, BoundingVolumeTree(result_points, new_rim));
  }
  return d;
}

}  // namespace hooke
