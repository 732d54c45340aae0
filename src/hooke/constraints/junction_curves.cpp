#include "hooke/constraints/junction_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "hooke/core/lists.h"

namespace hooke {
namespace {

class JunctionTracer {
 public:
  JunctionTracer(const Mat3X& points, const Adjacency& c, const ConstraintOptions& options,
                 Constraints& result)
      : points_(points),
        c_(c),
        options_(options),
        result_(result),
        is_through_(result.junction_vertices.size()),
        segments_(result.junction_vertices.size(), 0) {
    std::vector<Edge> ends;
    for (const JunctionEdge& edge : result.junction_edges) ends.push_back(edge.ends);
    edges_at_ = inverse(static_cast<int>(is_through_.size()), ends);
    for (int n = 0; n < numbers(); ++n) is_through_[n] = edges_at_[n].size() == 2;
  }

  void run(const std::vector<int>& held) {
    for (const int v : held) end_at(v);
    end_where_others_are();
    for (int v = 0; v < c_.vertex_count; ++v)
      if (!passes(v)) end_at(v);
    const double cos_corner = std::cos(options_.corner_angle * std::numbers::pi / 180);
    for (int n = 0; n < numbers(); ++n)
      if (is_through_[n]) is_through_[n] = !turns_at(n, cos_corner);
    for (const bool at_ends : {true, false})  // only loops without an end are left for the second pass
      for (int n = 0; n < numbers(); ++n)
        if (!at_ends || !is_through_[n])
          for (const int e : edges_at_[n])
            if (result_.junction_edges[e].curve < 0) trace(n, e);
    for (std::size_t v = 0; v < result_.junction.size(); ++v)
      if (const int n = result_.junction[v]; n >= 0) result_.segment[v] = segments_[n];
  }

 private:
  int numbers() const { return static_cast<int>(is_through_.size()); }

  void end_at(int vertex) {
    if (const int n = result_.junction[vertex]; n >= 0) is_through_[n] = 0;
  }

  int other_end(int edge, int number) const {
    const Edge& ends = result_.junction_edges[edge].ends;
    return ends[0] == number ? ends[1] : ends[0];
  }

  /// Are the feature edges of the vertex the two edges of its junction?
  bool passes(int v) const {
    const int n = result_.junction[v];
    if (n < 0 || !is_through_[n]) return false;
    std::array<int, 2> met = {0, 0};
    for (const int e : c_.vertex_edges[v]) {
      if (!c_.is_feature_edge(e)) continue;
      const int w = result_.junction[c_.other_end(e, v)];
      std::size_t k = 0;
      while (k < 2 && w != other_end(edges_at_[n][k], n)) ++k;
      if (k == 2) return false;
      ++met[k];
    }
    return met == std::array<int, 2>{1, 1};
  }

  /// Boundary vertices in the same place that are not one vertex would part.
  void end_where_others_are() {
    std::map<std::array<double, 3>, int> first;
    for (const int v : coincident_boundary_vertices(points_, c_)) {
      const auto [at, is_first] = first.try_emplace({points_(0, v), points_(1, v), points_(2, v)}, v);
      if (is_first || (result_.junction[v] >= 0 && result_.junction[v] == result_.junction[at->second]))
        continue;
      end_at(v);
      end_at(at->second);
    }
  }

  bool turns_at(int n, double cosine) const {
    return turns(points_.col(other_end(edges_at_[n][0], n)), points_.col(n),
                 points_.col(other_end(edges_at_[n][1], n)), cosine);
  }

  void trace(int start, int edge) {
    const int curve = static_cast<int>(result_.junction_curves.size());
    std::vector<int> vertices = {start};
    bool closed = false;
    for (int at = start; edge >= 0;) {
      result_.junction_edges[edge].curve = curve;
      at = other_end(edge, at);
      closed = at == start && is_through_[start];
      if (!closed) vertices.push_back(at);
      const auto edges = edges_at_[at];
      edge = closed || !is_through_[at] ? -1 : edges[edges[0] == edge ? 1 : 0];
    }
    result_.junction_curves.push_back(make_curve(points_(Eigen::all, vertices), closed));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const int n = vertices[i];
      if (!is_through_[n]) continue;
      result_.junction_vertices[n] = {curve, true};
      segments_[n] = static_cast<int>(i);
    }
    for (const int i : bends_of_even_curve(result_.junction_curves.back(), options_.even_crease))
      result_.junction_vertices[vertices[i]].slides = false;
  }

  const Mat3X& points_;
  const Adjacency& c_;
  const ConstraintOptions& options_;
  Constraints& result_;
  IntLists edges_at_;             // by number
  std::vector<char> is_through_;  // by number: does its curve go on there?
  std::vector<int> segments_;     // by number
};

}  // namespace

void constrain_junctions(const Mat3X& points, const Adjacency& c, const Junctions& junctions,
                         const std::vector<int>& joined, const std::vector<int>& held,
                         const ConstraintOptions& options, Constraints& result) {
  if (junctions.vertices.empty()) return;
  result.junction.assign(joined.size(), -1);
  for (const int v : junctions.vertices) result.junction[v] = joined[v];
  result.junction_vertices.resize(joined.size());
  std::vector<Edge> edges;
  for (const auto& [a, b] : junctions.edges)
    edges.push_back({std::min(joined[a], joined[b]), std::max(joined[a], joined[b])});
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const Edge& ends : edges) result.junction_edges.push_back({ends, -1});
  JunctionTracer(points, c, options, result).run(held);
}

IntLists copies_of_junctions(const Constraints& constraints) {
  std::vector<std::array<int, 1>> numbers(constraints.junction.size());
  for (std::size_t v = 0; v < numbers.size(); ++v) numbers[v] = {constraints.junction[v]};
  return inverse(static_cast<int>(constraints.junction_vertices.size()), numbers);
}

std::vector<int> first_sliding_copies(const Constraints& constraints) {
  std::vector<int> first(constraints.junction.size()), known(constraints.junction_vertices.size(), -1);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const int v = static_cast<int>(i);
    first[i] = v;
    if (!constraints.slides_with_copies(v)) continue;
    int& of_number = known[constraints.junction[i]];
    if (of_number < 0) of_number = v;
    first[i] = of_number;
  }
  return first;
}

void add_sliding_copies(const Constraints& constraints, const IntLists& copies, std::vector<int>& vertices) {
  const std::size_t count = vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!constraints.slides_with_copies(vertices[i])) continue;
    const auto all = copies[constraints.junction[vertices[i]]];
    vertices.insert(vertices.end(), all.begin(), all.end());
  }
  if (vertices.size() == count) return;
  sort_unique(vertices);
}

}  // namespace hooke
