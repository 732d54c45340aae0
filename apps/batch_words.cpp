#include "batch_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string_view>

#include "exit_codes.h"
#include "hooke/core/printable.h"

namespace hooke::app {

std::string failure_word(int exit_code) {
  switch (exit_code) {
    case usage:
      return "usage";
    case malformed_input:
      return "malformed_input";
    case unacceptable_mesh:
      return "unacceptable_mesh";
    case output_failed:
      return "output_failed";
    case numerical_failure:
      return "numerical_failure";
    case limit_reached:
      return "limit_reached";
    case promise_broken:
      return "promise_broken";
    default:
      return "internal_error";
  }
}

bool leaves_a_report(int exit_code) {
  return exit_code == done || exit_code == gate_failed || exit_code == interrupted || exit_code == terminated;
}

std::string last_error(const std::string& messages) {
  constexpr std::string_view mark = "hooke-remesh: error: ";
  const size_t begin = messages.rfind(mark);
  if (begin == std::string::npos) return "";
  const size_t text = begin + mark.size();
  return messages.substr(text, messages.find('\n', text) - text);
}

namespace {

std::string outcome_word(const nlohmann::ordered_json& row) {
  const int code = row["exit_code"].get<int>();
  return code == done || code == gate_failed ? "done" : row["status"].get<std::string>();
}

}  // namespace

std::string row_in_words(const nlohmann::ordered_json& row) {
  std::string line = fmt::format("{}: {} in {:.2f} s", printable(row["file"].get<std::string>()),
                                 outcome_word(row), row["seconds"].get<double>());
  if (row["exit_code"].get<int>() == gate_failed) line += ", but --require or --compare does not hold";
  const nlohmann::ordered_json &before = row["least_angle_before"], &after = row["least_angle_after"];
  if (before.is_number() && after.is_number())
    line += fmt::format(": least angle {:.3g} -> {:.3g} degrees", before.get<double>(), after.get<double>());
  else if (before.is_number())
    line += fmt::format(": least angle {:.3g} degrees", before.get<double>());
  return line + "\n";
}

std::string batch_in_words(const std::vector<int>& codes, int skipped, double seconds) {
  std::map<int, int> failures;
  for (int code : codes)
    if (code != done) ++failures[code];
  std::vector<std::string> parts;
  int failed = 0;
  for (const auto& [code, count] : failures) {
    parts.push_back(fmt::format("{} with exit code {}", count, code));
    failed += count;
  }
  std::string text =
      fmt::format("{} meshes: {} done", codes.size(), static_cast<int>(codes.size()) - failed - skipped);
  if (skipped > 0) text += fmt::format(", {} skipped", skipped);
  if (failed > 0) text += fmt::format(", {} not done ({})", failed, fmt::join(parts, ", "));
  return text + fmt::format(", in {:.2f} s", seconds);
}

}  // namespace hooke::app
