#include "toml_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"

namespace hooke::app {

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

namespace {

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

}  // namespace

std::vector<TomlEntry> read_toml_entries(const std::string& name, std::string text) {
  TomlScanner scanner(name, std::move(text));
  std::vector<TomlEntry> entries;
  for (TomlEntry entry; scanner.next(entry);) entries.push_back(std::move(entry));
  return entries;
}

}  // namespace hooke::app
