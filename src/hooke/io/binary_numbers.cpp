#include "hooke/io/binary_numbers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace hooke {
namespace {

template <typename T>
T bytes_as(std::string_view bytes, bool swap) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes.data(), sizeof(T));
  if (swap) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

template <typename T>
void put(char*& at, T value, bool swap) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (swap) std::reverse(raw.begin(), raw.end());
  at = std::copy(raw.begin(), raw.end(), at);
}

}  // namespace

bool swaps_bytes(std::endian order) {
  return order != std::endian::native;
}

size_t size_of(NumberType type) {
  static constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

double binary_number(std::string_view bytes, NumberType type, bool swap) {
  switch (type) {
    case NumberType::int8:
      return bytes_as<std::int8_t>(bytes, swap);
    case NumberType::uint8:
      return bytes_as<std::uint8_t>(bytes, swap);
    case NumberType::int16:
      return bytes_as<std::int16_t>(bytes, swap);
    case NumberType::uint16:
      return bytes_as<std::uint16_t>(bytes, swap);
    case NumberType::int32:
      return bytes_as<std::int32_t>(bytes, swap);
    case NumberType::uint32:
      return bytes_as<std::uint32_t>(bytes, swap);
    case NumberType::float32:
      return bytes_as<float>(bytes, swap);
    case NumberType::float64:
      return bytes_as<double>(bytes, swap);
  }
  return 0;
}

void put_binary(char*& at, NumberType type, double value, bool swap) {
  switch (type) {
    case NumberType::int8:
      return put(at, static_cast<std::int8_t>(value), swap);
    case NumberType::uint8:
      return put(at, static_cast<std::uint8_t>(value), swap);
    case NumberType::int16:
      return put(at, static_cast<std::int16_t>(value), swap);
    case NumberType::uint16:
      return put(at, static_cast<std::uint16_t>(value), swap);
    case NumberType::int32:
      return put(at, static_cast<std::int32_t>(value), swap);
    case NumberType::uint32:
      return put(at, static_cast<std::uint32_t>(value), swap);
    case NumberType::float32:
      return put(at, static_cast<float>(value), swap);
    case NumberType::float64:
      return put(at, value, swap);
  }
}

}  // namespace hooke
