#include "hooke/report/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "hooke/measure/polygon_angles.h"

namespace hooke {
namespace {

constexpr double fair = 30;  // degrees

/// What holds the worst face, the first of its reasons that has words; empty without one.
std::string held_by(const Quality& q) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 7> words{{
      {"corner", "a corner of the input"},
      {"fixed", "fixed vertices"},
      {"crease", "a crease"},
      {"boundary", "the boundary"},
      {"put_back", "a vertex that is where it was, to keep the surface"},
      {"valence", "how many faces meet at a vertex"},
      {"guard", "the shape of the surface there"},
  }};
  if (q.worst_faces.empty()) return "";
  const auto& reasons = q.worst_faces.front().reasons;
  for (const auto& [reason, text] : words)
    if (std::ranges::find(reasons, reason) != reasons.end()) return text;
  return "";
}

/// Whether creases hold nearly all of the faces that are not fair.
bool is_held_by_creases(const Quality& q) {
  constexpr double nearly_all = .9;
  const auto is_bad = [](const WorstFace& face) { return face.min_angle < fair; };
  const auto is_held = [&](const WorstFace& face) {
    return is_bad(face) && std::ranges::find(face.reasons, "crease") != face.reasons.end();
  };
  const auto bad = static_cast<double>(std::ranges::count_if(q.worst_faces, is_bad)),
             held = static_cast<double>(std::ranges::count_if(q.worst_faces, is_held));
  return bad > 0 && held >= nearly_all * bad;
}

}  // namespace

bool is_rounding(double distance, const Deviation& deviation) {
  return distance <= 1e-11 * deviation.diagonal;
}

std::string outcome_in_words(const RunRecord& run) {
  const Quality &before = run.before, &after = *run.after;
  std::string text = fmt::format(
      "minimum angle {:.3g} -> {:.3g} degrees; {} of {} faces below 20 ({} before)", before.min_angle.min,
      after.min_angle.min, after.faces_below_20, after.topology.faces, before.faces_below_20);
  const std::string holder = held_by(after);
  if (after.min_angle.min < fair && !holder.empty()) text += "; the worst is held by " + holder;
  const double moved = std::max(run.deviation->to_reference.max, run.deviation->from_reference.max);
  if (is_rounding(moved, *run.deviation)) return text + "; the surface did not move";
  return text + fmt::format("; the surface moved by at most {:.2g} % of its size",
                            100 * moved / run.deviation->diagonal);
}

std::string advice_in_words(const RunRecord& run, ConnectivityMode mode) {
  if (run.after->min_angle.min >= fair) return "";
  switch (mode) {
    case ConnectivityMode::fixed:
      if (is_held_by_creases(*run.after))
        return "for better angles --connectivity adapt makes new vertices: creases hold nearly all of the "
               "worst faces";
      return "for better angles let edges change: --connectivity flip keeps the vertices, adapt makes new "
             "ones";
    case ConnectivityMode::flip:
      return "for better angles --connectivity adapt makes new vertices";
    case ConnectivityMode::adapt:
      return "";
  }
  return "";
}

// The table.

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
