#include "hooke/sizing.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "hooke/error.h"
#include "hooke/parallel.h"

namespace hooke {

double total_area(const Mat3X& points, const std::vector<Triangle>& faces) {
  return parallel_sum(faces.size(), 4096, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t f = begin; f < end; ++f) {
      const Vec3 a = points.col(faces[f][0]);
      sum += .5 * (points.col(faces[f][1]) - a).cross(points.col(faces[f][2]) - a).norm();
    }
    return sum;
  });
}

double natural_length(double area, std::size_t face_count) {
  return std::sqrt(4 * area / (std::sqrt(3.) * static_cast<double>(face_count)));
}

LengthSpec parse_length(const std::string& text) {
  if (text == "auto") return {};
  if (text == "mean") return {LengthSpec::Kind::mean, 0};
  LengthSpec spec{LengthSpec::Kind::absolute, 0};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, spec.value);
  const std::string_view unit(rest, end);
  if (unit == "%") spec.kind = LengthSpec::Kind::percent_of_diagonal;
  if (unit == "x") spec.kind = LengthSpec::Kind::times_natural;
  const bool known = unit.empty() || unit == "%" || unit == "x";
  if (error != std::errc() || !known || !(spec.value > 0) || !std::isfinite(spec.value))
    throw Error(
        fmt::format("length '{}'; expected auto, mean, or a positive number, alone or with % or x", text));
  return spec;
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
    case LengthSpec::Kind::percent_of_diagonal: {
      const Vec3 box = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
      return spec.value / 100 * box.stableNorm();
    }
    case LengthSpec::Kind::mean:
      break;
  }
  double sum = 0;
  for (const auto& [a, b] : c.edges) sum += (points.col(b) - points.col(a)).norm();
  return sum / static_cast<double>(c.edges.size());
}

TargetLengths spread_target_lengths(const Connectivity& c, const std::vector<double>& vertex_length) {
  TargetLengths targets;
  targets.edge.reserve(c.edges.size());
  for (const auto& [a, b] : c.edges)
    targets.edge.push_back(.5 *
                           (vertex_length[static_cast<size_t>(a)] + vertex_length[static_cast<size_t>(b)]));
  targets.face.reserve(c.faces.size());
  for (const auto& edges : c.face_edges) {
    double sum = 0;
    for (int e : edges) sum += targets.edge[static_cast<size_t>(e)];
    targets.face.push_back(sum / 3);
  }
  return targets;
}

}  // namespace hooke
