#include "hooke/constraints/constraints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hooke/core/lists.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/vertex_welding.h"
#include "hooke/mesh/wedges.h"

namespace hooke {

std::vector<int> coincident_boundary_vertices(const Mat3X& points, const Adjacency& c) {
  std::vector<int> coincident;
  for (const Edge& pair : coincident_boundary_pairs(points, c))
    coincident.insert(coincident.end(), pair.begin(), pair.end());
  sort_unique(coincident);
  return coincident;
}

namespace {

/// The vertex after each boundary vertex along its loop, -1 elsewhere.
std::vector<int> boundary_successors(const Adjacency& c) {
  std::vector<int> next(c.vertex_count, -1);
  for (size_t e = 0; e < c.edges.size(); ++e)
    if (c.is_boundary_edge(static_cast<int>(e))) next[c.edges[e][0]] = c.edges[e][1];
  return next;
}

bool is_corner(const Mat3X& points, int before, int at, int after, double cos_corner) {
  return turns(points.col(before), points.col(at), points.col(after), cos_corner);
}

/// Is it one of the lines along rounded edges?
bool is_rounded(const Edge& e, const ConstraintOptions& options) {
  return std::ranges::binary_search(options.rounded_edges, Edge{std::min(e[0], e[1]), std::max(e[0], e[1])});
}

/// Adds a curve through the vertices, along which those that are not fixed slide.
void add_curve(const Mat3X& points, const std::vector<int>& vertices, bool closed, Constraints& result) {
  for (size_t i = 0; i < vertices.size(); ++i) {
    const size_t v = vertices[i];
    if (result.freedom[v] == Freedom::fixed) continue;
    result.freedom[v] = Freedom::curve;
    result.curve[v] = static_cast<int>(result.curves.size());
    result.segment[v] = static_cast<int>(i);
  }
  result.curves.push_back(make_curve(points(Eigen::all, vertices), closed));
}

/// Adds a loop of vertices, cut into curves at its corners and at `breaks`. Curves of one of the `junctions`
/// are left out.
void add_loop(const Mat3X& points, const std::vector<int>& loop, double cos_corner,
              const std::vector<char>& breaks, const std::vector<Edge>& junctions, Constraints& result) {
  const size_t n = loop.size();
  std::vector<size_t> corners;
  for (size_t i = 0; i < n; ++i)
    if (breaks[loop[i]] || is_corner(points, loop[(i + n - 1) % n], loop[i], loop[(i + 1) % n], cos_corner))
      corners.push_back(i);
  if (corners.empty()) return add_curve(points, loop, true, result);
  for (size_t i : corners) result.freedom[loop[i]] = Freedom::fixed;
  for (size_t p = 0; p < corners.size(); ++p) {
    const size_t begin = corners[p];
    const size_t length = (corners[(p + 1) % corners.size()] + n - begin - 1) % n + 2;
    std::vector<int> piece;
    for (size_t i = 0; i < length; ++i) piece.push_back(loop[(begin + i) % n]);
    const auto [low, high] = std::minmax(piece.front(), piece.back());
    if (piece.size() > 2 || !std::ranges::binary_search(junctions, Edge{low, high}))
      add_curve(points, piece, false, result);
  }
}

/// Traces the crease edges into curves from corner to corner.
class CreaseTracer {
 public:
  CreaseTracer(const Mat3X& points, const Adjacency& c, double cos_corner, const ConstraintOptions& options,
               Constraints& result)
      : points_(points),
        c_(c),
        options_(options),
        result_(result),
        breaks_(curve_breaks(points, c, cos_corner, options)),
        traced_(c.edges.size(), 0) {
    for (size_t e = 0; e < traced_.size() && !options.junction_edges.empty(); ++e) {
      const auto [low, high] = std::minmax(c.edges[e][0], c.edges[e][1]);
      traced_[e] = std::ranges::binary_search(options.junction_edges, Edge{low, high});
    }
  }

  void run() {
    for (size_t v = 0; v < breaks_.size(); ++v)
      if (breaks_[v]) result_.freedom[v] = Freedom::fixed;
    for (const bool at_corners : {true, false})  // only loops without a corner are left for the second pass
      for (size_t v = 0; v < breaks_.size(); ++v)
        if (!at_corners || breaks_[v])
          for (int e : c_.vertex_edges[static_cast<int>(v)])
            if (c_.is_crease(e) && !traced_[e]) trace(static_cast<int>(v), e);
  }

  /// Marks the vertices where curves end because of creases, or as they are frozen.
  static std::vector<char> curve_breaks(const Mat3X& points, const Adjacency& c, double cos_corner,
                                        const ConstraintOptions& options) {
    std::vector<char> breaks(c.vertex_count, 0);
    for (int v : options.frozen_vertices) breaks[v] = 1;
    if (c.creases.empty()) return breaks;
    for (int v = 0; v < c.vertex_count; ++v) {
      std::vector<int> ends;
      bool boundary = false;
      for (int e : c.vertex_edges[v]) {
        if (c.is_crease(e)) ends.push_back(c.other_end(e, v));
        boundary |= c.is_boundary_edge(e);
      }
      if (ends.empty()) continue;
      breaks[v] |= boundary || ends.size() != 2 ||
                   (!(is_rounded({v, ends[0]}, options) && is_rounded({v, ends[1]}, options)) &&
                    is_corner(points, ends[0], v, ends[1], cos_corner));
    }
    return breaks;
  }

 private:
  void trace(int start, int edge) {
    std::vector<int> vertices = {start};
    while (edge >= 0) {
      traced_[edge] = 1;
      const Edge& ends = c_.edges[edge];
      const int v = ends[0] == vertices.back() ? ends[1] : ends[0];
      if (v == start && !breaks_[v]) return add_crease(vertices, true);
      vertices.push_back(v);
      edge = breaks_[v] ? -1 : next_at(v);
    }
    add_crease(vertices, false);
  }

  void add_crease(const std::vector<int>& vertices, bool closed) {
    add_curve(points_, vertices, closed, result_);
    ++result_.crease_curves;
    if (is_rounded({vertices[0], vertices[1]}, options_)) return;
    // Sliding past a bend of an even crease cuts it off and gains nothing.
    for (const int i : bends_of_even_curve(result_.curves.back(), options_.even_crease))
      result_.freedom[vertices[i]] = Freedom::fixed;
  }

  int next_at(int v) const {
    for (int e : c_.vertex_edges[v])
      if (c_.is_crease(e) && !traced_[e]) return e;
    return -1;
  }

  const Mat3X& points_;
  const Adjacency& c_;
  const ConstraintOptions& options_;
  Constraints& result_;
  std::vector<char> breaks_;
  std::vector<char> traced_;
};

void add_boundary(const Mat3X& points, const Adjacency& c, const ConstraintOptions& options,
                  double cos_corner, Constraints& result) {
  const std::vector<int> next = boundary_successors(c);
  std::vector<char> breaks = CreaseTracer::curve_breaks(points, c, cos_corner, options);
  for (const Edge& edge : options.junction_edges)
    for (int v : edge) breaks[v] = 1;
  std::vector<bool> seen(next.size(), false);
  for (size_t start = 0; start < next.size(); ++start) {
    if (next[start] < 0 || seen[start]) continue;
    std::vector<int> loop;
    for (int v = static_cast<int>(start); !seen[v]; v = next[v]) {
      seen[v] = true;
      loop.push_back(v);
    }
    if (options.boundary == BoundaryRule::fixed)
      for (int v : loop) result.freedom[v] = Freedom::fixed;
    else
      add_loop(points, loop, cos_corner, breaks, options.junction_edges, result);
  }
}

}  // namespace

Constraints find_constraints(const Mat3X& points, const Adjacency& c, const ConstraintOptions& options) {
  Constraints result;
  const size_t n = c.vertex_count;
  result.freedom.assign(n, Freedom::surface);
  result.curve.assign(n, -1);
  result.segment.assign(n, 0);
  for (size_t v = 0; v < n; ++v)
    if (c.vertex_faces[static_cast<int>(v)].empty()) result.freedom[v] = Freedom::fixed;
  for (int v : options.fixed_vertices) result.freedom[v] = Freedom::fixed;
  if (!options.frozen_vertices.empty()) result.frozen.assign(n, 0);
  for (int v : options.frozen_vertices) {
    result.freedom[v] = Freedom::fixed;
    result.frozen[v] = 1;
  }

  for (int v : coincident_boundary_vertices(points, c)) result.freedom[v] = Freedom::fixed;

  const double cos_corner = std::cos(options.corner_angle * std::numbers::pi / 180);
  if (options.boundary != BoundaryRule::free) add_boundary(points, c, options, cos_corner, result);
  if (!c.creases.empty()) CreaseTracer(points, c, cos_corner, options, result).run();
  result.creases = crease_edges(c);
  result.extra_wedges = c.extra_wedges;
  return result;
}

std::vector<int> corner_valences(const Mat3X& points, const Adjacency& c, const Constraints& constraints) {
  std::vector<int> feature_edge_count(c.vertex_count, 0);
  for (size_t e = 0; e < c.edges.size(); ++e)
    if (c.is_feature_edge(static_cast<int>(e)))
      for (int v : c.edges[e]) ++feature_edge_count[v];
  const auto is_corner = [&](int v) {
    return feature_edge_count[v] >= 2 && constraints.is_fixed(v) && !constraints.slides_with_copies(v);
  };
  std::vector<double> angles(c.wedge_count(), 0);  // degrees
  for (size_t f = 0; f < c.faces.size(); ++f) {
    const Triangle& t = c.faces[f];
    for (size_t k = 0; k < 3; ++k) {
      if (!is_corner(t[k])) continue;
      const Vec3 a = points.col(t[(k + 1) % 3]) - points.col(t[k]);
      const Vec3 b = points.col(t[(k + 2) % 3]) - points.col(t[k]);
      angles[c.wedges_of_faces()[f][k]] += angle_between(a, b);
    }
  }
  std::vector<int> target(angles.size(), 0);
  for (size_t wedge = 0; wedge < angles.size(); ++wedge)
    if (angles[wedge] > 0 && std::abs(180 - angles[wedge]) >= ConstraintOptions::corner_angle)
      target[wedge] = 1 + std::max(1, static_cast<int>(std::lround(angles[wedge] / 60)));
  return target;
}

}  // namespace hooke
