#include "hooke/io/scanner.h"

#include <fmt/format.h>
#include <locale.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"

namespace hooke {
namespace {

std::string_view without_plus(std::string_view token) {
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '+' && token[1] != '-';
  return plus ? token.substr(1) : token;
}

// Distinguishes overflow from underflow, which from_chars does not, with strtod in the C locale.
NumberError parse_out_of_range(std::string_view token, double& value) {
  const std::string text(token);
  const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  value = strtod_l(text.c_str(), nullptr, c_locale);
  freelocale(c_locale);
  return std::isfinite(value) ? NumberError::none : NumberError::too_large;
}

}  // namespace

NumberError parse_number(std::string_view token, double& value) {
  token = without_plus(token);
  const char* end = token.data() + token.size();
  const auto [rest, error] = std::from_chars(token.data(), end, value);
  if (error == std::errc::invalid_argument || rest != end) return NumberError::malformed;
  if (error == std::errc::result_out_of_range) return parse_out_of_range(token, value);
  return std::isfinite(value) ? NumberError::none : NumberError::malformed;
}

NumberError parse_integer(std::string_view token, long long& value) {
  token = without_plus(token);
  const char* end = token.data() + token.size();
  const auto [rest, error] = std::from_chars(token.data(), end, value);
  if (error == std::errc::invalid_argument || rest != end) return NumberError::malformed;
  return error == std::errc() ? NumberError::none : NumberError::too_large;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

Scanner::Scanner(std::string_view text, std::string name, Syntax syntax, int first_line)
    : begin_(text.data()),
      cursor_(text.data()),
      end_(text.data() + text.size()),
      name_(std::move(name)),
      syntax_(syntax),
      line_(first_line) {}

void Scanner::skip_line() {
  while (cursor_ < end_ && !is_line_end(*cursor_)) {
    const bool is_mark = kind_of(*cursor_) == LetterKind::mark;
    if (is_mark && *cursor_ == '#' && syntax_.comments) {
      while (cursor_ < end_ && !is_line_end(*cursor_)) ++cursor_;
    } else {
      const bool continues = is_mark && at_continuation(cursor_);
      ++cursor_;
      if (continues) skip_line_end();
    }
  }
}

bool Scanner::next_line() {
  if (started_) skip_line();
  started_ = true;
  while (true) {
    skip_blanks();
    if (cursor_ == end_) return false;
    if (is_line_end(*cursor_))
      skip_line_end();
    else if (*cursor_ == '#' && syntax_.comments)
      skip_line();
    else
      return true;
  }
}

void Scanner::finish_line() {
  if (!started_) return;
  skip_line();
  if (cursor_ < end_) skip_line_end();
  started_ = false;
}

double Scanner::number(std::string_view what) {
  return number(token(), what);
}

long long Scanner::integer(std::string_view what) {
  return integer(token(), what);
}

double Scanner::number(std::string_view token, std::string_view what) const {
  double value = 0;
  if (token.empty()) fail(fmt::format("{} is missing; the line ends too early; complete it", what));
  const NumberError error = parse_number(token, value);
  if (error == NumberError::malformed)
    fail(fmt::format("{} is {}; expected a finite decimal number like 1.5e-3; correct it", what,
                     in_quotes(token)));
  if (error == NumberError::too_large)
    fail(fmt::format("{} is {}; expected at most 1.8e308 in size; scale the mesh down", what,
                     in_quotes(token)));
  return value;
}

long long Scanner::integer(std::string_view token, std::string_view what) const {
  long long value = 0;
  if (token.empty()) fail(fmt::format("{} is missing; the line ends too early; complete it", what));
  const NumberError error = parse_integer(token, value);
  if (error == NumberError::malformed)
    fail(fmt::format("{} is {}; expected an integer; correct it", what, in_quotes(token)));
  if (error == NumberError::too_large)
    fail(fmt::format("{} is {}; expected an integer of at most 64 bits; correct it", what, in_quotes(token)));
  return value;
}

void Scanner::fail_at(int line, std::string_view message) const {
  throw InputError(fmt::format("{}:{}: {}", name_, line, message));
}

}  // namespace hooke
