// The lengths that the edges of the input are to have, from what the command line asks for.
#pragma once

#include <filesystem>

#include "hooke/mesh/mesh.h"
#include "hooke/report/report.h"
#include "hooke/springs/sizing.h"
#include "options.h"

namespace hooke::app {

/// The lengths, one per vertex of the layout, whose points these are; none without a source. Lists follow the
/// mesh's own order. A property is read from the mesh's own file, which must be PLY: Error otherwise. Throws
/// InputError for a file without them.
std::vector<double> read_sizing(const SizingSource& source, const std::filesystem::path& mesh_file,
                                const Mat3X& points, const MemoryOrder& memory_order);

/// Gives the vertices, which are at these points in the layout, their target lengths (v:target_length) and
/// tells in the record what they are. Throws Error where they are out of all proportion to the mesh, and what
/// reading a sizing throws.
void set_target_lengths(const Settings& settings, TriMesh& mesh, const MemoryOrder& memory_order,
                        const Mat3X& points, RunRecord& record);

}  // namespace hooke::app
