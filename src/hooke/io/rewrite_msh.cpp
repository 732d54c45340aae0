#include "hooke/io/rewrite_formats.h"

#include <fmt/format.h>

#include <algorithm>

#include "hooke/io/binary_numbers.h"
#include "hooke/io/edited_copy.h"
#include "hooke/io/msh_format.h"
#include "hooke/io/scanner.h"

namespace hooke {
namespace {

// What would not fit moved nodes any more; empty if there is nothing.
std::string misfit_of(const MshContent& content) {
  for (const auto& [plural, others] : content.other_elements)
    if (!others.is_straight) return plural;
  if (content.has_parameters) return "parametric coordinates";
  for (const char* section : {"$Periodic", "$Parametrizations"})
    if (std::ranges::find(content.other_sections, section) != content.other_sections.end())
      return fmt::format("section {}", section);
  return "";
}

void set_binary_coordinates(const MshContent& content, const Mat3X& points, std::string& bytes) {
  for (size_t n = 0; n < content.nodes.size(); ++n) {
    if (content.vertex[n] < 0) continue;
    char* at = bytes.data() + content.coordinates[n];
    for (const double x : points.col(content.vertex[n]))
      put_binary(at, NumberType::float64, x, content.swapped);
  }
}

std::string with_coordinates(const MshContent& content, std::string_view text, const Mat3X& points) {
  const auto is_space = [](char c) { return is_blank(c) || is_line_end(c); };
  EditedCopy copy(text);
  for (size_t n = 0; n < content.nodes.size(); ++n) {
    if (content.vertex[n] < 0) continue;
    size_t at = content.coordinates[n];
    for (const double x : points.col(content.vertex[n])) {
      while (is_space(text[at])) ++at;  // a number follows, as when it was read
      size_t end = at;
      while (end < text.size() && !is_space(text[end])) ++end;
      copy.set_number(text.substr(at, end - at), x);
      at = end;
    }
  }
  return std::move(copy).finish();
}

}  // namespace

RewrittenMesh rewrite_msh(std::string_view bytes, const std::string& name, const Mat3X& points) {
  const MshContent content = read_msh_content(bytes, name);
  RewrittenMesh result;
  if (const std::string misfit = misfit_of(content); !misfit.empty())
    result.obstacle = fmt::format("its {} would not fit moved nodes", misfit);
  else if (content.binary)
    set_binary_coordinates(content, points, result.bytes = bytes);
  else
    result.bytes = with_coordinates(content, bytes, points);
  return result;
}

}  // namespace hooke
