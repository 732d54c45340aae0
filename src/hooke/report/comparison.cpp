#include "hooke/report/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hooke/core/error.h"
#include "hooke/report/gates.h"
#include "hooke/report/report_keys.h"

namespace hooke {
namespace {

bool is_in_list(const std::string& path) {
  return path.find('<') != std::string::npos;
}

std::string text_at(const nlohmann::ordered_json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// How much worse `now` is than `base`; negative if better.
double worsening(Better better, double base, double now) {
  switch (better) {
    case Better::higher:
      return base - now;
    case Better::lower:
      return now - base;
    case Better::nearer_zero:
      return std::abs(now) - std::abs(base);
    case Better::neither:
      break;
  }
  return 0;
}

bool is_of_input(const std::string& path) {
  return path.starts_with("before.");
}

/// Whether the parameter follows from the size of the input.
bool is_of_mesh(const std::string& parameter) {
  return parameter == "L" || parameter == "L_min" || parameter == "L_max" || parameter == "L_natural";
}

void tell_differences(const ReportFigures& base, const ReportFigures& now, Comparison& comparison) {
  const bool same_input = base.input_sha256.empty() || now.input_sha256.empty()
                              ? base.connectivity_sha256 == now.connectivity_sha256
                              : base.input_sha256 == now.input_sha256;
  if (!same_input) comparison.not_comparable.emplace_back("it is of another input");
  if (base.has_result != now.has_result)
    comparison.not_comparable.emplace_back(now.has_result ? "it is of --check: only inputs are compared"
                                                          : "it has a result: only inputs are compared");
  for (const auto& [name, value] : now.parameters) {
    if (!same_input && is_of_mesh(name)) continue;
    const auto before = base.parameters.find(name);
    if (before == base.parameters.end())
      comparison.not_comparable.push_back(fmt::format("it has no parameters.{}", name));
    else if (before->second != value)
      comparison.not_comparable.push_back(
          fmt::format("parameters.{} was {}, and is {}", name, before->second, value));
  }
  for (const auto& [name, value] : base.parameters)
    if (!now.parameters.contains(name))
      comparison.not_comparable.push_back(
          fmt::format("parameters.{} was {}, and is not there now", name, value));
}

}  // namespace

ReportFigures figures_of(const nlohmann::ordered_json& report) {
  constexpr const char* schema = "hooke-remesh/report/1";
  if (!report.is_object() || text_at(report, "schema") != schema || !report.contains("input") ||
      !report["input"].is_object() || !report.contains("parameters") || !report["parameters"].is_object())
    throw Error(fmt::format("is no report; expected JSON of the schema {}", schema));
  ReportFigures f;
  f.input_sha256 = text_at(report["input"], "sha256");
  f.connectivity_sha256 = text_at(report["input"], "connectivity_sha256");
  f.has_result = report.contains("after") && report["after"].is_object();
  f.diagonal = number_at(report, "input.bbox_diagonal").value_or(0);
  for (const auto& [name, value] : report["parameters"].items()) f.parameters[name] = value.dump();
  for (const ReportKey& key : report_keys())
    if (key.better != Better::neither && !is_in_list(key.path))
      if (const std::optional<double> value = number_at(report, key.path))
        f.figures.emplace_back(key.path, *value);
  return f;
}

Comparison compare(const ReportFigures& base, const ReportFigures& now, double rtol) {
  constexpr double rounding = 1e-9;
  Comparison comparison;
  comparison.rtol = rtol;
  tell_differences(base, now, comparison);
  const bool of_inputs = !base.has_result || !now.has_result;
  const std::map<std::string, double> before(base.figures.begin(), base.figures.end());
  for (const auto& [path, value] : now.figures) {
    if (is_of_input(path) != of_inputs) continue;
    const auto old = before.find(path);
    if (old == before.end()) {
      comparison.not_comparable.push_back(fmt::format("it has no {}", path));
      continue;
    }
    ++comparison.compared;
    const ReportKey& key = *find_report_key(path);
    const double scale = key.unit == "file units" ? base.diagonal : 1;
    if (worsening(key.better, old->second, value) > rtol * std::abs(old->second) + rounding * scale)
      comparison.worse.push_back({path, old->second, value});
  }
  for (const auto& old : base.figures)
    if (const std::string& path = old.first;
        is_of_input(path) == of_inputs &&
        std::ranges::none_of(now.figures, [&](const auto& figure) { return figure.first == path; }))
      comparison.not_comparable.push_back(fmt::format("there is no {} now", path));
  return comparison;
}

std::string in_words(const Worsening& w) {
  const double change = worsening(find_report_key(w.key)->better, w.base, w.value);
  const std::string share =
      w.base != 0 ? fmt::format(" ({:.3g} % worse)", 100 * change / std::abs(w.base)) : "";
  return fmt::format("{}: {:.6g} -> {:.6g}{}", w.key, w.base, w.value, share);
}

}  // namespace hooke
