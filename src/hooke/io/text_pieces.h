// A long text in pieces that are read at the same time.
#pragma once

#include <algorithm>
#include <exception>
#include <span>
#include <vector>

#include "hooke/core/parallel.h"
#include "hooke/io/scanner.h"

namespace hooke {

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
