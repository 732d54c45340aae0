#include "hooke/io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/io/printable.h"
#include "hooke/io/scanner.h"

namespace hooke {
namespace {

PlyType read_type(Scanner& in) {
  static constexpr std::pair<std::string_view, PlyType> types[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const std::string_view word = in.token();
  for (const auto& [type_name, type] : types)
    if (word == type_name) return type;
  in.fail(fmt::format("type {}; expected char, uchar, short, ushort, int, uint, float or double; correct it",
                      in_quotes(word)));
}

std::string read_name(Scanner& in, const char* kind) {
  const std::string_view word = in.token();
  if (word.empty()) in.fail(fmt::format("{} without a name; the line ends too early; complete it", kind));
  return std::string(word);
}

template <typename Items>
void refuse_second(const Scanner& in, const Items& items, const std::string& name, const char* kind) {
  if (std::any_of(items.begin(), items.end(), [&](const auto& item) { return item.name == name; }))
    in.fail(fmt::format("{} {} declared twice; expected it once; remove one", kind, in_quotes(name)));
}

PlyEncoding read_format(Scanner& in) {
  static constexpr std::pair<std::string_view, PlyEncoding> encodings[] = {
      {"ascii", PlyEncoding::ascii},
      {"binary_little_endian", PlyEncoding::binary_little_endian},
      {"binary_big_endian", PlyEncoding::binary_big_endian}};
  const std::string_view word = in.token(), version = in.token();
  if (version != "1.0")
    in.fail(fmt::format("format version {}; expected 1.0; save it as PLY 1.0", in_quotes(version)));
  for (const auto& [encoding_name, encoding] : encodings)
    if (word == encoding_name) return encoding;
  in.fail(fmt::format("format {}; expected ascii, binary_little_endian or binary_big_endian; correct it",
                      in_quotes(word)));
}

void read_element(Scanner& in, PlyHeader& header) {
  PlyElement element;
  element.name = read_name(in, "element");
  element.count = in.integer("element count");
  if (element.count < 0)
    in.fail(fmt::format("element count {}; expected 0 or more; correct it", element.count));
  refuse_second(in, header.elements, element.name, "element");
  header.elements.push_back(std::move(element));
}

void read_property(Scanner& in, PlyHeader& header) {
  if (header.elements.empty())
    in.fail("property before any element; expected element first; correct the header");
  PlyProperty property;
  Scanner ahead = in;
  if (ahead.token() == "list") {
    in = ahead;
    property.count_type = read_type(in);
    if (!is_integer(*property.count_type))
      in.fail("list length of a floating type; expected an integer type; correct it");
  }
  property.type = read_type(in);
  property.name = read_name(in, "property");
  refuse_second(in, header.elements.back().properties, property.name, "property");
  header.elements.back().properties.push_back(std::move(property));
}

// The body begins right after the line end that the header uses: its first byte may look like another one.
size_t line_end_size(std::string_view text) {
  const size_t end = text.find_first_of("\r\n");
  return end != text.npos && text[end] == '\r' && text.substr(end + 1, 1) == "\n" ? 2 : 1;
}

void expect_line_end(Scanner& in) {
  if (const std::string_view more = in.token(); !more.empty())
    in.fail(fmt::format("{} at the end of a header line; expected nothing more; correct the header",
                        in_quotes(more)));
}

}  // namespace

size_t size_of(PlyType type) {
  static constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<size_t>(type)];
}

PlyHeader read_ply_header(std::string_view text, const std::string& name) {
  Scanner in(text, name, {});
  PlyHeader header;
  bool has_format = false;
  if (!in.next_line() || !equal_ignoring_case(in.token(), "ply"))
    in.fail("no 'ply' at the start; is this a PLY file?");
  expect_line_end(in);
  while (in.next_line()) {
    const std::string_view keyword = in.token();
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "end_header") {
      expect_line_end(in);
      if (!has_format)
        in.fail("no format line; expected 'format ascii 1.0' or a binary one; correct the header");
      header.size = std::min(in.offset() + line_end_size(text), text.size());
      header.lines = in.line();
      return header;
    }
    if (keyword == "format" && !has_format) {
      header.encoding = read_format(in);
      has_format = true;
    } else if (keyword == "element") {
      read_element(in, header);
    } else if (keyword == "property") {
      read_property(in, header);
    } else {
      in.fail(fmt::format(
          "header line {}; expected format (once), comment, element, property or end_header; correct it",
          in_quotes(keyword)));
    }
    expect_line_end(in);
  }
  in.fail("the file ends in its header; expected end_header; the file is cut");
}

const PlyElement& find_element(const PlyHeader& header, std::string_view element_name,
                               const std::string& name) {
  for (const PlyElement& element : header.elements)
    if (element.name == element_name) return element;
  throw InputError(fmt::format(
      "{}: no element '{}' in the header; expected a mesh of vertices and faces; is it a point cloud?", name,
      element_name));
}

}  // namespace hooke
