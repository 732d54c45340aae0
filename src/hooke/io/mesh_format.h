// The formats of mesh files, their names, and the format that a file name or its content shows.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

/// `msh` is Gmsh 4.1, `msh2` Gmsh 2.2 with the same extension; `vtp` can only be read.
enum class MeshFormat { obj, ply, off, stl, msh, msh2, vtp };

/// The name of the format, as in its extension: "obj".
std::string name_of(MeshFormat format);

/// The format of an output by its extension, ignoring case. Throws Error for unknown ones and those that can
/// only be read.
MeshFormat format_of(const std::filesystem::path& path);

/// The same for an input file, of any format. Throws InputError.
MeshFormat input_format_of(const std::filesystem::path& path);

/// Throws InputError "NAME:1: ..." if the content of a file is surely not of this format: another format, a
/// compressed file, a web page. `name` is printable.
void refuse_other_content(std::string_view bytes, const std::string& name, MeshFormat format);

}  // namespace hooke
