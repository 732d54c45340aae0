#include "hooke/report/gates.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/report/report_keys.h"

namespace hooke {
namespace {

using Json = nlohmann::ordered_json;

/// Longer ones before those that begin them.
const std::array<std::pair<const char*, std::function<bool(double, double)>>, 6> relations = {
    {{">=", std::greater_equal<double>()},
     {"<=", std::less_equal<double>()},
     {"==", std::equal_to<double>()},
     {"!=", std::not_equal_to<double>()},
     {">", std::greater<double>()},
     {"<", std::less<double>()}}};

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// The member of an object or element of a list; null if there is none.
const Json* member(const Json& json, const std::string& key) {
  if (json.is_object()) {
    const auto found = json.find(key);
    return found == json.end() ? nullptr : &*found;
  }
  size_t index = 0;
  const auto [rest, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  const bool is_index = error == std::errc() && rest == key.data() + key.size();
  return json.is_array() && is_index && index < json.size() ? &json[index] : nullptr;
}

/// The key of the input that is most like this one of the result.
std::string nearest_of_input(const std::string& metric) {
  constexpr std::string_view after = "after.";
  return metric.starts_with(after) ? "before." + metric.substr(after.size()) : "before.min_angle.min";
}

}  // namespace

Gate parse_gate(const std::string& text) {
  constexpr const char* expected =
      "expected METRIC >= NUMBER, such as after.min_angle.min >= 20 (or <=, ==, !=, >, <)";
  const size_t at = text.find_first_of("<>=!");
  if (at == std::string::npos) throw Error(fmt::format("{}; {}", in_quotes(text), expected));
  for (const auto& [relation, holds] : relations) {
    const std::string_view sign = relation;
    if (text.compare(at, sign.size(), sign) != 0) continue;
    Gate gate{trimmed(text), trimmed(text.substr(0, at)), relation, 0};
    const std::string bound = trimmed(text.substr(at + sign.size())), number = bound == "true"    ? "1"
                                                                               : bound == "false" ? "0"
                                                                                                  : bound;
    const auto [rest, error] = std::from_chars(number.data(), number.data() + number.size(), gate.bound);
    if (gate.metric.empty() || error != std::errc() || rest != number.data() + number.size() ||
        !std::isfinite(gate.bound))
      break;
    return gate;
  }
  throw Error(fmt::format("{}; {}", in_quotes(text), expected));
}

void require_metrics(const std::vector<Gate>& gates, bool check_only) {
  for (const Gate& gate : gates) {
    const ReportKey* const key = find_report_key(gate.metric);
    if (key == nullptr)
      throw Error(fmt::format("{}: the report has no such key; did you mean {}? See --list-metrics",
                              in_quotes(gate.metric), nearest_number(gate.metric)));
    if (!is_number(*key))
      throw Error(
          fmt::format("{}: is not a number of the report; expected one such as {}; see --list-metrics",
                      in_quotes(gate.metric), nearest_number(gate.metric + ".min")));
    if (check_only && key->of_result)
      throw Error(fmt::format(
          "{}: is of the result, which --check has none of; expected a key of the input, such as {}",
          in_quotes(gate.metric), nearest_of_input(gate.metric)));
  }
}

std::optional<double> number_at(const Json& report, const std::string& path) {
  const Json* json = &report;
  for (size_t begin = 0; begin <= path.size() && json != nullptr;) {
    const size_t end = std::min(path.find('.', begin), path.size());
    json = member(*json, path.substr(begin, end - begin));
    begin = end + 1;
  }
  if (json == nullptr) return std::nullopt;
  if (json->is_boolean()) return json->get<bool>() ? 1 : 0;
  if (!json->is_number() || !std::isfinite(json->get<double>())) return std::nullopt;
  return json->get<double>();
}

std::vector<GateOutcome> judge_gates(const std::vector<Gate>& gates, const Json& report) {
  std::vector<GateOutcome> outcomes;
  for (const Gate& gate : gates) {
    const std::optional<double> value = number_at(report, gate.metric);
    const auto* const relation =
        std::ranges::find_if(relations, [&](const auto& r) { return gate.relation == r.first; });
    outcomes.push_back({gate.text, value, value && relation->second(*value, gate.bound)});
  }
  return outcomes;
}

}  // namespace hooke
