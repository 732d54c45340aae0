#include "hooke/io/mesh_format.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/scanner.h"

namespace hooke {
namespace {

constexpr MeshFormat all_formats[] = {MeshFormat::obj, MeshFormat::ply, MeshFormat::off};

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, bytes.data() + 80, 4);  // little-endian, like all supported machines
  return bytes.size() == 84 + 50 * static_cast<size_t>(triangles);
}

bool is_off_keyword(std::string_view word) {
  return word.size() >= 3 && word.size() <= 8 && equal_ignoring_case(word.substr(word.size() - 3), "OFF");
}

/// The probable kind of the content: the name of a format, of another kind, or empty if unknown.
std::string guess_content(std::string_view bytes) {
  if (bytes.starts_with("\x1f\x8b")) return "gzip";
  if (bytes.starts_with("PK\x03\x04")) return "zip";
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return "UTF-16 text";
  if (is_binary_stl(bytes)) return "binary STL";
  Scanner in(bytes, "", {.comments = true});
  if (!in.next_line()) return "";
  const std::string_view word = in.token(), next = in.token();
  if (equal_ignoring_case(word, "ply")) return "ply";
  if (is_off_keyword(word)) return "off";
  if (word == "solid") return "STL";
  if (word.starts_with('<')) return "HTML or XML";
  if (word == "version" && next.starts_with("https://git-lfs")) return "a Git LFS pointer";
  for (const char* keyword : {"v", "vt", "vn", "f", "mtllib", "usemtl", "o", "g"})
    if (word == keyword) return "obj";
  return "";
}

std::optional<MeshFormat> known_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().native();
  for (const MeshFormat format : all_formats)
    if (!extension.empty() && equal_ignoring_case(extension.substr(1), name_of(format))) return format;
  return std::nullopt;
}

std::string unknown_format(const std::filesystem::path& path) {
  return (path.empty() ? "''" : printable(path.native())) +
         ": unknown format; expected .obj .ply .off; rename or convert the file";
}

}  // namespace

std::string name_of(MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return "obj";
    case MeshFormat::ply:
      return "ply";
    case MeshFormat::off:
      return "off";
  }
  return "";
}

MeshFormat format_of(const std::filesystem::path& path) {
  if (const auto format = known_format(path)) return *format;
  throw Error(unknown_format(path));
}

MeshFormat input_format_of(const std::filesystem::path& path) {
  if (const auto format = known_format(path)) return *format;
  throw InputError(unknown_format(path));
}

void refuse_other_content(std::string_view bytes, const std::string& name, MeshFormat format) {
  const std::string guess = guess_content(bytes), expected = name_of(format);
  if (!guess.empty() && guess != expected)
    throw InputError(fmt::format(
        "{}:1: the content looks like {}; expected {} by the extension; rename or convert the file", name,
        guess, expected));
  const bool text_only = format != MeshFormat::ply;
  if (const size_t zero = bytes.find('\0'); text_only && zero != bytes.npos && guess != "off")
    throw InputError(fmt::format(
        "{}: byte {} is zero; expected the text of an {} file; the content is binary", name, zero, expected));
}

}  // namespace hooke
