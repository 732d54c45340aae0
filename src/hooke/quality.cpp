#include "hooke/quality.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>

#include "hooke/curvature.h"
#include "hooke/parallel.h"
#include "hooke/self_intersection.h"
#include "hooke/triangle_shape.h"

namespace hooke {
namespace {

constexpr size_t block = 4096;

std::vector<TriangleShape> measure_faces(const Mat3X& points, const std::vector<Triangle>& faces) {
  std::vector<TriangleShape> shapes(faces.size());
  parallel_for(faces.size(), block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f)
      shapes[f] = measure_triangle(points.col(faces[f][0]), points.col(faces[f][1]), points.col(faces[f][2]));
  });
  return shapes;
}

std::vector<double> measure_edges(const Mat3X& points, const std::vector<Edge>& edges) {
  std::vector<double> lengths(edges.size());
  parallel_for(edges.size(), block, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e)
      lengths[e] = (points.col(edges[e][0]) - points.col(edges[e][1])).norm();
  });
  return lengths;
}

/// Cross products of two edges of every face: along the normal, twice the area long.
Mat3X area_vectors(const Mat3X& points, const std::vector<Triangle>& faces) {
  Mat3X vectors(3, static_cast<Eigen::Index>(faces.size()));
  parallel_for(faces.size(), block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const Vec3 a = points.col(faces[f][0]);
      const Vec3 b = points.col(faces[f][1]);
      const Vec3 c = points.col(faces[f][2]);
      vectors.col(static_cast<Eigen::Index>(f)) = (b - a).cross(c - a);
    }
  });
  return vectors;
}

size_t count_folded_edges(const Mat3X& area_vector, const Connectivity& connectivity) {
  size_t folded = 0;
  for (const auto& [left, right] : connectivity.edge_faces) {
    if (right < 0) continue;
    // Unit normals first: the plain product of two small faces' vectors could vanish.
    const Vec3 n = area_vector.col(left).normalized(), m = area_vector.col(right).normalized();
    folded += n.dot(m) < 0;
  }
  return folded;
}

std::vector<WorstFace> find_worst_faces(const Mat3X& points, const Connectivity& connectivity,
                                        const std::vector<TriangleShape>& shapes, size_t wanted) {
  const std::vector<Triangle>& faces = connectivity.faces;
  std::vector<int> order(faces.size());
  std::iota(order.begin(), order.end(), 0);
  const auto count = static_cast<std::ptrdiff_t>(std::min(wanted, order.size()));
  std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](int f, int g) {
    const double a = shapes[static_cast<size_t>(f)].min_angle, b = shapes[static_cast<size_t>(g)].min_angle;
    return a < b || (a == b && f < g);
  });
  std::vector<WorstFace> worst;
  for (auto it = order.begin(); it != order.begin() + count; ++it) {
    const Triangle& t = faces[static_cast<size_t>(*it)];
    worst.push_back({*it, shapes[static_cast<size_t>(*it)].min_angle, t,
                     (points.col(t[0]) + points.col(t[1]) + points.col(t[2])) / 3,
                     bound_least_angle(points, connectivity, *it)});
  }
  return worst;
}

Range range_of(const std::vector<double>& values) {
  const Statistics s = describe(values);
  return {s.min, s.mean, s.max};
}

void describe_all(const std::vector<TriangleShape>& shapes, const std::vector<double>& lengths,
                  const std::vector<double>& targets, Quality& q) {
  const auto column = [&](double TriangleShape::*measure) {
    std::vector<double> values(shapes.size());
    for (size_t f = 0; f < shapes.size(); ++f) values[f] = shapes[f].*measure;
    return values;
  };
  // Fixed bins where the range is known, so that before and after can be laid side by side.
  const std::function<void()> parts[] = {
      [&] {
        q.min_angle = describe(column(&TriangleShape::min_angle), {0, 60});
      },
      [&] {
        q.max_angle = describe(column(&TriangleShape::max_angle), {60, 180});
      },
      [&] {
        q.shape = describe(column(&TriangleShape::shape), {0, 1});
      },
      [&] { q.radius_ratio = describe(column(&TriangleShape::radius_ratio)); },
      [&] { q.aspect_ratio = describe(column(&TriangleShape::aspect_ratio)); },
      [&] { q.edge_ratio = describe(column(&TriangleShape::edge_ratio)); },
      [&] { q.edge_length = describe(lengths); },
      [&] {
        std::vector<double> errors(targets.size());
        for (size_t e = 0; e < targets.size(); ++e) errors[e] = (lengths[e] - targets[e]) / targets[e];
        q.length_error = describe(std::move(errors));
      },
  };
  parallel_for(std::size(parts), 1, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) parts[k]();
  });
}

}  // namespace

Quality measure_quality(const Mat3X& points, const Connectivity& connectivity,
                        const std::vector<double>& edge_target_length, const QualityOptions& options) {
  assert(edge_target_length.empty() || edge_target_length.size() == connectivity.edges.size());
  Quality q;
  q.topology = measure_topology(connectivity);
  q.extent = measure_extent(points, connectivity);
  q.valence = count_valences(connectivity);

  const std::vector<TriangleShape> shapes = measure_faces(points, connectivity.faces);
  describe_all(shapes, measure_edges(points, connectivity.edges), edge_target_length, q);
  q.worst_faces = find_worst_faces(points, connectivity, shapes, options.worst_faces);

  const Mat3X area_vector = area_vectors(points, connectivity.faces);
  q.folded_edges = count_folded_edges(area_vector, connectivity);
  const double least_area = 1e-14 * q.extent.diagonal * q.extent.diagonal;
  for (Eigen::Index f = 0; f < area_vector.cols(); ++f) {
    const double area = .5 * area_vector.col(f).norm();
    q.degenerate_faces += !(area > 0 && area >= least_area);
  }
  const VertexCurvature curvature = measure_curvature(points, connectivity);
  q.mean_curvature = range_of(curvature.mean);
  q.gaussian_curvature = range_of(curvature.gaussian);
  if (options.self_intersections)
    q.self_intersections = find_self_intersections(points, connectivity.faces).size();
  return q;
}

}  // namespace hooke
