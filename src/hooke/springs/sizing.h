// Where target lengths per vertex come from, as the user says it.
#pragma once

#include <filesystem>
#include <string>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

struct SizingSource {
  enum class Kind { none, file, ply_property, curvature };
  Kind kind = Kind::none;
  std::string name;         // of the file or the property
  double chord_error = .1;  // of curvature; positive
  bool percent = true;      // of the box's diagonal; else in the unit of the points
};

/// Reads "FILE", "ply:PROPERTY", "curvature", "curvature:X" or "curvature:X%". Throws Error whose
/// message begins with what is wrong.
SizingSource parse_sizing(const std::string& text);

/// The lengths, one per vertex of the layout, whose points these are; none without a source. Lists follow the
/// mesh's own order. From curvature none is longer than a tenth of the box's diagonal. A property is read
/// from the mesh's own file, which must be PLY: Error otherwise. Throws InputError for a file without them
/// (see length_list.h and ply_lengths.h).
std::vector<double> read_sizing(const SizingSource& source, const std::filesystem::path& mesh_file,
                                const Mat3X& points, const Layout& layout);

// Gradation: how fast target lengths may grow from vertex to vertex.
// H. Borouchaki, F. Hecht, P. J. Frey, "Mesh gradation control", 1998.

/// Lowers target lengths until along every edge they differ by at most `slope` times the edge's length; the
/// greatest lengths that do and are nowhere above the given ones. Infinity limits nothing.
/// Pre-condition: slope is positive.
void limit_gradation(const Mat3X& points, const Connectivity& connectivity, double slope,
                     std::vector<double>& vertex_length);

}  // namespace hooke
