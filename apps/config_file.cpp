#include "config_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "nearest_word.h"

namespace hooke::app {
namespace {

// The part of TOML that these files are written in: entries with one value each, or an array of them.

/// A line `key = value` of the file, or `key = [value, ...]`.
struct TomlEntry {
  std::string key;
  std::vector<std::string> values;  // text without its quotes
  bool is_array = false;
  int line = 0;  // from 1
};

/// Whether the text is a number of TOML, decimal and finite.
bool is_toml_number(const std::string& text) {
  std::string_view rest = text;
  const auto take_one_of = [&](std::string_view characters) {
    if (rest.empty() || characters.find(rest.front()) == std::string_view::npos) return false;
    rest.remove_prefix(1);
    return true;
  };
  const auto take_digits = [&] {
    const size_t count = std::min(rest.find_first_not_of("0123456789"), rest.size());
    rest.remove_prefix(count);
    return count > 0;
  };
  take_one_of("+-");
  if (!take_one_of("0") && !take_digits()) return false;
  if (take_one_of(".") && !take_digits()) return false;
  if (take_one_of("eE") && (take_one_of("+-"), !take_digits())) return false;
  return rest.empty();
}

/// Takes the entries of a file one by one.
class TomlScanner {
 public:
  TomlScanner(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}

  /// Whether there is another entry; reads it.
  bool next(TomlEntry& entry) {
    skip_blank(true);
    if (at_end()) return false;
    entry = {.key = bare(), .values = {}, .line = line_};
    if (entry.key.empty()) fail(in_quotes(rest_of_line()), "NAME = VALUE, without sections");
    skip_blank(false);
    if (!take('=')) fail("no value for " + in_quotes(entry.key), "NAME = VALUE");
    skip_blank(false);
    entry.is_array = take('[');
    if (entry.is_array)
      read_array(entry.values);
    else
      entry.values.push_back(value());
    skip_blank(false);
    if (!at_end() && peek() != '\n')
      fail(in_quotes(rest_of_line()) + " after the value", "the end of the line");
    return true;
  }

 private:
  bool at_end() const { return at_ >= text_.size(); }
  char peek() const { return at_end() ? '\n' : text_[at_]; }

  bool take(char c) {
    if (peek() != c || at_end()) return false;
    ++at_;
    return true;
  }

  /// Skips spaces and a comment; also ends of lines, if they have no meaning.
  void skip_blank(bool lines) {
    for (; !at_end(); ++at_) {
      const char c = peek();
      if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      else if (c == '\n' && lines)
        ++line_;
      else if (c != ' ' && c != '\t' && c != '\r')
        return;
    }
  }

  /// Letters, digits, and what numbers and keys are made of.
  std::string bare() {
    const size_t begin = at_;
    while (!at_end() && (std::isalnum(static_cast<unsigned char>(peek())) ||
                         std::string_view("+-._").find(peek()) != std::string_view::npos))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::string value() {
    const char quote = peek();
    if (quote == '"' || quote == '\'') {
      const size_t begin = ++at_;
      while (!at_end() && peek() != quote && peek() != '\n') ++at_;
      std::string text = text_.substr(begin, at_ - begin);
      if (!take(quote)) fail("text without its closing quote", fmt::format("{} at its end", quote));
      if (quote == '"' && text.find('\\') != std::string::npos)
        fail("a backslash in " + in_quotes(text), "text between ', where it stands for itself");
      return text;
    }
    const size_t begin = at_;
    std::string word = bare();
    if (word == "true" || word == "false" || is_toml_number(word)) return word;
    at_ = begin;
    fail(in_quotes(rest_of_line()), "a number, true, false, text in quotes, or an array of them in [ ]");
  }

  void read_array(std::vector<std::string>& values) {
    for (skip_blank(true); !take(']'); skip_blank(true)) {
      values.push_back(value());
      skip_blank(true);
      if (!take(',') && peek() != ']') fail("an array without end", "a comma, or ]");
    }
  }

  std::string rest_of_line() const { return text_.substr(at_, text_.find_first_of("\r\n", at_) - at_); }

  [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
    throw Error(fmt::format("{}:{}: {}; expected {}", name_, line_, what, expected));
  }

  std::string name_, text_;
  size_t at_ = 0;
  int line_ = 1;
};

/// The entries in the order of the file. Throws Error "NAME:LINE: ..." for all else: sections, text with
/// escapes, keys in quotes, dates.
std::vector<TomlEntry> read_toml_entries(const std::string& name, std::string text) {
  TomlScanner scanner(name, std::move(text));
  std::vector<TomlEntry> entries;
  for (TomlEntry entry; scanner.next(entry);) entries.push_back(std::move(entry));
  return entries;
}

// The options of the command.

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
