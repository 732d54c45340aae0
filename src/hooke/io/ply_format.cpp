#include "hooke/io/ply_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
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

// Length of the line end that the header uses. A binary body starts right after it and may itself begin with
// a byte that looks like a line end.
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

bool swaps_bytes(PlyEncoding encoding) {
  return swaps_bytes(encoding == PlyEncoding::binary_big_endian ? std::endian::big : std::endian::little);
}

bool is_corner_list(const PlyProperty& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

int coordinate_of(const PlyProperty& property) {
  return property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : -1;
}

long long row_count(const PlyElement& element) {
  return element.properties.empty() ? 0 : element.count;
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

namespace {

bool is_one_line(std::string_view body) {
  const size_t first = body.find_first_not_of(" \t\r\n");
  const size_t line_end = body.find_first_of("\r\n", first);
  return first == body.npos || line_end == body.npos ||
         body.find_first_not_of(" \t\r\n", line_end) == body.npos;
}

std::string too_few_bytes(const PlyElement& element, size_t remaining) {
  return fmt::format(
      "{} {} elements, but only {} bytes follow; expected as many as there are; the file is cut or the count "
      "is wrong",
      element.count, in_quotes(element.name), remaining);
}

bool fits(long long rows, size_t row_size, size_t bytes) {
  return row_size == 0 || static_cast<unsigned long long>(rows) <= bytes / row_size;
}

}  // namespace

AsciiPlyBody::AsciiPlyBody(std::string_view text, const std::string& name, const PlyHeader& header)
    : in_(text.substr(header.size), name, {}, header.lines + 1),
      one_line_(is_one_line(text.substr(header.size))) {}

void AsciiPlyBody::begin_element(const PlyElement& element) {
  const size_t shortest_row =
      2 * element.properties.size();  // each value takes at least a digit and a separator
  if (!fits(element.count, shortest_row, in_.remaining() + 1)) fail(too_few_bytes(element, in_.remaining()));
}

void AsciiPlyBody::begin_row(const PlyElement& element, long long row) {
  if (started_ && one_line_) return;
  started_ = true;
  if (!in_.next_line())
    fail(fmt::format(
        "the file ends before {} {} of {} (counted from 0); the file is cut or the count is wrong",
        in_quotes(element.name), row, element.count));
}

void AsciiPlyBody::end_row() {
  if (one_line_) return;
  if (const std::string_view more = in_.token(); !more.empty())
    fail(fmt::format("{} after the last value of the row; expected the line end; are the counts right?",
                     in_quotes(more)));
}

void AsciiPlyBody::skip(PlyType) {
  if (in_.token().empty()) fail("a value is missing; the line ends too early; complete it");
}

double AsciiPlyBody::any_number(PlyType type, const std::string& what) {
  const std::string_view token = in_.token();
  const bool negative = token.starts_with('-');
  const std::string_view word = token.substr(negative || token.starts_with('+') ? 1 : 0);
  if (!is_integer(type)) {
    if (equal_ignoring_case(word, "nan")) return std::numeric_limits<double>::quiet_NaN();
    if (equal_ignoring_case(word, "inf") || equal_ignoring_case(word, "infinity"))
      return (negative ? -1 : 1) * std::numeric_limits<double>::infinity();
  }
  if (token.empty()) fail("a value is missing; the line ends too early; complete it");
  return in_.number(token, what);
}

void AsciiPlyBody::finish() {
  if ((one_line_ && !in_.token().empty()) || in_.next_line())
    fail("text after the last element; expected the end of the file; are the counts of the header right?");
}

BinaryPlyBody::BinaryPlyBody(std::string_view bytes, const std::string& name, const PlyHeader& header)
    : begin_(bytes.data()),
      cursor_(begin_ + header.size),
      end_(begin_ + bytes.size()),
      name_(name),
      swap_(swaps_bytes(header.encoding)) {}

void BinaryPlyBody::begin_element(const PlyElement& element) {
  element_ = &element;
  row_ = 0;
  size_t shortest_row = 0;
  for (const PlyProperty& property : element.properties)
    shortest_row += size_of(property.count_type.value_or(property.type));
  const size_t remaining = end_ - cursor_;
  if (!fits(element.count, shortest_row, remaining)) fail(too_few_bytes(element, remaining));
}

void BinaryPlyBody::begin_row(const PlyElement&, long long row) {
  row_ = row;
}

void BinaryPlyBody::finish() const {
  // Line ends after the last element are accepted, as some writers add them.
  if (std::any_of(cursor_, end_, [](char c) { return !is_line_end(c); }))
    throw InputError(
        fmt::format("{}: {} bytes after the last element; expected the end of the file; are the counts of "
                    "the header right?",
                    name_, end_ - cursor_));
}

const char* BinaryPlyBody::take(size_t size) {
  if (std::cmp_less(end_ - cursor_, size))
    fail("the file ends here; expected more values; it is cut or a count is wrong");
  const char* at = cursor_;
  cursor_ += size;
  return at;
}

double BinaryPlyBody::number(PlyType type, const char* what) {
  const double x = any_number(type, what);
  if (!std::isfinite(x)) fail(fmt::format("{} is {}; expected a finite number; correct it", what, x));
  return x;
}

double BinaryPlyBody::any_number(PlyType type, const std::string&) {
  return binary_number(raw(type), type, swap_);
}

long long BinaryPlyBody::integer(PlyType type, const char* what) {
  if (!is_integer(type))
    fail(fmt::format("{} is of a floating type; expected an integer type; correct the header", what));
  return static_cast<long long>(any_number(type, what));
}

void BinaryPlyBody::fail(std::string_view message) const {
  throw InputError(fmt::format("{}: {} {}, byte {}: {}", name_, printable(element_->name), row_,
                               cursor_ - begin_, message));
}

}  // namespace hooke
