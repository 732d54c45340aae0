#include "config_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "nearest_word.h"
#include "toml_entries.h"

namespace hooke::app {
namespace {

std::string key_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name(true) : option.get_lnames().front();
}

bool is_flag(const CLI::Option& option) {
  return option.get_items_expected_min() == 0;
}

bool may_stand_in_file(const CLI::Option& option) {
  return option.get_configurable() && !option.get_group().empty();
}

/// Why the entry cannot be one of this option; empty if it can.
std::string problem_with(const TomlEntry& entry, const CLI::Option& option) {
  if (!may_stand_in_file(option)) return "is of the command line only; remove the line";
  if (entry.is_array && option.get_items_expected_max() <= 1) return "an array; expected one value";
  if (is_flag(option) && entry.values[0] != "true" && entry.values[0] != "false")
    return in_quotes(entry.values[0]) + "; expected true or false";
  return "";
}

/// The text as a value of TOML.
std::string toml_value(const std::string& option, const std::string& text) {
  if (is_toml_number(text)) return text;
  const bool plain =
      std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; });
  if (plain && text.find('\'') == std::string::npos) return "'" + text + "'";
  if (plain && text.find_first_of("\"\\") == std::string::npos) return '"' + text + '"';
  throw Error(
      fmt::format("--print-config: {} of {} has both kinds of quotes or control characters; expected text "
                  "that a file of settings can hold; choose another name",
                  in_quotes(text), option));
}

std::string given_line(const CLI::Option& option) {
  const std::string key = key_of(option);
  if (is_flag(option)) return key + " = true\n";
  std::vector<std::string> values;
  for (const std::string& text : option.results()) values.push_back(toml_value(key, text));
  return values.size() == 1 ? fmt::format("{} = {}\n", key, values[0])
                            : fmt::format("{} = [{}]\n", key, fmt::join(values, ", "));
}

std::string comment_line(const CLI::Option& option) {
  if (is_flag(option)) return fmt::format("# {} = false\n", key_of(option));
  return option.get_default_str().empty()
             ? fmt::format("# {}: {}\n", key_of(option), option.get_type_name())
             : fmt::format("# {}: {}\n", key_of(option), option.get_default_str());
}

}  // namespace

bool is_given(const CLI::Option& option) {
  return option.count() > 0 && (!is_flag(option) || CLI::detail::to_flag_value(option.results().back()) > 0);
}

std::vector<const CLI::Option*> given_options(const CLI::App& app) {
  std::vector<const CLI::Option*> given;
  for (const CLI::Option* option : app.get_options())
    if (is_given(*option) && may_stand_in_file(*option)) given.push_back(option);
  return given;
}

std::string ConfigFile::to_config(const CLI::App* app, bool, bool, std::string) const {
  const std::vector<const CLI::Option*> given = given_options(*app);
  std::string text =
                  "# Settings of hooke-remesh " HOOKE_VERSION ": run them with hooke-remesh --config FILE\n",
              group;
  for (const CLI::Option* option : app->get_options()) {
    if (!may_stand_in_file(*option)) continue;
    if (option->get_group() != group) text += fmt::format("\n# {}\n", group = option->get_group());
    text += std::ranges::find(given, option) != given.end() ? given_line(*option) : comment_line(*option);
  }
  return text;
}

std::vector<CLI::ConfigItem> ConfigFile::from_config(std::istream& input) const {
  const std::string file = name();
  std::map<std::string, const CLI::Option*> options;
  std::vector<std::string> known;
  for (const CLI::Option* option : app_.get_options()) {
    options[key_of(*option)] = option;
    if (may_stand_in_file(*option)) known.push_back(key_of(*option));
  }
  std::vector<CLI::ConfigItem> taken;
  std::map<std::string, int> lines;
  for (TomlEntry& entry : read_toml_entries(file, {std::istreambuf_iterator<char>(input), {}})) {
    const auto fail = [&](const std::string& problem) {
      throw Error(fmt::format("{}:{}: {}: {}", file, entry.line, printable(entry.key), problem));
    };
    const auto found = options.find(entry.key);
    if (found == options.end()) {
      const std::string nearest = nearest_word(entry.key, known);
      fail("unknown option; " +
           (nearest.empty() ? "hooke-remesh --help-all lists them" : "did you mean " + nearest + "?"));
    }
    const CLI::Option& option = *found->second;
    if (const std::string problem = problem_with(entry, option); !problem.empty()) fail(problem);
    if (const auto [place, added] = lines.emplace(entry.key, entry.line); !added)
      fail(fmt::format("a second time, after line {}; expected it once; remove one", place->second));
    if (option.count() > 0 || (is_flag(option) && entry.values[0] == "false") || entry.values.empty())
      continue;
    lines_.emplace(entry.key, entry.line);
    taken.push_back({{}, entry.key, std::move(entry.values)});
  }
  return taken;
}

std::string ConfigFile::name() const {
  return printable(app_.get_config_ptr()->as<std::string>());
}

std::string ConfigFile::place_of(std::string_view message) const {
  message.remove_prefix(std::min(message.find_first_not_of('-'), message.size()));
  if (message.size() > 2 && message.substr(1, 3) == ",--") message.remove_prefix(4);
  for (const auto& [key, line] : lines_)
    if (message.starts_with(key) &&
        (message.size() == key.size() || message[key.size()] == ' ' || message[key.size()] == ':'))
      return fmt::format("{}:{}: ", name(), line);
  return "";
}

}  // namespace hooke::app
