// The header of a PLY file, which describes its elements and properties, and readers of its body, as text and
// binary.
// Source: Greg Turk, "The PLY Polygon File Format", Stanford University, 1994.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hooke/io/binary_numbers.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/scanner.h"
#include "hooke/io/text.h"

namespace hooke {

using PlyType = NumberType;  // PLY has exactly these types

/// Whether binary bodies of this encoding have the other byte order than this machine.
bool swaps_bytes(PlyEncoding encoding);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::int32;      // of the value, or of the entries of a list property
  std::optional<PlyType> count_type;  // type of a list's length; none for a scalar property
};

struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement>
      elements;     // in file order; element names are unique, and so are property names within an element
  size_t size = 0;  // bytes before the body
  int lines = 0;    // lines before the body
};

/// Parses the header. Throws InputError "NAME:LINE: ...". Counts are not negative, but not checked against
/// the size of the body.
PlyHeader read_ply_header(std::string_view text, const std::string& name);

/// The element of that name. Throws InputError "NAME: ..." if there is none.
const PlyElement& find_element(const PlyHeader& header, std::string_view element_name,
                               const std::string& name);

// Readers of the body with a common interface: an element is a sequence of rows of numbers and lists.

/// Reads values as text: one row per line, or the whole body on a single line.
class AsciiPlyBody {
 public:
  AsciiPlyBody(std::string_view text, const std::string& name, const PlyHeader& header);

  /// Reads rows, one per line, from the current position of the scanner.
  explicit AsciiPlyBody(Scanner rows) : in_(std::move(rows)), one_line_(false) {}

  bool one_line() const { return one_line_; }
  const Scanner& scanner() const { return in_; }

  /// Throws InputError if the rest of the file is too short for the rows of the element. To be called before
  /// memory is allocated for them.
  void begin_element(const PlyElement& element);
  void begin_row(const PlyElement& element, long long row);
  void end_row();
  void skip(PlyType type);
  void finish();

  /// The text of the next number; empty if it is missing.
  std::string_view raw(PlyType) { return in_.token(); }

  double number(PlyType, const char* what) { return in_.number(what); }
  /// Reads a number that need not be finite.
  double any_number(PlyType type, const std::string& what);
  long long integer(PlyType, const char* what) { return in_.integer(what); }
  int line() const { return in_.line(); }
  [[noreturn]] void fail(std::string_view message) const { in_.fail(message); }

 private:
  Scanner in_;
  bool one_line_;
  bool started_ = false;
};

/// Reads binary values. Error messages give the element, its row and the byte offset.
class BinaryPlyBody {
 public:
  BinaryPlyBody(std::string_view bytes, const std::string& name, const PlyHeader& header);

  void begin_element(const PlyElement& element);
  void begin_row(const PlyElement& element, long long row);
  void end_row() {}
  void skip(PlyType type) { take(size_of(type)); }
  void finish() const;

  /// The bytes of the next number.
  std::string_view raw(PlyType type) { return {take(size_of(type)), size_of(type)}; }

  double number(PlyType type, const char* what);
  double any_number(PlyType type, const std::string& what);
  long long integer(PlyType type, const char* what);
  int line() const { return 0; }
  [[noreturn]] void fail(std::string_view message) const;

 private:
  const char* take(size_t size);

  const char* begin_;
  const char* cursor_;
  const char* end_;
  std::string name_;
  bool swap_;
  const PlyElement* element_ = nullptr;
  long long row_ = 0;
};

/// Whether the face property lists the corners.
bool is_corner_list(const PlyProperty& property);

/// Index (0 to 2) of the coordinate that the vertex property is; -1 for none.
int coordinate_of(const PlyProperty& property);

/// Rows of the element in the file: none without properties, whatever its count.
long long row_count(const PlyElement& element);

/// Skips a value or a list.
template <typename Body>
void skip_property(Body& body, const PlyProperty& property) {
  long long count = 1;
  if (property.count_type) count = body.integer(*property.count_type, "list length");
  if (count < 0) body.fail(fmt::format("list length {}; expected 0 or more; correct it", count));
  for (long long k = 0; k < count; ++k) body.skip(property.type);
}

/// The range [begin, end) of rows of an element, 0-based.
struct PlyRows {
  long long begin = 0, end = 0;
};

/// Skips a range of rows of the element.
template <typename Body>
void skip_rows(Body& body, const PlyElement& element, const PlyRows& rows) {
  for (long long row = rows.begin; row < rows.end; ++row) {
    body.begin_row(element, row);
    for (const PlyProperty& property : element.properties) skip_property(body, property);
    body.end_row();
  }
}

/// Calls use(element, rows) for the rows of each element in a piece of a body with one row a line.
template <typename Use>
void for_rows_of_piece(const PlyHeader& header, const TextPiece& piece, const Use& use) {
  long long before = 0;  // rows of the preceding elements
  for (const PlyElement& element : header.elements) {
    const auto row = [&](long long of_body) { return std::clamp(of_body - before, 0LL, row_count(element)); };
    use(element, PlyRows{row(piece.first_row), row(piece.first_row + piece.rows)});
    before += row_count(element);
  }
}

/// Skips all rows of the element.
template <typename Body>
void skip_element(Body& body, const PlyElement& element) {
  if (element.properties.empty()) return;  // an element without properties has no rows in the file
  skip_rows(body, element, {0, element.count});
}

}  // namespace hooke
