#include "hooke/springs/target_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/mesh/curvature.h"
#include "hooke/springs/sizing.h"

namespace hooke {

namespace {

constexpr size_t block = 4096;

double face_area(const Mat3X& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]);
  return .5 * (points.col(t[1]) - a).cross(points.col(t[2]) - a).norm();
}

}  // namespace

double total_area(const Mat3X& points, const std::vector<Triangle>& faces) {
  return parallel_sum(faces.size(), block, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t f = begin; f < end; ++f) sum += face_area(points, faces[f]);
    return sum;
  });
}

double natural_length(double area, std::size_t face_count) {
  return std::sqrt(4 * area / (std::sqrt(3.) * static_cast<double>(face_count)));
}

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

double box_diagonal(const Mat3X& points) {
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).stableNorm();
}

double resolve_length(const LengthSpec& spec, const Mat3X& points, const Connectivity& c) {
  const double natural = natural_length(total_area(points, c.faces), c.faces.size());
  switch (spec.kind) {
    case LengthSpec::Kind::natural:
      return natural;
    case LengthSpec::Kind::times_natural:
      return spec.value * natural;
    case LengthSpec::Kind::absolute:
      return spec.value;
    case LengthSpec::Kind::percent_of_diagonal:
      return spec.value / 100 * box_diagonal(points);
    case LengthSpec::Kind::as_given:
      throw Error("length 'sizing' without a sizing; expected one; name it, or another length");
    case LengthSpec::Kind::mean:
      break;
  }
  double sum = 0;
  for (const auto& [a, b] : c.edges) sum += (points.col(b) - points.col(a)).norm();
  return sum / static_cast<double>(c.edges.size());
}

namespace {

/// Finds the factor for which measure(factor), which grows with it, is the goal, by secants in logarithms.
/// The last call of `measure` is with that factor.
template <typename Measure>
void scale_to(double goal, double factor, const Measure& measure) {
  constexpr int tries = 20;
  constexpr double close = 1e-6;
  double slope = 1;  // d log(measure) / d log(factor): less where a limit holds lengths back
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

std::vector<double> resolve_vertex_lengths(const LengthSpec& spec, const Sizing& sizing, const Mat3X& points,
                                           const Connectivity& c) {
  std::vector<double> lengths = sizing.vertex_length;
  if (lengths.empty()) {
    lengths.assign(static_cast<size_t>(c.vertex_count), resolve_length(spec, points, c));
    return lengths;
  }
  if (spec.kind == LengthSpec::Kind::as_given) {
    limit_gradation(points, c, sizing.gradation, lengths);
    return lengths;
  }
  const bool by_area = spec.kind == LengthSpec::Kind::natural || spec.kind == LengthSpec::Kind::times_natural;
  const auto size_of = [&](const TargetLengths& t) {
    return by_area ? covering_length(points, c, t) : mean_length(points, c, t);
  };
  // Over the greatest, so that equal lengths become exactly 1.
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

double covering_length(const Mat3X& points, const Connectivity& c, const TargetLengths& targets) {
  if (!targets.face.vary()) return targets.face[0];
  const auto sum = [&](const auto& weight) {
    return parallel_sum(c.faces.size(), block, [&](size_t begin, size_t end) {
      double part = 0;
      for (size_t f = begin; f < end; ++f) part += weight(f) * face_area(points, c.faces[f]);
      return part;
    });
  };
  return std::sqrt(sum([](size_t) { return 1.; }) /
                   sum([&](size_t f) { return 1 / (targets.face[f] * targets.face[f]); }));
}

double mean_length(const Mat3X& points, const Connectivity& c, const TargetLengths& targets) {
  const double first = targets.edge[0];
  if (!targets.edge.vary()) return first;
  const auto sum = [&](const auto& value) {
    return parallel_sum(c.faces.size(), block, [&](size_t begin, size_t end) {
      double part = 0;
      for (size_t f = begin; f < end; ++f) {
        double of_edges = 0;
        for (int e : c.face_edges[f]) of_edges += value(targets.edge[static_cast<size_t>(e)]);
        part += of_edges * face_area(points, c.faces[f]);
      }
      return part;
    });
  };
  return first +
         sum([&](double l) { return (l - first) / (l * l); }) / sum([](double l) { return 1 / (l * l); });
}

std::vector<double> curvature_lengths(const Mat3X& points, const Connectivity& c, double chord_error,
                                      double longest) {
  std::vector<double> lengths = largest_curvatures(points, c);
  for (double& l : lengths) {
    const double radius = std::max(1 / l, chord_error);  // infinite where it is flat
    l = std::min(std::sqrt((8 * radius - 4 * chord_error) * chord_error), longest);
  }
  return lengths;
}

TargetLengths spread_target_lengths(const Connectivity& c, const std::vector<double>& vertex_length) {
  const auto mean_of_three = [](double a, double b, double d) { return (a + b + d) / 3; };
  if (!c.faces.empty() && Lengths::are_equal(vertex_length)) {
    const double length = vertex_length[0];
    return {Lengths(c.edges.size(), length), Lengths(c.faces.size(), mean_of_three(length, length, length))};
  }
  std::vector<double> edge(c.edges.size()), face(c.faces.size());
  parallel_for(c.edges.size(), block, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      const auto& [a, b] = c.edges[e];
      edge[e] = .5 * (vertex_length[static_cast<size_t>(a)] + vertex_length[static_cast<size_t>(b)]);
    }
  });
  parallel_for(c.faces.size(), block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const auto& [a, b, d] = c.face_edges[f];
      face[f] = mean_of_three(edge[static_cast<size_t>(a)], edge[static_cast<size_t>(b)],
                              edge[static_cast<size_t>(d)]);
    }
  });
  return {std::move(edge), std::move(face)};
}

}  // namespace hooke
