#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "option_table.h"

namespace hooke::app {
namespace {

bool is_word(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

/// The alternatives of "DEG|off" that are words: "off"; of "curvature[:ERROR]": "curvature".
std::vector<std::string> words_in(const std::string& value) {
  std::vector<std::string> words;
  std::istringstream alternatives(value);
  for (std::string alternative; std::getline(alternatives, alternative, '|');) {
    alternative.resize(std::min(alternative.find('['), alternative.size()));
    if (is_word(alternative)) words.push_back(alternative);
  }
  return words;
}

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  if (!option.get_snames().empty()) entry.short_name = "-" + option.get_snames().front();
  entry.long_name = option.get_lnames().empty() ? option.get_name(true) : "--" + option.get_lnames().front();
  if (option.get_items_expected_min() > 0) entry.value = option.get_type_name();
  entry.by_default = option.get_default_str();
  entry.help = option.get_description();
  entry.group = option.get_group();
  entry.words = words_in(entry.value);
  entry.repeatable = option.get_items_expected_max() > 1;
  return entry;
}

}  // namespace

std::vector<OptionEntry> entries_of(const CLI::App& app) {
  std::vector<OptionEntry> entries;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) entries.push_back(entry_of(*option));
  return entries;
}

}  // namespace hooke::app
