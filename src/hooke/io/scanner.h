// Scanner for text in memory: lines, tokens and numbers. Shared by the readers of text formats.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace hooke {

/// The error of parsing a number.
enum class NumberError { none, malformed, too_large };

/// Parses all of `token` as a finite decimal number, independent of the locale. A leading '+' is allowed;
/// hexadecimal numbers and Fortran exponents are not. Numbers below the smallest subnormal become 0.
NumberError parse_number(std::string_view token, double& value);

/// Parses all of `token` as a decimal integer. A leading '+' is allowed.
NumberError parse_integer(std::string_view token, long long& value);

/// Whether two texts are equal, ignoring the case of ASCII letters.
bool equal_ignoring_case(std::string_view a, std::string_view b);

/// A cursor in a text. Lines end with LF, CR LF or CR and count from 1; blanks separate tokens.
class Scanner {
 public:
  struct Syntax {
    bool comments = false;       // '#' starts a comment up to the end of the line
    bool continuations = false;  // '\' before a line end continues the line (not in comments)
  };

  Scanner(std::string_view text, std::string name, Syntax syntax, int first_line = 1);

  /// Advances to the next line with a token; on the first call, to the first. False at the end of the text.
  bool next_line();

  /// The next token of this line; empty at its end.
  std::string_view token();

  /// The next token of this line as a number, called `what` in messages. Throws InputError if it is none.
  double number(std::string_view what);
  long long integer(std::string_view what);

  /// Converts a token that was read before.
  double number(std::string_view token, std::string_view what) const;
  long long integer(std::string_view token, std::string_view what) const;

  /// Advances past the end of this line; next_line() then starts with the line after it.
  void finish_line();

  /// The text after the cursor.
  std::string_view rest() const { return {cursor_, remaining()}; }

  /// A scanner with the same name and syntax on another text.
  Scanner on(std::string_view text, int first_line) const { return {text, name_, syntax_, first_line}; }

  int line() const { return line_; }
  size_t offset() const { return cursor_ - begin_; }
  size_t remaining() const { return end_ - cursor_; }

  /// Throws InputError "NAME:LINE: message".
  [[noreturn]] void fail(std::string_view message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(int line, std::string_view message) const;

 private:
  void skip_blanks();
  void skip_line();
  void skip_line_end();
  bool at_continuation(const char* at) const;
  bool ends_token(const char* at) const;

  const char* begin_;
  const char* cursor_;
  const char* end_;
  std::string name_;
  Syntax syntax_;
  int line_;
  bool started_ = false;
};

// Character classification and tokenization, inline because they run per character.

enum class LetterKind : unsigned char {
  plain,
  blank,
  line_end,
  mark,  // '#' or '\\', whose meaning depends on the syntax
};

inline constexpr std::array<LetterKind, 256> letter_kinds = [] {
  std::array<LetterKind, 256> kinds{};
  for (unsigned char c : {' ', '\t', '\v', '\f'}) kinds[c] = LetterKind::blank;
  for (unsigned char c : {'\n', '\r'}) kinds[c] = LetterKind::line_end;
  for (unsigned char c : {'#', '\\'}) kinds[c] = LetterKind::mark;
  return kinds;
}();

inline LetterKind kind_of(char c) {
  return letter_kinds[static_cast<unsigned char>(c)];
}

inline bool is_line_end(char c) {
  return kind_of(c) == LetterKind::line_end;
}

inline bool is_blank(char c) {
  return kind_of(c) == LetterKind::blank;
}

inline bool Scanner::at_continuation(const char* at) const {
  return syntax_.continuations && *at == '\\' && at + 1 < end_ && is_line_end(at[1]);
}

inline bool Scanner::ends_token(const char* at) const {
  if (kind_of(*at) == LetterKind::mark) return *at == '#' ? syntax_.comments : at_continuation(at);
  return kind_of(*at) != LetterKind::plain;
}

inline void Scanner::skip_line_end() {
  const bool crlf = *cursor_ == '\r' && cursor_ + 1 < end_ && cursor_[1] == '\n';
  cursor_ += crlf ? 2 : 1;
  ++line_;
}

inline void Scanner::skip_blanks() {
  while (cursor_ < end_) {
    if (is_blank(*cursor_)) {
      ++cursor_;
    } else if (at_continuation(cursor_)) {
      ++cursor_;
      skip_line_end();
    } else {
      return;
    }
  }
}

inline std::string_view Scanner::token() {
  skip_blanks();
  const char* first = cursor_;
  while (cursor_ < end_ && !ends_token(cursor_)) ++cursor_;
  return {first, static_cast<size_t>(cursor_ - first)};
}

}  // namespace hooke
