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

/// The keys of an object, as a message lists them.
std::string keys_of(const Json& object) {
  std::string keys;
  for (const auto& [key, value] : object.items()) keys += (keys.empty() ? "" : ", ") + key;
  return keys;
}

/// The member of an object or element of a list. Throws Error if there is none.
const Json& member(const Json& json, const std::string& key, const std::string& metric) {
  if (json.is_object()) {
    const auto found = json.find(key);
    if (found != json.end()) return *found;
    throw Error(fmt::format("{}: the report has no {} there; expected one of {}", in_quotes(metric),
                            in_quotes(key), keys_of(json)));
  }
  size_t index = 0;
  const auto [rest, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  if (!json.is_array() || error != std::errc() || rest != key.data() + key.size() || index >= json.size())
    throw Error(
        fmt::format("{}: the report has no {} there; expected {}", in_quotes(metric), in_quotes(key),
                    json.is_array() ? fmt::format("an index below {}", json.size()) : "nothing more"));
  return json[index];
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
    const std::string number = trimmed(text.substr(at + sign.size()));
    const auto [rest, error] = std::from_chars(number.data(), number.data() + number.size(), gate.bound);
    if (gate.metric.empty() || error != std::errc() || rest != number.data() + number.size() ||
        !std::isfinite(gate.bound))
      break;
    return gate;
  }
  throw Error(fmt::format("{}; {}", in_quotes(text), expected));
}

std::optional<double> metric_of(const Json& report, const std::string& metric) {
  const Json* json = &report;
  for (size_t begin = 0; begin <= metric.size() && !json->is_null();) {
    const size_t end = std::min(metric.find('.', begin), metric.size());
    json = &member(*json, metric.substr(begin, end - begin), metric);
    begin = end + 1;
  }
  if (json->is_null()) return std::nullopt;
  if (json->is_boolean()) return json->get<bool>() ? 1 : 0;
  if (json->is_number()) return json->get<double>();
  throw Error(fmt::format("{}: is not a number of the report{}", in_quotes(metric),
                          json->is_object() ? "; expected one of its " + keys_of(*json) : ""));
}

void require_metrics(const std::vector<Gate>& gates, const Json& block) {
  for (const Gate& gate : gates) {
    const size_t dot = gate.metric.find('.');
    const std::string first = gate.metric.substr(0, dot);
    if (dot == std::string::npos || (first != "before" && first != "after")) continue;
    const std::string rest = gate.metric.substr(dot + 1);
    // What these hold depends on the mesh.
    if (!rest.starts_with("worst_faces.") && !rest.starts_with("valence.")) metric_of(block, rest);
  }
}

std::vector<GateOutcome> judge_gates(const std::vector<Gate>& gates, const Json& report) {
  std::vector<GateOutcome> outcomes;
  for (const Gate& gate : gates) {
    std::optional<double> value;
    try {
      value = metric_of(report, gate.metric);
    } catch (const Error&) {  // a key that no report has: the gate fails, and the result is written
    }
    const auto* const relation =
        std::ranges::find_if(relations, [&](const auto& r) { return gate.relation == r.first; });
    outcomes.push_back({gate.text, value, value && relation->second(*value, gate.bound)});
  }
  return outcomes;
}

}  // namespace hooke
