// Numbers as text, for the writers.
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

// Vertices and faces as rows of text, for the writers of text formats.

/// A row per vertex: `prefix`, then x, y, z and the values of the channels as the shortest numbers that read
/// back as exactly the same.
void append_vertex_rows(std::string& text, Eigen::Ref<const Mat3X> points, const char* prefix,
                        const ChannelList& channels = {});

/// A row per vertex: `prefix`, then after a blank each value of the channels; no rows without channels.
void append_value_rows(std::string& text, const char* prefix, const ChannelList& channels);

/// A row per face: `prefix`, then after a blank each vertex id, counted from `first_id`. An id is followed by
/// each of `repeats` and the id again: { "/" } makes 7/7 of 7.
void append_face_rows(std::string& text, const std::vector<Triangle>& faces, const char* prefix, int first_id,
                      const std::vector<const char*>& repeats = {});

// A long text in pieces that are read at the same time.

/// Whole lines of a text.
struct TextPiece {
  Scanner scanner;                   // on its first line, which is not begun
  long long first_row = 0;           // rows before it; a row is a line with a token
  long long rows = 0;                // in it
  std::vector<long long> rows_of{};  // of them, with each of the keywords asked for as their first token
};

/// What is left of the scanner's text after its line, all of it, in order. How it is cut depends on the text
/// only; no line that a '\' continues is cut.
std::vector<TextPiece> remaining_pieces(Scanner scanner, std::span<const std::string_view> keywords = {});

/// Calls read(piece, index) for every piece, in parallel. Of the exceptions thrown, that of the first piece
/// goes on: it tells of the first error in the text.
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
