// Walks over a text held in memory: lines, tokens, numbers. Shared by the readers of text formats.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace hooke {

/// Why a token is not the number it should be.
enum class NumberError { none, malformed, too_large };

/// Reads all of `token` as a decimal number: finite, '.' as decimal point whatever the locale, a leading '+'
/// allowed, no hex, no Fortran exponent. Below the least subnormal it is the nearest double, 0.
NumberError parse_number(std::string_view token, double& value);

/// Reads all of `token` as a decimal integer, a leading '+' allowed.
NumberError parse_integer(std::string_view token, long long& value);

/// Whether two texts are equal but for the case of ASCII letters.
bool equal_ignoring_case(std::string_view a, std::string_view b);

/// A cursor on a text. Lines end at LF, CR LF or CR and are counted from 1; tokens are separated by blanks.
class Scanner {
 public:
  struct Syntax {
    bool comments = false;  // '#' hides the rest of its line
    bool continuations =
        false;  // a '\' before the line end joins the next line to this one (not in comments)
  };

  Scanner(std::string_view text, std::string name, Syntax syntax, int first_line = 1);

  /// Goes to the next line that has a token (on the first call: the first one). False at the end of the text.
  bool next_line();

  /// The next token of this line; empty at its end.
  std::string_view token();

  /// The next token of this line as a number. `what` names it in the message of the InputError thrown
  /// otherwise.
  double number(std::string_view what);
  long long integer(std::string_view what);

  /// The same for a token at hand.
  double number(std::string_view token, std::string_view what) const;
  long long integer(std::string_view token, std::string_view what) const;

  /// Goes past the end of this line, where next_line() begins.
  void finish_line();

  /// What has not been read yet.
  std::string_view rest() const { return {cursor_, remaining()}; }

  /// A scanner with the same name and syntax on another text.
  Scanner on(std::string_view text, int first_line) const { return {text, name_, syntax_, first_line}; }

  int line() const { return line_; }
  size_t offset() const { return static_cast<size_t>(cursor_ - begin_); }
  size_t remaining() const { return static_cast<size_t>(end_ - cursor_); }

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

// The hot part, inline: a text is looked at letter by letter.

enum class LetterKind : unsigned char {
  plain,
  blank,
  line_end,
  mark,  // a '#' or a '\\': what it means depends on the syntax
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
