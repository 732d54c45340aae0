// A copy of some bytes in which parts are replaced: how a file is written again with other numbers and
// everything else as it was. Shared by the rewriters of each format.
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hooke/io/scanner.h"
#include "hooke/io/text.h"

namespace hooke {

class EditedCopy {
 public:
  /// The source must outlive the copy.
  explicit EditedCopy(std::string_view source) : source_(source) {
    result_.reserve(source.size() + source.size() / 2);
  }

  /// Replaces a part of the source, which must lie behind the parts replaced before.
  void replace(std::string_view part, std::string_view by) {
    const std::size_t begin = part.data() - source_.data();
    result_.append(source_, copied_, begin - copied_);
    result_.append(by);
    copied_ = begin + part.size();
  }

  /// Replaces a part by the shortest text that reads back exactly as this number.
  template <typename Number>
  void replace_by_number(std::string_view part, Number value) {
    char digits[32];  // a double takes at most 24
    const char* const end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    replace(part, {digits, static_cast<std::size_t>(end - digits)});
  }

  /// The same, but keeps the text of a number that has this value already.
  void set_number(std::string_view part, double value) {
    double old = 0;
    if (parse_number(part, old) != NumberError::none || old != value) replace_by_number(part, value);
  }

  /// The same for a component of a unit normal, in single precision, which keeps a text of that precision.
  void set_normal(std::string_view part, double value) {
    constexpr double precision = 1e-7;
    double old = 0;
    if (parse_number(part, old) != NumberError::none || !(std::abs(old - value) <= precision))
      replace_by_number(part, static_cast<float>(value) + 0.f);  // no -0
  }

  /// The copy with the rest of the source. To be called once.
  std::string finish() && {
    result_.append(source_, copied_);
    return std::move(result_);
  }

 private:
  std::string_view source_;
  std::size_t copied_ = 0;  // bytes of the source that are dealt with
  std::string result_;
};

/// The text with edit(piece, index, copy) applied to a copy of every piece, in parallel. The pieces are those
/// that remaining_pieces() made of the text.
template <typename Edit>
std::string edited_text(std::string_view text, const std::vector<TextPiece>& pieces, const Edit& edit) {
  const std::size_t before =
      pieces.empty() ? text.size()
                     : static_cast<std::size_t>(pieces.front().scanner.rest().data() - text.data());
  std::vector<std::string> copies(pieces.size() + 1);
  copies[0] = text.substr(0, before);
  read_pieces(pieces, [&](const TextPiece& piece, std::size_t p) {
    EditedCopy copy(piece.scanner.rest());
    edit(piece, p, copy);
    copies[p + 1] = std::move(copy).finish();
  });
  std::string all;
  append_all(all, copies);
  return all;
}

}  // namespace hooke
