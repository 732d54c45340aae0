#include "hooke/io/vtk_arrays.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"

namespace hooke {
namespace {

constexpr std::array<signed char, 256> base64_values = [] {
  std::array<signed char, 256> values{};
  values.fill(-1);
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t k = 0; k < digits.size(); ++k)
    values[static_cast<unsigned char>(digits[k])] = static_cast<signed char>(k);
  return values;
}();

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

template <typename T>
T number_at(std::string_view bytes, size_t offset, bool big_endian) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes.data() + offset, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
  return std::bit_cast<T>(raw);
}

// The sizes in front of an array.
class Sizes {
 public:
  Sizes(std::string_view bytes, const VtkEncoding& encoding) : bytes_(bytes), encoding_(encoding) {}

  std::uint64_t next() {
    const size_t size = encoding_.long_sizes ? 8 : 4;
    if (bytes_.size() - at_ < size)
      throw Error("an array without its size; expected more bytes; the file is truncated");
    const std::uint64_t value = encoding_.long_sizes
                                    ? number_at<std::uint64_t>(bytes_, at_, encoding_.big_endian)
                                    : number_at<std::uint32_t>(bytes_, at_, encoding_.big_endian);
    at_ += size;
    return value;
  }
  std::string_view rest() const { return bytes_.substr(at_); }

 private:
  std::string_view bytes_;
  VtkEncoding encoding_;
  size_t at_ = 0;
};

std::string inflated(std::string_view block, std::uint64_t size) {
  constexpr std::uint64_t greatest_ratio = 1032;  // of zlib's format
  if (size > greatest_ratio * block.size() + greatest_ratio)
    throw Error(
        fmt::format("a compressed block of {} bytes is to hold {}; expected less; the file is damaged",
                    block.size(), size));
  std::string result(size, '\0');
  uLongf length = static_cast<uLongf>(size);
  const int status =
      ::uncompress(reinterpret_cast<Bytef*>(result.data()), &length,
                   reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
  if (status != Z_OK || length != size)
    throw Error(fmt::format(
        "a compressed block cannot be unpacked to {} bytes; expected data of zlib; it is damaged", size));
  return result;
}

std::string unpack_blocks(std::string_view bytes, const VtkEncoding& encoding) {
  Sizes sizes(bytes, encoding);
  const std::uint64_t blocks = sizes.next(), block_size = sizes.next(), last_size = sizes.next();
  if (blocks > bytes.size())
    throw Error(fmt::format("{} compressed blocks in {} bytes; expected fewer; the file is damaged", blocks,
                            bytes.size()));
  std::vector<std::uint64_t> packed(blocks);
  for (std::uint64_t& size : packed) size = sizes.next();
  std::string_view rest = sizes.rest();
  std::string content;
  for (size_t b = 0; b < packed.size(); ++b) {
    if (packed[b] > rest.size())
      throw Error(fmt::format("a compressed block of {} bytes, and {} are left; the file is truncated",
                              packed[b], rest.size()));
    const bool last = b + 1 == packed.size() && last_size > 0;
    content += inflated(rest.substr(0, packed[b]), last ? last_size : block_size);
    rest.remove_prefix(packed[b]);
  }
  return content;
}

template <typename T, typename Result>
std::vector<Result> converted(std::string_view content, bool big_endian) {
  if (content.size() % sizeof(T) != 0)
    throw Error(fmt::format("an array of {} bytes; expected a multiple of {}; the file is damaged",
                            content.size(), sizeof(T)));
  std::vector<Result> numbers(content.size() / sizeof(T));
  for (size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = static_cast<Result>(number_at<T>(content, k * sizeof(T), big_endian));
  return numbers;
}

template <typename Result>
std::vector<Result> converted_integers(std::string_view content, const std::string& type, bool big_endian) {
  if (type == "Int8") return converted<std::int8_t, Result>(content, big_endian);
  if (type == "UInt8") return converted<std::uint8_t, Result>(content, big_endian);
  if (type == "Int16") return converted<std::int16_t, Result>(content, big_endian);
  if (type == "UInt16") return converted<std::uint16_t, Result>(content, big_endian);
  if (type == "Int32") return converted<std::int32_t, Result>(content, big_endian);
  if (type == "UInt32") return converted<std::uint32_t, Result>(content, big_endian);
  if (type == "Int64") return converted<std::int64_t, Result>(content, big_endian);
  if (type == "UInt64") return converted<std::uint64_t, Result>(content, big_endian);
  throw Error(fmt::format("an array of type {}; expected numbers such as Int64", in_quotes(type)));
}

}  // namespace

std::string decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int digits = 0;
  const auto finish = [&] {  // the digits before padding, or at the end
    if (digits == 1) throw Error("base64 with a lone digit; expected groups of four; the file is truncated");
    if (digits >= 2) bytes += static_cast<char>(bits >> (digits == 2 ? 4 : 10));
    if (digits == 3) bytes += static_cast<char>(bits >> 2);
    bits = 0;
    digits = 0;
  };
  for (const char c : text) {
    if (is_space(c)) continue;
    if (c == '=') {
      finish();
      continue;
    }
    const int value = base64_values[static_cast<unsigned char>(c)];
    if (value < 0)
      throw Error(fmt::format("{} in base64; expected letters, digits, + and /", in_quotes({&c, 1})));
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if (++digits < 4) continue;
    for (const int shift : {16, 8, 0}) bytes += static_cast<char>(bits >> shift);
    bits = 0;
    digits = 0;
  }
  finish();
  return bytes;
}

std::string unpack_vtk_array(std::string_view bytes, const VtkEncoding& encoding) {
  if (bytes.empty()) return {};
  if (encoding.compressed) return unpack_blocks(bytes, encoding);
  Sizes sizes(bytes, encoding);
  const std::uint64_t size = sizes.next();
  if (size > sizes.rest().size())
    throw Error(fmt::format("an array of {} bytes, and {} are left; the file is truncated", size,
                            sizes.rest().size()));
  return std::string(sizes.rest().substr(0, size));
}

std::vector<double> reals_of(std::string_view content, const std::string& type, bool big_endian) {
  if (type == "Float32") return converted<float, double>(content, big_endian);
  if (type == "Float64") return converted<double, double>(content, big_endian);
  return converted_integers<double>(content, type, big_endian);
}

std::vector<long long> integers_of(std::string_view content, const std::string& type, bool big_endian) {
  return converted_integers<long long>(content, type, big_endian);
}

}  // namespace hooke
