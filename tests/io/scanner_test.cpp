#include "hooke/io/scanner.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/text.h"
#include "support/errors.h"

namespace hooke::scanner_test {

NumberError parse(std::string_view text) {
  double value = 0;
  return parse_number(text, value);
}

double value_of(std::string_view text) {
  double value = 0;
  EXPECT_EQ(parse_number(text, value), NumberError::none) << text;
  return value;
}

TEST(Numbers, AreTheNearestDouble) {
  EXPECT_EQ(value_of("+0.5"), .5);
  EXPECT_EQ(value_of(".5"), .5);
  EXPECT_EQ(value_of("5."), 5);
  EXPECT_EQ(value_of("-1E+2"), -100);
  EXPECT_EQ(value_of("0.1000000000000000055511151231257827"), .1);
  EXPECT_EQ(value_of("1e-320"), 1e-320);
  EXPECT_EQ(value_of("4.9e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(value_of("1e-400"), 0);
  EXPECT_TRUE(std::signbit(value_of("-1e-400")));
  EXPECT_EQ(value_of("1.7976931348623157e308"), std::numeric_limits<double>::max());
}

TEST(Numbers, OthersAreRefused) {
  for (const char* text : {"", "+", "-", ".", "abc", "1,5", "1.0abc", "0x1p3", "5.0D-1", "nan", "-nan(ind)",
                           "inf", "-Infinity", "+-1", "++1", "1e", "1 "})
    EXPECT_EQ(parse(text), NumberError::malformed) << text;
  EXPECT_EQ(parse("1e400"), NumberError::too_large);
  EXPECT_EQ(parse("-1e400"), NumberError::too_large);
  long long integer = 0;
  for (const char* text : {"", "+", "1.0", "1e3", "0x10", "3.7", "f"})
    EXPECT_EQ(parse_integer(text, integer), NumberError::malformed) << text;
  EXPECT_EQ(parse_integer("9223372036854775808", integer), NumberError::too_large);
}

TEST(Numbers, ReadBackExactlyAsWritten) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 20000; ++k) {
    const auto x = std::bit_cast<double>(random());
    if (!std::isfinite(x)) continue;
    std::string text;
    append_number(text, x);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(value_of(text)), std::bit_cast<std::uint64_t>(x)) << text;
  }
}

TEST(Scanner, CountsLinesOfEveryKindOfLineEnd) {
  Scanner in("a\r\n\r\nb\rc\n\nd", "f", {});
  for (const auto& [token, line] : {std::pair{"a", 1}, {"b", 3}, {"c", 4}, {"d", 6}}) {
    ASSERT_TRUE(in.next_line());
    EXPECT_EQ(in.token(), token);
    EXPECT_EQ(in.line(), line);
    EXPECT_TRUE(in.token().empty());
  }
  EXPECT_FALSE(in.next_line());
}

TEST(Scanner, NextLinePassesOverTheRestOfTheLine) {
  Scanner in("a b c\nd", "f", {});
  ASSERT_TRUE(in.next_line());
  EXPECT_EQ(in.token(), "a");
  ASSERT_TRUE(in.next_line());
  EXPECT_EQ(in.token(), "d");
}

TEST(Scanner, CommentsAndContinuationsOnlyWhereTheSyntaxHasThem) {
  const std::string text = "a#x \\\n \\\n b\n";
  Scanner with(text, "f", {.comments = true, .continuations = true});
  ASSERT_TRUE(with.next_line());
  EXPECT_EQ(with.token(), "a");
  EXPECT_TRUE(with.token().empty());  // the comment hides its '\'
  ASSERT_TRUE(with.next_line());
  EXPECT_EQ(with.token(), "b");
  EXPECT_EQ(with.line(), 3);
  Scanner without(text, "f", {});
  ASSERT_TRUE(without.next_line());
  EXPECT_EQ(without.token(), "a#x");
  EXPECT_EQ(without.token(), "\\");
}

TEST(Scanner, ErrorsNameFileLineAndContent) {
  Scanner in("\n1 \x1b[31m\n", "f.obj", {});
  in.next_line();
  EXPECT_EQ(in.integer("count"), 1);
  EXPECT_ERROR(InputError, "f.obj:2: x is '\\x1b[31m'; expected", in.number("x"));
  EXPECT_ERROR(InputError, "f.obj:2: y is missing; ", in.number("y"));
}

TEST(Printable, IsOneLineOfUtf8WithoutControlCharacters) {
  EXPECT_EQ(printable("a b %s \"x\" \u00fc\u7f51\U0001f600"), "a b %s \"x\" \u00fc\u7f51\U0001f600");
  EXPECT_EQ(printable("a\nb\r\t\x1b[0m\x7f"), "a\\nb\\r\\t\\x1b[0m\\x7f");
  EXPECT_EQ(printable("\xc3"), "\\xc3");                    // cut
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");           // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // surrogate
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b");           // control sequence introducer
  EXPECT_EQ(in_quotes(std::string(100, 'a')), fmt::format("'{:a>40}...'", ""));
}

}  // namespace hooke::scanner_test
