// The table of all options, which the parser, the help, the completions and the man page are made from.
#pragma once

#include <string>
#include <vector>

#include "options.h"
#include "words.h"

namespace CLI {
class App;
}

namespace hooke::app {

/// Adds all options; they write to the settings and the raw options, which must outlive the parser.
void add_options(CLI::App& app, Settings& settings, RawOptions& raw);

/// An option as the user sees it.
struct OptionEntry {
  std::string short_name;          // "-o"; empty for none
  std::string long_name;           // "--output"; "INPUT" for what stands by itself
  std::string value;               // placeholder or words of its value: "FILE", "DEG|off"; empty for flags
  std::string by_default;          // empty for none
  std::string help;                // a sentence without full stop
  std::string group;               // heading that it stands under
  std::vector<std::string> words;  // values that are words: "off"
  bool repeatable = false;

  bool positional() const { return !long_name.starts_with('-'); }
  bool takes_file() const { return positional() || value.find("FILE") != std::string::npos; }
  bool is_flag() const { return value.empty() && !positional(); }
};

/// All options in the order of the table, but the hidden ones.
std::vector<OptionEntry> entries_of(const CLI::App& app);

}  // namespace hooke::app
