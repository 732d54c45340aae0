// Resolves the raw option texts of the command line to settings.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "options.h"

namespace hooke::app {

/// A shell that completes command lines.
enum class Shell { bash, zsh, fish };

/// Options as given on the command line, not yet interpreted.
struct RawOptions {
  std::string tolerance = "0.1%";
  std::string gradation;
  std::string listing;  // form of --list-metrics
  std::optional<std::string> feature_angle;
  std::optional<std::string> keep;
  std::optional<std::string> max_distance, drop_components, fill_holes;
  std::optional<double> rho, altitude;
  std::optional<OffsetUnit> rho_unit;
  std::optional<Refit> refit;
  std::optional<int> max_outer, max_steps;
  std::optional<BoundaryRule> boundary;
  bool print_config = false;
  std::optional<Shell> completion;
  bool man_page = false;
  std::function<bool(const char*)> given;  // whether it was; a flag that is off was not
};

/// Interprets the raw options, completes the settings and checks that they are consistent. Throws Error that
/// names the option.
void resolve(Settings& settings, const RawOptions& raw);

}  // namespace hooke::app
