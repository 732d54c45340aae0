// Gates: conditions on numbers of the report, such as "after.min_angle.min >= 20", for pipelines.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hooke {

/// A number of the report and what it must be.
struct Gate {
  std::string text;      // as it was given
  std::string metric;    // keys of the report with dots between them, and indices of lists, from 0
  std::string relation;  // one of >=, <=, ==, !=, > and <
  double bound = 0;      // finite
};

/// What became of a gate.
struct GateOutcome {
  std::string condition;
  std::optional<double> value;  // empty where the report has null or no such key; the gate then fails
  bool passed = false;
};

/// Parses "METRIC RELATION NUMBER". Throws an Error whose message begins with the text.
Gate parse_gate(const std::string& text);

/// The number of the report that a metric names; yes and no are 1 and 0, null is empty. Throws Error for a
/// key that the report does not have, and for what is not a number.
std::optional<double> metric_of(const nlohmann::ordered_json& report, const std::string& metric);

/// Throws Error for gates on the blocks `before` and `after` of a report whose numbers such a block does not
/// have: to be called before the work that they are to judge.
void require_metrics(const std::vector<Gate>& gates, const nlohmann::ordered_json& block);

/// The outcomes of the gates, in order. Throws what metric_of() throws.
std::vector<GateOutcome> judge_gates(const std::vector<Gate>& gates, const nlohmann::ordered_json& report);

}  // namespace hooke
