#include "target_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hooke/core/error.h"
#include "hooke/io/printable.h"
#include "result_warnings.h"

namespace hooke::app {
namespace {

/// Far from the natural length nothing sensible can come of it, and numbers overflow.
void require_reasonable(const Settings& s, double least, double most, double natural) {
  constexpr double limit = 1e6;
  if (least >= natural / limit && most <= limit * natural) return;
  const bool sized = s.sizing.kind != SizingSource::Kind::none;
  throw Error(
      fmt::format("{} '{}': target lengths from {:.3g} to {:.3g} for {}; expected {:.3g} to {:.3g}, {:.0e} "
                  "times less and more than the natural length",
                  sized ? "--sizing" : "--length", sized ? s.sizing_text : s.length_text, least, most,
                  printable(s.input.string()), natural / limit, limit * natural, limit));
}

}  // namespace

void set_target_lengths(const Settings& s, TriMesh& mesh, const Layout& layout, const Mat3X& points,
                        RunRecord& record) {
  const Connectivity& connectivity = *layout.connectivity;
  const Sizing sizing{read_sizing(s.sizing, s.input, points, layout), s.gradation};
  const std::vector<double> lengths = resolve_vertex_lengths(s.length, sizing, points, connectivity);
  const double natural = resolve_length({}, points, connectivity);
  const auto [least, most] = std::ranges::minmax_element(lengths);
  require_reasonable(s, *least, *most, natural);
  set_vertex_values(mesh, target_length_property, layout.order.in_old_order(lengths));

  const TargetLengths targets = spread_target_lengths(connectivity, lengths);
  record.parameters.update({{"L", mean_length(points, connectivity, targets)},
                            {"L_min", *least},
                            {"L_max", *most},
                            {"L_spec", printable(s.length_text)},
                            {"L_natural", natural},
                            {"sizing", printable(s.sizing_text)}});
  const bool limited = s.sizing.kind != SizingSource::Kind::none && std::isfinite(s.gradation);
  record.parameters["gradation"] = limited ? nlohmann::ordered_json(s.gradation) : nlohmann::ordered_json();
  if (!s.check && s.remesh.connectivity != ConnectivityMode::adapt)
    warn_of_length(s, covering_length(points, connectivity, targets), natural, record);
}

}  // namespace hooke::app
