#include "hooke/springs/sizing.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <queue>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/curvature.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/junctions.h"
#include "hooke/springs/rest_ratios.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {
namespace {

SizingSource parse_curvature(std::string_view error) {
  SizingSource source{.kind = SizingSource::Kind::curvature, .name = {}};
  const char* const end = error.data() + error.size();
  const auto [rest, failed] = std::from_chars(error.data(), end, source.chord_error);
  const std::string_view unit(rest, end);
  source.percent = unit == "%";
  if (failed != std::errc() || !(unit.empty() || source.percent) || !(source.chord_error > 0) ||
      !std::isfinite(source.chord_error))
    throw Error(
        fmt::format("curvature: chord error {}; expected a positive number, alone or with %; for instance "
                    "curvature:0.1%",
                    in_quotes(error)));
  return source;
}

/// Finds the factor for which measure(factor), an increasing function, equals the goal, by the secant method
/// in logarithms. The last call of `measure` is with that factor.
template <typename Measure>
void scale_to(double goal, double factor, const Measure& measure) {
  constexpr int tries = 20;
  constexpr double close = 1e-6;
  double slope = 1;  // d log(measure) / d log(factor): below 1 where the gradation limits lengths
  double reached = measure(factor);
  for (int i = 0; i < tries && std::abs(reached / goal - 1) > close; ++i) {
    const double next = factor * std::pow(goal / reached, 1 / slope);
    const double after = measure(next);
    slope = std::clamp(std::log(after / reached) / std::log(next / factor), .05, 1.);
    factor = next;
    reached = after;
  }
}

}  // namespace

LengthSpec parse_length(const std::string& text) {
  if (text == "auto") return {};
  if (text == "mean") return {LengthSpec::Kind::mean, 0};
  if (text == "sizing") return {LengthSpec::Kind::as_given, 0};
  LengthSpec spec{LengthSpec::Kind::absolute, 0};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, spec.value);
  const std::string_view unit(rest, end);
  if (unit == "%") spec.kind = LengthSpec::Kind::percent_of_diagonal;
  if (unit == "x") spec.kind = LengthSpec::Kind::times_natural;
  const bool known = unit.empty() || unit == "%" || unit == "x";
  if (error != std::errc() || !known || !(spec.value > 0) || !std::isfinite(spec.value))
    throw Error(
        fmt::format("'{}'; expected auto, mean, sizing, or a positive number, alone or with % or x", text));
  return spec;
}

double resolve_length(const LengthSpec& spec, const Mat3X& points, const Adjacency& c) {
  const double natural = natural_length(total_area(points, c.faces), c.faces.size());
  switch (spec.kind) {
    case LengthSpec::Kind::natural:
      return natural;
    case LengthSpec::Kind::times_natural:
      return spec.value * natural;
    case LengthSpec::Kind::absolute:
      return spec.value;
    case LengthSpec::Kind::percent_of_diagonal:
      return spec.value / 100 * box_of_faces(points, c.faces).diagonal().norm();
    case LengthSpec::Kind::as_given:
      throw Error("length 'sizing' without a sizing; expected one; name it, or another length");
    case LengthSpec::Kind::mean:
      break;
  }
  double sum = 0;
  for (const auto& [a, b] : c.edges) sum += (points.col(b) - points.col(a)).norm();
  return sum / static_cast<double>(c.edges.size());
}

SizingSource parse_sizing(const std::string& text) {
  const std::string curvature = "curvature", ply = "ply:";
  if (text == "input") return {.kind = SizingSource::Kind::input, .name = {}};
  if (text == curvature) return {.kind = SizingSource::Kind::curvature, .name = {}};
  if (text.starts_with(curvature + ":"))
    return parse_curvature(std::string_view(text).substr(curvature.size() + 1));
  const bool is_property = text.starts_with(ply);
  const std::string name = is_property ? text.substr(ply.size()) : text;
  if (name.empty())
    throw Error(fmt::format("{}; expected FILE, ply:PROPERTY, curvature[:ERROR] or input", in_quotes(text)));
  return {.kind = is_property ? SizingSource::Kind::ply_property : SizingSource::Kind::file, .name = name};
}

std::vector<double> resolve_vertex_lengths(const LengthSpec& spec, const Sizing& sizing, const Mat3X& points,
                                           const Adjacency& c, const std::vector<int>& joined) {
  const bool by_area = spec.kind == LengthSpec::Kind::natural || spec.kind == LengthSpec::Kind::times_natural;
  std::vector<double> lengths = sizing.vertex_length;
  if (lengths.empty()) {
    const double length = resolve_length(spec, points, c);
    if (!by_area) return std::vector<double>(c.vertex_count, length);
    lengths = natural_lengths_of_parts(points, c, joined).values();
    const double times = spec.kind == LengthSpec::Kind::natural ? 1 : spec.value;
    for (double& l : lengths)
      l = spec.whose == LengthSpec::Natural::shorter ? std::min(times * l, length) : times * l;
    return lengths;
  }
  if (spec.kind == LengthSpec::Kind::as_given) {
    limit_gradation(points, c, sizing.gradation, lengths);
    return lengths;
  }
  const auto size_of = [&](const TargetLengths& t) {
    return by_area ? covering_length(points, c, t) : mean_length(points, c, t);
  };
  // Relative to the maximum, so that equal lengths become exactly 1.
  const double greatest = *std::ranges::max_element(lengths);
  for (double& l : lengths) l /= greatest;
  const std::vector<double> shares = lengths;
  const double goal = resolve_length(spec, points, c);
  scale_to(goal, goal / size_of(spread_target_lengths(c, shares)), [&](double factor) {
    std::ranges::transform(shares, lengths.begin(), [&](double share) { return factor * share; });
    limit_gradation(points, c, sizing.gradation, lengths);
    return size_of(spread_target_lengths(c, lengths));
  });
  return lengths;
}

std::vector<double> curvature_lengths(const Mat3X& points, const Adjacency& c, double chord_error,
                                      double longest) {
  std::vector<double> lengths = largest_curvatures(points, c);
  for (double& l : lengths) {
    const double radius = std::max(1 / l, chord_error);  // infinite where the surface is flat
    l = std::min(std::sqrt((8 * radius - 4 * chord_error) * chord_error), longest);
  }
  return lengths;
}

void limit_gradation(const Mat3X& points, const Adjacency& c, double slope, std::vector<double>& length) {
  if (std::isinf(slope)) return;
  const auto at = [&](int v) -> double& { return length[v]; };
  const auto limit = [&](int from, int to) {
    return at(from) + slope * (points.col(to) - points.col(from)).norm();
  };
  // Smallest first, as in Dijkstra's algorithm: a length is final when its vertex leaves the queue.
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (const auto& [a, b] : c.edges) {
    if (at(b) > limit(a, b)) queue.emplace(at(a), a);
    if (at(a) > limit(b, a)) queue.emplace(at(b), b);
  }
  while (!queue.empty()) {
    const auto [l, v] = queue.top();
    queue.pop();
    if (l > at(v)) continue;
    for (int w : c.vertex_neighbours[v])
      if (const double most = limit(v, w); at(w) > most) {
        at(w) = most;
        queue.emplace(most, w);
      }
  }
}

void set_target_lengths(TriMesh& mesh, const MemoryOrder& memory_order, const LengthSpec& spec,
                        Sizing sizing) {
  const Permutation& order = memory_order.order;
  if (!sizing.vertex_length.empty()) sizing.vertex_length = order.gather(sizing.vertex_length);
  const std::vector<double> lengths = resolve_vertex_lengths(
      spec, sizing, order.gather(vertex_points(mesh)), *memory_order.adjacency, joined_vertices(mesh, order));
  set_vertex_values(mesh, target_length_property, order.scatter(lengths));
}

TargetLengths target_lengths_of(const TriMesh& mesh, const Permutation& order, const Adjacency& adjacency) {
  std::vector<double> of_edges = edge_values(mesh, edge_length_property, order, adjacency);
  if (!of_edges.empty()) return from_edge_lengths(adjacency, std::move(of_edges));
  TargetLengths targets =
      spread_target_lengths(adjacency, order.gather(vertex_values(mesh, target_length_property)));
  const std::vector<double> ratios = edge_values(mesh, rest_ratio_property, order, adjacency);
  return ratios.empty() ? targets : at_rest_ratios(adjacency, targets, ratios);
}

std::vector<double> input_lengths(const Mat3X& points, const Adjacency& c) {
  constexpr double shortest = 1e-3;
  const double least = shortest * natural_length(total_area(points, c.faces), c.faces.size());
  std::vector<double> area(c.vertex_count, 0);
  std::vector<std::size_t> count(c.vertex_count, 0);
  for (const Triangle& t : c.faces) {
    const double of_face = face_shape(points, t).area;
    for (int v : t) {
      area[v] += of_face;
      ++count[v];
    }
  }
  std::vector<double> lengths(c.vertex_count);
  for (int v = 0; v < c.vertex_count; ++v)
    lengths[v] = count[v] > 0 ? std::max(natural_length(area[v], count[v]), least) : least;
  return lengths;
}

}  // namespace hooke
