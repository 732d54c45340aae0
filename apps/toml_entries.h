// The part of TOML that files of settings are written in: entries with one value each, or an array of them.
#pragma once

#include <string>
#include <vector>

namespace hooke::app {

/// A line `key = value` of the file, or `key = [value, ...]`.
struct TomlEntry {
  std::string key;
  std::vector<std::string> values;  // text without its quotes
  bool is_array = false;
  int line = 0;  // from 1
};

/// Whether the text is a number of TOML, decimal and finite.
bool is_toml_number(const std::string& text);

/// The entries in the order of the file. Throws Error "NAME:LINE: ..." for all else: sections, text with
/// escapes, keys in quotes, dates.
std::vector<TomlEntry> read_toml_entries(const std::string& name, std::string text);

}  // namespace hooke::app
