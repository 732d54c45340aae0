#include "hooke/report/report_keys.h"

#include <algorithm>

#include "hooke/core/edit_distance.h"

namespace hooke {
namespace {

bool is_index(const std::string& key) {
  return !key.empty() && std::ranges::all_of(key, [](char c) { return c >= '0' && c <= '9'; });
}

/// The key that begins there in a path with a dot after each key; `begin` becomes the place of the next.
std::string take_key(const std::string& path, size_t& begin) {
  const size_t end = path.find('.', begin);
  std::string key = path.substr(begin, end - begin);
  begin = end + 1;
  return key;
}

/// Whether a path of a report is one that the key stands for.
bool matches(const std::string& pattern, const std::string& path) {
  const std::string keys = pattern + ".", given = path + ".";
  size_t next_key = 0, next_given = 0;
  while (next_key < keys.size() && next_given < given.size()) {
    const std::string key = take_key(keys, next_key), name = take_key(given, next_given);
    if (key == "<n>" ? !is_index(name) : key != "<name>" && key != name) return false;
  }
  return next_key == keys.size() && next_given == given.size();
}

}  // namespace

bool is_number(const ReportKey& key) {
  return key.kind == KeyKind::number || key.kind == KeyKind::integer || key.kind == KeyKind::boolean;
}

const ReportKey* find_report_key(const std::string& path) {
  const auto& keys = report_keys();
  const auto found =
      std::ranges::find_if(keys, [&](const ReportKey& key) { return matches(key.path, path); });
  return found == keys.end() ? nullptr : &*found;
}

std::string nearest_number(const std::string& path) {
  const std::string block = path.substr(0, path.find('.')) + ".";
  const bool is_block =
      std::ranges::any_of(report_keys(), [&](const ReportKey& key) { return key.path.starts_with(block); });
  std::string nearest;
  size_t least = std::string::npos;
  for (const ReportKey& key : report_keys())
    if (is_number(key) && (!is_block || key.path.starts_with(block)))
      if (const size_t distance = edit_distance(path, key.path); distance < least) {
        least = distance;
        nearest = key.path;
      }
  return nearest;
}

std::vector<std::string> parameter_names() {
  const std::string block = "parameters.";
  std::vector<std::string> names;
  for (const ReportKey& key : report_keys())
    if (key.path.starts_with(block) && key.path.find('.', block.size()) == std::string::npos)
      names.push_back(key.path.substr(block.size()));
  return names;
}

}  // namespace hooke
