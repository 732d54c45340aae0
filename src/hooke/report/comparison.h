// Comparison of a report with an older one: which figures got worse, by the direction that the table of keys
// gives them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hooke {

/// What a comparison needs of a report.
struct ReportFigures {
  std::string input_sha256;         // empty for a mesh that came from no file
  std::string connectivity_sha256;  // of the input
  bool has_result = false;
  double diagonal = 0;                                  // of the input's bounding box
  std::map<std::string, std::string> parameters;        // as JSON text
  std::vector<std::pair<std::string, double>> figures;  // those with a better direction, by path
};

/// The figures of a report. Throws Error for JSON that is no report of this schema.
ReportFigures figures_of(const nlohmann::ordered_json& report);

/// A figure that got worse.
struct Worsening {
  std::string key;
  double base = 0;   // before
  double value = 0;  // now
};

/// What came of a comparison.
struct Comparison {
  std::string base;  // the file of the older report
  double rtol = 0;
  std::size_t compared = 0;  // number of figures
  std::vector<Worsening> worse;
  std::vector<std::string> not_comparable;  // in words
};

/// Compares the figures that both have: those of the results, or of the inputs if one of the reports is of
/// --check. A figure is worse if it went the wrong way by more than `rtol` times its old size, and by more
/// than rounding: 1e-9, of the diagonal for lengths.
Comparison compare(const ReportFigures& base, const ReportFigures& now, double rtol);

/// "after.min_angle.min: 27.8 -> 25.1 (9.7 % worse)".
std::string in_words(const Worsening& worsening);

}  // namespace hooke
