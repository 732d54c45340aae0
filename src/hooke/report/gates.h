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
  std::optional<double> value;  // empty where the report has none; the gate then fails
  bool passed = false;
};

/// Parses "METRIC RELATION NUMBER"; true and false are 1 and 0. Throws an Error whose message begins with the
/// text.
Gate parse_gate(const std::string& text);

/// Throws Error for gates that no report could fulfil: on keys that the table of keys has not, with the
/// nearest one that it has, on what is no number, and, with `check_only`, on the result that --check has none
/// of.
void require_metrics(const std::vector<Gate>& gates, bool check_only);

/// The number at a path of the report; yes and no are 1 and 0. Empty for what is not there, null, or no
/// finite number.
std::optional<double> number_at(const nlohmann::ordered_json& report, const std::string& path);

/// The outcomes of the gates, in order.
std::vector<GateOutcome> judge_gates(const std::vector<Gate>& gates, const nlohmann::ordered_json& report);

}  // namespace hooke
