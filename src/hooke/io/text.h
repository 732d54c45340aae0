// Conversion between meshes and text: numbers and rows for the writers, and division of a long text into
// pieces that are read in parallel.
#pragma once

#include <algorithm>
#include <charconv>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "hooke/core/parallel.h"
#include "hooke/io/scanner.h"
#include "hooke/mesh/attributes.h"

namespace hooke {

/// Appends the shortest text that reads back exactly as this number, independent of the locale.
template <typename Number>
void append_number(std::string& text, Number value) {
  char digits[32];  // a double takes at most 24
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

/// Appends a row per vertex: `prefix`, x, y, z and the values of the channels. Numbers read back exactly.
void append_vertex_rows(std::string& text, const Eigen::Ref<const Mat3X>& points, const char* prefix,
                        const ChannelList& channels = {});

/// Appends a row per vertex: `prefix`, then each value of the channels after a blank. Without channels it
/// appends nothing.
void append_value_rows(std::string& text, const char* prefix, const ChannelList& channels);

/// Appends a row per face: `prefix`, then each vertex id after a blank, numbered from `first_id`, and the
/// values of the channels. Each of `repeats` appends that separator and the id again: { "/" } gives 7/7 for
/// id 7.
void append_face_rows(std::string& text, const std::vector<Triangle>& faces, const char* prefix, int first_id,
                      const std::vector<const char*>& repeats = {}, const ChannelList& channels = {});

/// Appends all pieces, in order.
void append_all(std::string& text, const std::vector<std::string>& pieces);

/// A piece of a text, made of whole lines.
struct TextPiece {
  Scanner scanner;                   // before the first line of the piece
  long long first_row = 0;           // rows before the piece; a row is a line with a token
  long long rows = 0;                // rows in the piece
  std::vector<long long> rows_of{};  // rows that start with each of the requested keywords
};

/// Divides the text after the scanner's current line into pieces, in order. The division depends on the text
/// only and does not separate lines joined by '\'.
std::vector<TextPiece> remaining_pieces(Scanner scanner, std::span<const std::string_view> keywords = {});

/// Calls read(piece, index) for every piece, in parallel. If several throw, the exception of the first piece
/// is rethrown, which reports the first error in the text.
template <typename Read>
void read_pieces(const std::vector<TextPiece>& pieces, const Read& read) {
  std::vector<std::exception_ptr> errors(pieces.size());
  parallel_for(pieces.size(), 1, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) try {
        read(pieces[p], p);
      } catch (...) {
        errors[p] = std::current_exception();
      }
  });
  const auto first = std::ranges::find_if(errors, [](const auto& error) { return error != nullptr; });
  if (first != errors.end()) std::rethrow_exception(*first);
}

}  // namespace hooke
