// The two ways in which the values of a PLY body are written, behind one face: rows of numbers and lists.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "hooke/io/ply_header.h"
#include "hooke/io/scanner.h"

namespace hooke {

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
