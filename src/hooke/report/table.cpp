#include "hooke/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "hooke/measure/polygon_angles.h"

namespace hooke {
namespace {

std::string text(double x) {
  return std::isfinite(x) ? fmt::format("{:.5g}", x) : "-";
}
std::string text(std::optional<double> x) {
  return x ? text(*x) : "-";
}
std::string text(size_t n) {
  return fmt::format("{}", n);
}
std::string text(std::optional<size_t> n) {
  return n ? text(*n) : "-";
}

/// Root mean square; NaN if there are no values.
double rms(const Statistics& s) {
  return std::hypot(s.mean, s.std);
}

struct Row {
  const char* name;
  std::string value;
};

std::vector<Row> rows_of(const Quality& q) {
  return {
      {"minimum angle (deg)", text(q.min_angle.min)},
      {"  5th percentile", text(q.min_angle.p05)},
      {"  median", text(q.min_angle.median)},
      {"  faces below 20", text(q.faces_below_20)},
      {"  faces below 30", text(q.faces_below_30)},
      {"maximum angle (deg)", text(q.max_angle.max)},
      {"edge length, mean", text(q.edge_length.mean)},
      {"  standard deviation", text(q.edge_length.std)},
      {"  std / mean", text(q.edge_length.std / q.edge_length.mean)},
      {"length error, rms", text(rms(q.length_error))},
      {"shape, minimum", text(q.shape.min)},
      {"  mean", text(q.shape.mean)},
      {"folded edges", text(q.folded_edges)},
      {"self-intersections", text(q.self_intersections)},
      {"degenerate faces", text(q.degenerate_faces)},
      {"angles, 0 to 60 deg", text_histogram(q.min_angle.histogram)},
  };
}

std::vector<Row> rows_of(const std::optional<PolygonAngles>& angles) {
  const auto degrees = [&](double PolygonAngles::*figure) { return angles ? text((*angles).*figure) : "-"; };
  return {{"polygons, least angle", degrees(&PolygonAngles::min)},
          {"  greatest angle", degrees(&PolygonAngles::max)},
          {"  rms from regular", degrees(&PolygonAngles::rms_deviation)}};
}

std::string deviation_rows(const Deviation& d) {
  const auto share = [&](double x) {
    return fmt::format("{} % of the diagonal", text(100 * x / d.diagonal));
  };
  const auto row = [](const char* name, const std::string& value, const std::string& note) {
    return fmt::format("{:<24}{:>12}{}{}\n", name, value, note.empty() ? "" : "    ", note);
  };
  std::string out = "\n";
  const auto moved = d.displacement;
  out += row("maximum displacement", text(moved ? std::optional(moved->max) : std::nullopt),
             moved ? share(moved->max) : "");
  out += row("distance to the input", text(d.to_reference.max), share(d.to_reference.max));
  out += row("distance from the input", text(d.from_reference.max), share(d.from_reference.max));
  if (d.boundary_to_reference && d.boundary_from_reference) {
    const double boundary = std::max(*d.boundary_to_reference, *d.boundary_from_reference);
    out += row("distance of the boundary", text(boundary), share(boundary));
  }
  if (d.volume_change) out += row("change of the volume", text(100 * *d.volume_change), "%");
  out += row("flipped faces", text(d.flipped_faces.size()), "");
  return out;
}

}  // namespace

std::string text_histogram(const Histogram& histogram) {
  static constexpr const char* blocks[] = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  size_t fullest = 0;
  for (size_t n : histogram.counts) fullest = std::max(fullest, n);
  std::string out;
  for (size_t n : histogram.counts) out += blocks[n == 0 ? 0 : (8 * n + fullest - 1) / fullest];
  return out;
}

std::string quality_table(const Quality& mesh) {
  std::string out;
  const auto add = [&](const std::vector<Row>& rows) {
    for (const Row& row : rows) out += fmt::format("{:<24}{:>20}\n", row.name, row.value);
  };
  add(rows_of(mesh));
  if (mesh.polygon_angles) add(rows_of(mesh.polygon_angles));
  return out;
}

std::string quality_table(const Quality& before, const Quality& after, const Deviation& deviation) {
  std::string out = fmt::format("{:<24}{:>20}    {:>20}\n", "", "before", "after");
  const auto add = [&](const std::vector<Row>& left, const std::vector<Row>& right) {
    for (size_t k = 0; k < left.size(); ++k)
      out += fmt::format("{:<24}{:>20}    {:>20}\n", left[k].name, left[k].value, right[k].value);
  };
  add(rows_of(before), rows_of(after));
  if (before.polygon_angles) add(rows_of(before.polygon_angles), rows_of(after.polygon_angles));
  return out + deviation_rows(deviation);
}

}  // namespace hooke
