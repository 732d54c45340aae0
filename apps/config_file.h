// Files of settings: the options of the command in TOML.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hooke::app {

/// Whether the option was given; a flag that is switched off was not.
bool is_given(const CLI::Option& option);

/// The options given so far that a file of settings may hold, in the order of the table.
std::vector<const CLI::Option*> given_options(const CLI::App& app);

/// Reads and writes such files for CLI11: a line `name = value` for each option, by its long name; the value
/// a number, text in quotes, true or false, or an array of such. Options that are given already are left as
/// they are.
class ConfigFile final : public CLI::Config {
 public:
  explicit ConfigFile(const CLI::App& app) : app_(app) {}

  /// The options given, and the others as comments. Throws Error for text that TOML cannot hold here.
  std::string to_config(const CLI::App* app, bool, bool, std::string) const override;

  /// Throws Error with file and line for what is no such file, or names no option that it may hold.
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;

  /// "FILE:LINE: " if the message begins with the name of an option that came from the file; else empty.
  std::string place_of(std::string_view message) const;

 private:
  std::string name() const;

  const CLI::App& app_;
  mutable std::map<std::string, int> lines_;  // of the options that were taken
};

}  // namespace hooke::app
