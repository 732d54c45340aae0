// The header of an OFF file: its keyword and counts.
// Source: The Geometry Center, "Geomview Manual", section "OFF: Object File Format".
#pragma once

#include "hooke/io/scanner.h"

namespace hooke {

/// The syntax of OFF texts.
inline constexpr Scanner::Syntax off_syntax = {.comments = true};

struct OffHeader {
  bool texture = false, colours = false, normals = false;  // prefixes ST, C, N
  bool binary = false;                                     // the counts are then in the body
  int vertices = 0, faces = 0;
};

/// Reads the keyword, if there is one, and the counts of a text. The scanner is then in the line of the
/// counts, or of the keyword of a binary file. Throws InputError "NAME:LINE: ...", also for 4OFF and nOFF,
/// and for counts that exceed the bytes that follow.
OffHeader read_off_header(Scanner& in);

}  // namespace hooke
