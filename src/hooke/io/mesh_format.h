// The formats of mesh files, their names, and the format that a file name or its content shows.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

enum class MeshFormat { obj, ply, off };

/// The name of the format, as in its extension: "obj".
std::string name_of(MeshFormat format);

/// The format given by the file extension, ignoring case. Throws Error for others.
MeshFormat format_of(const std::filesystem::path& path);

/// The same for an input file: throws InputError.
MeshFormat input_format_of(const std::filesystem::path& path);

/// Throws InputError "NAME: ..." if the content of a file is surely not of this format: another format, a
/// compressed file, a web page. `name` is printable.
void refuse_other_content(std::string_view bytes, const std::string& name, MeshFormat format);

}  // namespace hooke
