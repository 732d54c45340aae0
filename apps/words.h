// What the user said in words, and what it means.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "options.h"

namespace hooke::app {

/// What was said, before it is given its meaning.
struct RawOptions {
  std::string tolerance = "0.1%";
  std::string gradation;
  std::optional<std::string> feature_angle;
  std::optional<double> rho;
  std::optional<int> max_outer, max_steps;
  std::optional<BoundaryRule> boundary;
  std::function<bool(const char*)> given;  // was this option said?
};

/// Gives the words their meaning and checks what belongs together. Throws Error that names the option.
void resolve(Settings& settings, const RawOptions& raw);

}  // namespace hooke::app
