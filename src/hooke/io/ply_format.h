// The header of a PLY file: which elements follow, and how their values are written.
// Source: Greg Turk, "The PLY Polygon File Format", Stanford University, 1994.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hooke/io/mesh_file.h"
#include "hooke/io/scanner.h"

namespace hooke {

using PlyType = NumberType;  // PLY has just these

/// Bytes of a value in a binary file.
size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::int32;      // of the value, or of the entries of a list
  std::optional<PlyType> count_type;  // of a list's length; none for a scalar
};

struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement>
      elements;     // in the order of the body; names differ, and so do those of their properties
  size_t size = 0;  // bytes up to the body
  int lines = 0;
};

/// Throws InputError "NAME:LINE: ...". Counts are not negative; whether the body holds that many is not known
/// yet.
PlyHeader read_ply_header(std::string_view text, const std::string& name);

/// The element of that name. Throws InputError "NAME: ..." without one.
const PlyElement& find_element(const PlyHeader& header, std::string_view element_name,
                               const std::string& name);

// The two ways in which the values of a PLY body are written, behind one face: rows of numbers and lists.

/// Values in text: one row on a line, or the whole body on a single line.
class AsciiPlyBody {
 public:
  AsciiPlyBody(std::string_view text, const std::string& name, const PlyHeader& header);

  /// Rows on lines of their own that the scanner comes to.
  explicit AsciiPlyBody(Scanner rows) : in_(std::move(rows)), one_line_(false) {}

  bool one_line() const { return one_line_; }
  const Scanner& scanner() const { return in_; }

  /// Throws InputError if the rows of the element cannot be there, before anybody allocates memory for them.
  void begin_element(const PlyElement& element);
  void begin_row(const PlyElement& element, long long row);
  void end_row();
  void skip(PlyType type);
  void finish();

  double number(PlyType, const char* what) { return in_.number(what); }
  /// A number that need not be finite.
  double any_number(PlyType type, const std::string& what);
  long long integer(PlyType, const char* what) { return in_.integer(what); }
  int line() const { return in_.line(); }
  [[noreturn]] void fail(std::string_view message) const { in_.fail(message); }

 private:
  Scanner in_;
  bool one_line_;
  bool started_ = false;
};

/// Values as bytes. A place in an error message is the element, its row and the byte offset.
class BinaryPlyBody {
 public:
  BinaryPlyBody(std::string_view bytes, const std::string& name, const PlyHeader& header);

  void begin_element(const PlyElement& element);
  void begin_row(const PlyElement& element, long long row);
  void end_row() {}
  void skip(PlyType type) { take(size_of(type)); }
  void finish() const;

  double number(PlyType type, const char* what);
  double any_number(PlyType type, const std::string& what);
  long long integer(PlyType type, const char* what);
  int line() const { return 0; }
  [[noreturn]] void fail(std::string_view message) const;

 private:
  const char* take(size_t size);
  template <typename T>
  T value();

  const char* begin_;
  const char* cursor_;
  const char* end_;
  std::string name_;
  bool swap_;
  const PlyElement* element_ = nullptr;
  long long row_ = 0;
};

/// Passes over a value or a list.
template <typename Body>
void skip_property(Body& body, const PlyProperty& property) {
  long long count = 1;
  if (property.count_type) count = body.integer(*property.count_type, "list length");
  if (count < 0) body.fail(fmt::format("list length {}; expected 0 or more; correct it", count));
  for (long long k = 0; k < count; ++k) body.skip(property.type);
}

/// Rows of an element, counted from 0.
struct PlyRows {
  long long begin = 0, end = 0;
};

/// Passes over rows of the element.
template <typename Body>
void skip_rows(Body& body, const PlyElement& element, const PlyRows& rows) {
  for (long long row = rows.begin; row < rows.end; ++row) {
    body.begin_row(element, row);
    for (const PlyProperty& property : element.properties) skip_property(body, property);
    body.end_row();
  }
}

/// Passes over all rows of the element.
template <typename Body>
void skip_element(Body& body, const PlyElement& element) {
  if (element.properties.empty()) return;  // its rows take no bytes, however many there are
  skip_rows(body, element, {0, element.count});
}

}  // namespace hooke
