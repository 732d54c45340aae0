#include "text_columns.h"

#include <algorithm>

namespace hooke::app {

std::string wrapped(std::string_view text, std::size_t indent, std::size_t begin) {
  std::string lines;
  std::size_t column = begin;
  bool line_is_empty = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::size_t length = end - at;
    if (!line_is_empty && column + 1 + length > terminal_columns) {
      lines += '\n' + std::string(indent, ' ');
      column = indent;
      line_is_empty = true;
    }
    if (!line_is_empty) {
      lines += ' ';
      ++column;
    }
    lines.append(text, at, length);
    column += length;
    line_is_empty = false;
    at = end + 1;
  }
  return lines;
}

}  // namespace hooke::app
