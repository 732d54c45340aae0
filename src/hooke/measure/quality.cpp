#include "hooke/measure/quality.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>

#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/curvature.h"

namespace hooke {
namespace {

constexpr size_t quality_block = 1024;

using FaceShapes = UninitializedVector<TriangleShape>;

FaceShapes measure_faces(const Mat3X& points, const std::vector<Triangle>& faces) {
  FaceShapes shapes(faces.size());
  parallel_for(faces.size(), quality_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const auto& [a, b, c] = faces[f];
      shapes[f] = measure_triangle(points.col(a), points.col(b), points.col(c));
    }
  });
  return shapes;
}

std::vector<double> measure_edges(const Mat3X& points, const std::vector<Edge>& edges) {
  std::vector<double> lengths(edges.size());
  parallel_for(edges.size(), quality_block, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e)
      lengths[e] = (points.col(edges[e][0]) - points.col(edges[e][1])).norm();
  });
  return lengths;
}

/// Cross product of two edges of every face: a normal vector whose length is twice the area.
Mat3X area_vectors(const Mat3X& points, const std::vector<Triangle>& faces) {
  Mat3X vectors(3, static_cast<Eigen::Index>(faces.size()));
  parallel_for(faces.size(), quality_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const Vec3 a = points.col(faces[f][0]), b = points.col(faces[f][1]), c = points.col(faces[f][2]);
      vectors.col(static_cast<Eigen::Index>(f)) = (b - a).cross(c - a);
    }
  });
  return vectors;
}

/// Number of indices in [0, count) for which the condition holds.
template <typename Condition>
size_t count_where(size_t count, const Condition& condition) {
  const double sum = parallel_sum(count, quality_block, [&](size_t begin, size_t end) {
    size_t found = 0;
    for (size_t i = begin; i < end; ++i) found += condition(i);
    return static_cast<double>(found);
  });
  return sum;
}

bool is_fold(const Vec3& area_vector, const Vec3& other) {
  constexpr double min_fold = -1e-6;  // keeps right-angled creases from counting as folds
  // Normalised first: the product of the area vectors of two small faces could vanish.
  return area_vector.normalized().dot(other.normalized()) < min_fold;
}

size_t count_folded_edges(const Mat3X& area_vector, const Adjacency& adjacency) {
  return count_where(adjacency.edge_faces.size(), [&](size_t e) {
    const auto [left, right] = adjacency.edge_faces[e];
    return right >= 0 && is_fold(area_vector.col(left), area_vector.col(right));
  });
}

size_t count_degenerate_faces(const Mat3X& area_vector, double diagonal) {
  return count_where(area_vector.cols(), [&](size_t f) {
    return has_no_area(.5 * area_vector.col(static_cast<Eigen::Index>(f)).norm(), diagonal);
  });
}

/// The first faces in the order of `is_worse` of which no two share a vertex.
template <typename IsWorse>
std::vector<int> worst_of_each_region(const Adjacency& c, std::vector<int> faces, size_t max_count,
                                      const IsWorse& is_worse) {
  std::vector<int> chosen;
  std::vector<char> is_taken(c.vertex_count, 0);
  const auto taken = [&](int v) -> char& { return is_taken[v]; };
  const auto begin = faces.begin();
  for (std::ptrdiff_t sorted = 0, all = std::ssize(faces); sorted < all && chosen.size() < max_count;) {
    const std::ptrdiff_t next = std::min<std::ptrdiff_t>(all, 2 * sorted + 100);
    std::partial_sort(begin + sorted, begin + next, faces.end(), is_worse);
    for (; sorted < next && chosen.size() < max_count; ++sorted) {
      const int f = faces[sorted];
      const Triangle& t = c.faces[f];
      if (std::ranges::any_of(t, taken)) continue;
      for (int v : t) taken(v) = 1;
      chosen.push_back(f);
    }
  }
  return chosen;
}

std::vector<WorstFace> find_worst_faces(const MeasuredSurface& surface, const FaceShapes& shapes,
                                        size_t max_count) {
  const Mat3X& X = surface.points;
  std::vector<int> order(shapes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto min_angle = [&](int face) { return shapes[face].min_angle; };
  const auto is_worse = [&](int f, int g) {
    return std::pair(min_angle(f), surface.ids.face(f)) < std::pair(min_angle(g), surface.ids.face(g));
  };
  const std::vector<int> chosen =
      worst_of_each_region(surface.adjacency, std::move(order), max_count, is_worse);
  std::vector<WorstFace> worst(chosen.size());
  parallel_for(worst.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int f = chosen[i];
      const Triangle& t = surface.adjacency.faces[f];
      const double longest = std::max({(X.col(t[1]) - X.col(t[0])).norm(), (X.col(t[2]) - X.col(t[1])).norm(),
                                       (X.col(t[0]) - X.col(t[2])).norm()});
      worst[i] = {surface.ids.face(f),
                  min_angle(f),
                  surface.ids.corners(t),
                  (X.col(t[0]) + X.col(t[1]) + X.col(t[2])) / 3,
                  longest > 0 ? doubled_area_vector(X, t).norm() / longest : 0,
                  bound_min_angle(X, surface.adjacency, f)};
      std::vector<int>& bounding = worst[i].bound.vertices;
      std::ranges::transform(bounding, bounding.begin(), [&](int v) { return surface.ids.vertex(v); });
      std::ranges::sort(bounding);
    }
  });
  return worst;
}

/// Removes the values of edges of sheets that are an earlier edge of the joined mesh.
void keep_each_once(const MeasuredSurface& surface, std::vector<double>& of_edges) {
  if (surface.joined.empty() || of_edges.empty()) return;
  const std::vector<char> is_first = first_of_joined(surface.adjacency, surface.joined);
  size_t kept = 0;
  for (size_t e = 0; e < of_edges.size(); ++e)
    if (is_first[e]) of_edges[kept++] = of_edges[e];
  of_edges.resize(kept);
}

void describe_all(const MeasuredSurface& surface, const FaceShapes& shapes,
                  const std::vector<double>& lengths, const UniformVector& targets, Quality& q) {
  const auto column = [&](double TriangleShape::*measure) {
    std::vector<double> values(shapes.size());
    for (size_t f = 0; f < shapes.size(); ++f) values[f] = shapes[f].*measure;
    return values;
  };
  // Fixed bins where the range is known, so that histograms can be compared. The order balances two threads:
  // there are more edges than faces.
  const std::function<void()> parts[] = {
      [&] {
        std::vector<double> values = lengths;
        keep_each_once(surface, values);
        q.edge_length = describe(std::move(values));
      },
      [&] {
        q.min_angle = describe(column(&TriangleShape::min_angle), {0, 60});
      },
      [&] {
        q.max_angle = describe(column(&TriangleShape::max_angle), {60, 180});
      },
      [&] {
        q.shape = describe(column(&TriangleShape::shape), {0, 1});
      },
      [&] {
        std::vector<double> errors(targets.size());
        for (size_t e = 0; e < targets.size(); ++e) errors[e] = (lengths[e] - targets[e]) / targets[e];
        keep_each_once(surface, errors);
        q.length_error = describe(std::move(errors));
      },
      [&] { q.radius_ratio = describe(column(&TriangleShape::radius_ratio)); },
      [&] { q.aspect_ratio = describe(column(&TriangleShape::aspect_ratio)); },
      [&] { q.edge_ratio = describe(column(&TriangleShape::edge_ratio)); },
  };
  parallel_for(std::size(parts), 1, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) parts[k]();
  });
}

}  // namespace

bool is_folded_edge(const Mat3X& points, const Adjacency& adjacency, int edge) {
  const auto [left, right] = adjacency.edge_faces[edge];
  return right >= 0 && is_fold(doubled_area_vector(points, adjacency.faces[left]),
                               doubled_area_vector(points, adjacency.faces[right]));
}

bool has_no_area(double area, double diagonal) {
  return !(area > 0 && area >= 1e-14 * diagonal * diagonal);
}

Range range_of(std::vector<double> values) {
  const Statistics s = describe(std::move(values));
  return {s.min, s.mean, s.max};
}

Quality measure_quality(const MeasuredSurface& surface, const UniformVector& edge_target_length,
                        const QualityOptions& options, Stopwatch* stopwatch) {
  const Adjacency& adjacency = surface.adjacency;
  const Mat3X& points = surface.points;
  assert(edge_target_length.empty() || edge_target_length.size() == adjacency.edges.size());
  Quality q;
  q.extent = surface.extent;
  timed(stopwatch, "topology", [&] {
    q.topology = measure_topology(adjacency, surface.joined);
    q.valence = count_valences(adjacency, surface.joined);
    q.junctions = count_junctions(adjacency, surface.joined);
  });
  timed(stopwatch, "angles", [&] {
    const FaceShapes shapes = measure_faces(points, adjacency.faces);
    const auto count_below = [&](double degrees) {
      return static_cast<size_t>(
          std::ranges::count_if(shapes, [&](const TriangleShape& s) { return s.min_angle < degrees; }));
    };
    q.faces_below_20 = count_below(20);
    q.faces_below_30 = count_below(30);
    describe_all(surface, shapes, measure_edges(points, adjacency.edges), edge_target_length, q);
    q.worst_faces = find_worst_faces(surface, shapes, options.worst_faces);
  });
  timed(stopwatch, "folds", [&] {
    const Mat3X area_vector = area_vectors(points, adjacency.faces);
    q.folded_edges = count_folded_edges(area_vector, adjacency);
    q.degenerate_faces = count_degenerate_faces(area_vector, q.extent.diagonal);
  });
  timed(stopwatch, "curvature", [&] {
    VertexCurvature curvature = measure_curvature(points, adjacency);
    q.mean_curvature = range_of(std::move(curvature.mean));
    q.gaussian_curvature = range_of(std::move(curvature.gaussian));
  });
  if (options.self_intersections)
    q.self_intersections =
        timed(stopwatch, "self_intersections", [&] { return surface.self_intersections().size(); });
  return q;
}

Quality measure_quality(const Mat3X& points, const Adjacency& adjacency,
                        const UniformVector& edge_target_length, const QualityOptions& options) {
  return measure_quality(MeasuredSurface(points, adjacency), edge_target_length, options);
}

void apply_creases(Quality& quality, const MeasuredSurface& surface, const std::vector<Edge>& creases) {
  if (creases.empty()) return;
  const Adjacency& c = surface.adjacency;
  for (const auto& [a, b] : creases)
    for (int e : c.vertex_edges[a])
      if (c.other_end(e, a) == b && is_folded_edge(surface.points, c, e)) --quality.folded_edges;
  std::vector<int> ids;
  for (const WorstFace& f : quality.worst_faces) ids.push_back(f.face);
  std::vector<AngleBound> bounds = bound_min_angles(surface, ids, creases);
  for (size_t i = 0; i < bounds.size(); ++i) quality.worst_faces[i].bound = std::move(bounds[i]);
}

}  // namespace hooke
