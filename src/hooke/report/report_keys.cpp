#include "hooke/report/report_keys.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

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
  const bool is_block = std::ranges::any_of(
      report_keys(), [&](const ReportKey& key) { return is_number(key) && key.path.starts_with(block); });
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

// What people and programs read of the table.

namespace {

using SchemaNode = nlohmann::ordered_json;

/// The words in lines of at most `width` columns.
std::vector<std::string> lines_of(std::string_view words, size_t width) {
  std::vector<std::string> lines;
  while (!words.empty()) {
    size_t end = words.size();
    if (end > width) {
      end = words.rfind(' ', width);
      if (end == std::string_view::npos || end == 0) end = std::min(words.find(' '), words.size());
    }
    lines.emplace_back(words.substr(0, end));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return lines;
}

bool is_container(const ReportKey& key) {
  return key.kind == KeyKind::object || key.kind == KeyKind::list;
}

std::string with_unit(const ReportKey& key) {
  return key.unit.empty() ? key.meaning : fmt::format("{} [{}]", key.meaning, key.unit);
}

const char* name_of(KeyKind kind) {
  switch (kind) {
    case KeyKind::text:
      return "string";
    case KeyKind::number:
      return "number";
    case KeyKind::integer:
      return "integer";
    case KeyKind::boolean:
      return "boolean";
    case KeyKind::object:
      return "object";
    case KeyKind::list:
      return "array";
  }
  return "";
}

const char* name_of(Better better) {
  switch (better) {
    case Better::neither:
      return "";
    case Better::higher:
      return "higher";
    case Better::lower:
      return "lower";
    case Better::nearer_zero:
      return "nearer 0";
  }
  return "";
}

// The page.

std::string type_on_page(const ReportKey& key) {
  return fmt::format("{}{}", name_of(key.kind), key.may_be_null ? " or null" : "");
}

/// "`a.min`, `a.mean`" for keys that are told together.
struct PageRow {
  std::vector<std::string> paths;
  const ReportKey* key;
};

/// A table of the keys, those of the same row together.
std::string table_of(const std::vector<const ReportKey*>& keys) {
  std::vector<PageRow> rows;
  for (const ReportKey* key : keys) {
    const auto row = std::ranges::find_if(rows, [&](const PageRow& r) { return r.key->row == key->row; });
    if (row == rows.end())
      rows.push_back({{key->path}, key});
    else
      row->paths.push_back(key->path);
  }
  std::string table = "| key | type | unit | better | meaning |\n|---|---|---|---|---|\n";
  for (const PageRow& row : rows) {
    std::string paths;
    for (const std::string& path : row.paths) paths += (paths.empty() ? "`" : ", `") + path + "`";
    table += fmt::format("| {} | {} | {} | {} | {} |\n", paths, type_on_page(*row.key), row.key->unit,
                         name_of(row.key->better), row.key->meaning);
  }
  return table;
}

bool is_in(const std::string& path, const std::string& block) {
  return path == block || path.starts_with(block + ".");
}

/// The keys of these blocks that `chosen` accepts.
template <typename Chosen>
std::vector<const ReportKey*> keys_of(std::initializer_list<const char*> blocks, const Chosen& chosen) {
  std::vector<const ReportKey*> keys;
  for (const ReportKey& key : report_keys())
    if (std::ranges::any_of(blocks, [&](const char* block) { return is_in(key.path, block); }) && chosen(key))
      keys.push_back(&key);
  return keys;
}

constexpr auto all_of_them = [](const ReportKey&) { return true; };

bool has_statistics(const std::string& path) {
  const ReportKey* const figure = find_report_key(path + ".std");
  return figure != nullptr && figure->path == path + ".std";
}

/// Whether the key is in the statistics of a quantity.
bool is_statistic(const ReportKey& key) {
  const size_t end = key.path.find('.', key.path.find('.') + 1);
  return end != std::string::npos && has_statistics(key.path.substr(0, end));
}

/// The figures that every quantity has, as keys below its name.
std::string table_of_figures() {
  std::string table = "| figure | meaning |\n|---|---|\n";
  const std::string quantity = "before.edge_length.";
  for (const ReportKey& key : report_keys())
    if (key.path.starts_with(quantity))
      table += fmt::format("| `.{}` | {} |\n", key.path.substr(quantity.size()),
                           key.meaning.substr(0, key.meaning.find(": ")));
  return table;
}

}  // namespace

std::string keys_as_text() {
  constexpr size_t width = 80, column = 36;
  std::string text =
      R"(The values of a report: key, meaning, [unit]. Numbers can stand in --require;
yes and no count as 1 and 0. <n> is an index of a list, from 0, <name> a name
that depends on the run.

)";
  for (const ReportKey& key : report_keys()) {
    if (is_container(key)) continue;
    const std::vector<std::string> lines = lines_of(with_unit(key), width - column);
    if (key.path.size() + 2 > column) text += fmt::format("{}\n", key.path);
    for (size_t k = 0; k < lines.size(); ++k) {
      const bool beside_key = k == 0 && key.path.size() + 2 <= column;
      text += fmt::format("{:<{}}{}\n", beside_key ? key.path : "", column, lines[k]);
    }
  }
  return text;
}

std::string keys_as_page() {
  const auto in_quality = [](const ReportKey& key) {
    return is_in(key.path, "before") && !is_statistic(key);
  };
  const auto is_quantity = [](const ReportKey& key) { return has_statistics(key.path); };
  const auto other = [&](const ReportKey& key) { return in_quality(key) && !is_quantity(key); };
  std::string page = R"(# The report

`--report FILE.json` (`-` for standard output) writes one JSON object with every key below; the Python package has it
as a dict. Angles are in degrees, lengths in file units, ids count from 0, and numbers have the digits that read back
exactly. `null` stands for what does not exist. What varies from run to run stands only under `resources` and in keys
that end in `_s`.

`<n>` is an index of a list, from 0, and `<name>` a name that depends on the run. Any number can stand in
`--require 'after.min_angle.min >= 20'`, with the keys joined by dots; yes and no count as 1 and 0. The column *better*
says which way a figure gets better; `--compare` calls the other way worse. With `--check` there is no result: `output`,
`promises`, `after`, `geometry`, `projection`, `held_back`, `near_regular`, `steps_smoothed`, `features`, `flips`,
`adaptation` and `paper.after` are null, and `iterations` is empty.

`report.schema.json` beside this page is the JSON Schema of a report. The tool makes both from the table that also makes
`--list-metrics`, and a test keeps them so:

    hooke-remesh --list-metrics=markdown > src/hooke/report/README.md
    hooke-remesh --list-metrics=schema > src/hooke/report/report.schema.json
)";
  const auto add = [&](const char* title, const std::string& text) {
    page += fmt::format("\n## {}\n\n{}", title, text);
  };
  add("The run", table_of(keys_of({"schema", "tool", "status"}, all_of_them)));
  add("The files: `input` and `output`", table_of(keys_of({"input", "output"}, all_of_them)));
  add("Quality: `before` and `after`",
      R"(`before` is the input after repair, `after` what is in the output file: where its coordinates have single precision
(STL, some PLY), they are rounded first. Both have the same keys; the tables name those of `before`.

These quantities are told by the figures below, as in `after.min_angle.p05`:

)" + table_of(keys_of({"before"}, is_quantity)) +
          "\n" + table_of_figures() + "\n" + table_of(keys_of({"before"}, other)));
  add("What the result keeps: `promises`, `geometry`",
      R"(Both are of what is in the output file, as `after` is. A result that breaks a promise, by its rounding too, is
not written unless `--accept-invalid` is given or a signal stopped the run; a warning then tells of it.

)" + table_of(keys_of({"promises", "geometry"}, all_of_them)));
  add("Gates, comparison, warnings and repairs",
      table_of(keys_of({"gates", "comparison", "warnings", "repairs"}, all_of_them)));
  add("The course of the run", table_of(keys_of({"iterations", "projection", "held_back", "near_regular",
                                                 "steps_smoothed", "features", "flips", "adaptation"},
                                                all_of_them)));
  add("`parameters`", table_of(keys_of({"parameters"}, all_of_them)));
  add("`paper`", table_of(keys_of({"paper"}, all_of_them)));
  add("`resources`", table_of(keys_of({"resources"}, all_of_them)));
  return page;
}

std::string report_schema() {
  const auto closed = [](SchemaNode& object) {
    object["properties"] = SchemaNode::object();
    object["required"] = SchemaNode::array();
    object["additionalProperties"] = false;
  };
  SchemaNode schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", "hooke-remesh/report/1"},
                       {"description", "The report of a run of hooke-remesh"},
                       {"type", "object"}};
  closed(schema);
  for (const ReportKey& key : report_keys()) {
    SchemaNode* parent = &schema;
    std::string_view rest = key.path;
    SchemaNode value = {{"description", key.meaning}};
    if (!key.unit.empty()) value["unit"] = key.unit;
    value["type"] = name_of(key.kind);
    if (key.may_be_null) value["type"] = {name_of(key.kind), "null"};
    if (key.kind == KeyKind::object) closed(value);
    for (size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
      const std::string step(rest.substr(0, dot));
      parent = step == "<n>"      ? &(*parent)["items"]
               : step == "<name>" ? &(*parent)["additionalProperties"]
                                  : &(*parent)["properties"][step];
      rest.remove_prefix(dot + 1);
    }
    const std::string last(rest);
    if (last == "<n>")
      (*parent)["items"] = value;
    else if (last == "<name>")
      (*parent)["additionalProperties"] = value;
    else {
      (*parent)["properties"][last] = value;
      (*parent)["required"].push_back(last);
    }
  }
  constexpr int indent = 1;
  return schema.dump(indent) + "\n";
}

}  // namespace hooke
