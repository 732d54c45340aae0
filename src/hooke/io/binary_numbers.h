// Numbers in binary files, of any type and in both byte orders.
#pragma once

#include <bit>
#include <string_view>

#include "hooke/mesh/attributes.h"

namespace hooke {

/// Size of a number in bytes.
size_t size_of(NumberType type);

/// Whether numbers of this byte order are reversed on this machine.
bool swaps_bytes(std::endian order);

/// The number that these bytes hold, at least as many as the type takes; `swap` reverses them.
double binary_number(std::string_view bytes, NumberType type, bool swap);

/// Writes the bytes of the number, cast to the type, at `at` and advances it.
void put_binary(char*& at, NumberType type, double value, bool swap);

}  // namespace hooke
