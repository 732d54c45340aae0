#include "hooke/report/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace hooke {
namespace {

constexpr double fair = 30;  // degrees

/// What holds the worst face, the first of its reasons that has words; empty without one.
std::string held_by(const Quality& q) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 7> words{{
      {"corner", "a sharp corner of the input"},
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

}  // namespace hooke
