#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <utility>

#include "config_file.h"
#include "exit_codes.h"
#include "generated_help.h"
#include "help.h"
#include "hooke/core/error.h"
#include "hooke/io/files.h"
#include "listing_request.h"
#include "messages.h"
#include "nearest_word.h"
#include "option_table.h"
#include "words.h"

namespace hooke::app {
namespace {

/// Throws Error for `--option=`, for which CLI11 would take the next argument as the value, and for
/// `-o=value`, whose value it would begin with the `=`.
void require_values(const CLI::App& app, const std::vector<std::string>& arguments) {
  for (const std::string& word : arguments) {
    if (word == "--") return;
    const std::string name = word.substr(0, word.find('='));
    if (name.size() == word.size()) continue;
    if (name.starts_with("--") && name.size() + 1 == word.size())
      throw Error(name + ": ''; expected a value after the =; give one, or leave the option out");
    const auto is_short = [&](char letter) {
      return app.get_option_no_throw(std::string("-") + letter) != nullptr;
    };
    if (name.size() > 1 && name[0] == '-' && std::all_of(name.begin() + 1, name.end(), is_short))
      throw Error(fmt::format("{}: a short option has no = before its value; expected a blank; write {} {}",
                              word, name, word.substr(name.size() + 1)));
  }
}

/// A parser whose options write to its own settings.
struct Parser {
  CLI::App app{purpose, "hooke-remesh"};
  Settings settings;
  RawOptions raw;
  std::shared_ptr<ConfigFile> config = std::make_shared<ConfigFile>(app);

  Parser() {
    raw.given = [this](const char* option) { return is_given(*app.get_option(option)); };
    app.config_formatter(config);
    add_options(app, settings, raw);
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  /// Throws Error and CLI::ParseError.
  void parse(std::vector<std::string> arguments) {
    require_values(app, arguments);
    std::ranges::reverse(arguments);  // CLI11 takes them from the back
    app.parse(std::move(arguments));
  }

  /// What is wrong with the command line or the file. Names the option nearest to one that is unknown.
  std::string problem(const CLI::ParseError& error) const {
    if (dynamic_cast<const CLI::FileError*>(&error) != nullptr)
      return std::string("--config: ") + error.what() + "; expected a readable file";
    if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr)
      return config->place_of(error.what()) + error.what();
    const std::vector<std::string> extras = app.remaining();
    const auto unknown =
        std::ranges::find_if(extras, [](const std::string& word) { return word.starts_with("--"); });
    if (unknown == extras.end()) return error.what();
    const std::string name = unknown->substr(2, unknown->find('=') - 2);
    std::vector<std::string> known;
    for (const CLI::Option* option : app.get_options())
      for (const std::string& word : option->get_lnames()) known.push_back(word);
    const std::string nearest = nearest_word(name, known);
    return "--" + name + ": unknown option" + (nearest.empty() ? "" : "; did you mean --" + nearest + "?");
  }

  /// Completes the settings. Throws Error.
  void complete() {
    if (app.get_config_ptr()->count() > 0) settings.config = app.get_config_ptr()->as<std::string>();
    for (const CLI::Option* option : given_options(app)) {
      const bool flag = option->get_items_expected_min() == 0;
      settings.given.push_back(
          {option->get_single_name(), flag ? std::vector<std::string>() : option->results()});
    }
    try {
      resolve(settings, raw);
    } catch (const Error& e) {
      throw Error(config->place_of(e.what()) + e.what());
    }
  }
};

/// Prints to standard output what was asked for instead of a run. Returns the exit code.
int print_text(const std::string& text) {
  try {
    write_to_standard_output(text);
    return done;
  } catch (const OutputError& e) {
    print_error(e.what());
    return output_failed;
  }
}

/// Answers the request for a help text, a list or the version. Returns the exit code.
int answer(const CLI::App& app, const CLI::ParseError& request) {
  if (const auto* list = dynamic_cast<const ListingRequest*>(&request)) return print_text(list->listing());
  if (dynamic_cast<const CLI::CallForAllHelp*>(&request) != nullptr)
    return print_text(full_help(entries_of(app)));
  if (dynamic_cast<const CLI::CallForHelp*>(&request) != nullptr) return print_text(short_help());
  return print_text(std::string(request.what()) + "\n");
}

}  // namespace

Parsed parse_command_line(int argc, char** argv) {
  Parser parser;
  try {
    parser.parse({argv + std::min(argc, 1), argv + argc});
    if (parser.raw.completion)
      return {std::nullopt, print_text(completion(*parser.raw.completion, entries_of(parser.app)))};
    if (parser.raw.man_page) return {std::nullopt, print_text(man_page(entries_of(parser.app)))};
    parser.complete();
    if (parser.raw.print_config) return {std::nullopt, print_text(parser.app.config_to_str())};
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return {std::nullopt, answer(parser.app, e)};
    print_error(parser.problem(e) + "; see hooke-remesh --help");
    return {std::nullopt, usage};
  } catch (const Error& e) {
    print_error(e.what());
    return {std::nullopt, usage};
  }
  return {std::move(parser.settings), done};
}

Settings parse_arguments(std::vector<std::string> arguments) {
  Parser parser;
  try {
    parser.parse(std::move(arguments));
  } catch (const CLI::ParseError& e) {
    throw Error(parser.problem(e));
  }
  parser.complete();
  return std::move(parser.settings);
}

}  // namespace hooke::app
