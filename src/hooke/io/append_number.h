// Numbers as text, for the writers.
#pragma once

#include <charconv>
#include <string>

namespace hooke {

/// Appends the shortest text that reads back as exactly this number; independent of the locale.
template <typename Number>
void append_number(std::string& text, Number value) {
  char digits[32];  // the longest double takes 24
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Appends x, y and z with `separator` between them.
template <typename Numbers>
void append_three(std::string& text, const Numbers& three, char separator = ' ') {
  append_number(text, three[0]);
  text += separator;
  append_number(text, three[1]);
  text += separator;
  append_number(text, three[2]);
}

}  // namespace hooke
