#include "hooke/io/mesh_format.h"

#include <fmt/format.h>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/scanner.h"
#include "hooke/io/stl.h"

namespace hooke {
namespace {

constexpr MeshFormat read_and_written[] = {MeshFormat::obj, MeshFormat::ply, MeshFormat::off, MeshFormat::stl,
                                           MeshFormat::msh};

bool is_off_keyword(std::string_view word) {
  return word.size() >= 3 && word.size() <= 8 && equal_ignoring_case(word.substr(word.size() - 3), "OFF");
}

/// The probable kind of the content: a format or another kind of file; empty if unknown.
struct Guess {
  std::string kind;
  std::optional<MeshFormat> format;
};

Guess known(MeshFormat format) {
  return {name_of(format), format};
}

Guess guess_text(std::string_view bytes) {
  Scanner in(bytes, "", {.comments = true});
  if (!in.next_line()) return {};
  const std::string_view word = in.token(), next = in.token();
  if (equal_ignoring_case(word, "ply")) return known(MeshFormat::ply);
  if (is_off_keyword(word)) return known(MeshFormat::off);
  if (equal_ignoring_case(word, "solid")) return known(MeshFormat::stl);
  if (word == "$MeshFormat" || word == "$Comments") return known(MeshFormat::msh);
  constexpr size_t prolog = 1000;  // bytes
  if (word.starts_with('<'))
    return bytes.substr(0, prolog).find("<VTKFile") == bytes.npos ? Guess{"HTML or XML", {}}
                                                                  : known(MeshFormat::vtp);
  if (word == "version" && next.starts_with("https://git-lfs")) return {"a Git LFS pointer", {}};
  for (const char* keyword : {"v", "vt", "vn", "f", "mtllib", "usemtl", "o", "g"})
    if (word == keyword) return known(MeshFormat::obj);
  return {};
}

Guess guess_content(std::string_view bytes) {
  if (bytes.starts_with("\x1f\x8b")) return {"gzip", {}};
  if (bytes.starts_with("PK\x03\x04")) return {"zip", {}};
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return {"UTF-16 text", {}};
  if (is_binary_stl(bytes)) return {"binary STL", MeshFormat::stl};
  return guess_text(bytes);
}

std::optional<MeshFormat> known_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().native();
  if (extension.empty()) return std::nullopt;
  for (const MeshFormat format : read_and_written)
    if (equal_ignoring_case(extension.substr(1), name_of(format))) return format;
  if (equal_ignoring_case(extension, ".vtp")) return MeshFormat::vtp;
  return std::nullopt;
}

std::string name_of_file(const std::filesystem::path& path) {
  return path.empty() ? "''" : printable(path.native());
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
    case MeshFormat::stl:
      return "stl";
    case MeshFormat::msh:
      return "msh";
    case MeshFormat::msh2:
      return "msh2";
    case MeshFormat::vtp:
      return "vtp";
  }
  return "";
}

MeshFormat format_of(const std::filesystem::path& path) {
  const auto format = known_format(path);
  if (format == MeshFormat::vtp)
    throw Error(name_of_file(path) +
                ": VTP can only be read; expected .obj .ply .off .stl .msh; choose one of them, or give "
                "--format");
  if (format) return *format;
  throw Error(name_of_file(path) +
              ": unknown format; expected .obj .ply .off .stl .msh; choose one of them, or give --format");
}

MeshFormat input_format_of(const std::filesystem::path& path) {
  if (const auto format = known_format(path)) return *format;
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(name_of_file(path) + ": is a folder; expected a mesh file; name the files in it");
  if (path.extension() == ".gz")
    throw InputError(
        name_of_file(path) +
        ": is compressed; expected a mesh file; unpack it, or read it through a pipe: gzip -dc FILE "
        "| hooke-remesh - --input-format FORMAT ...");
  throw InputError(
      name_of_file(path) +
      ": unknown format; expected .obj .ply .off .stl .msh .vtp; give --input-format, or convert the "
      "file with meshio, gmsh or admesh");
}

void refuse_other_content(std::string_view bytes, const std::string& name, MeshFormat format) {
  const Guess guess = guess_content(bytes);
  const MeshFormat expected = format == MeshFormat::msh2 ? MeshFormat::msh : format;
  if (!guess.kind.empty() && guess.format != expected)
    throw InputError(
        fmt::format("{}:1: the content looks like {}; expected {} by the extension or --input-format; rename "
                    "or convert the file",
                    name, guess.kind, name_of(expected)));
  const bool text_only = expected == MeshFormat::obj || expected == MeshFormat::off;
  if (const size_t zero = bytes.find('\0');
      text_only && zero != bytes.npos && guess.format != MeshFormat::off)
    throw InputError(
        fmt::format("{}: byte {} is zero; expected the text of an {} file; the content is binary", name, zero,
                    name_of(expected)));
}

}  // namespace hooke
