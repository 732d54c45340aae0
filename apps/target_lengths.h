// Sets the target edge lengths of the input from the options --length, --sizing and --gradation.
#pragma once

#include <filesystem>

#include "hooke/constraints/constraint_options.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/repair.h"
#include "hooke/report/report.h"
#include "hooke/springs/sizing.h"
#include "options.h"

namespace hooke::app {

/// Reads or computes the lengths of a sizing, one per vertex in memory order, as are `points`; empty without
/// a source. Files list the lengths in file order. A property is read from the mesh file itself; throws Error
/// if that is not PLY. Throws InputError if the file does not hold the lengths. `features`:
/// which sharp edges do not count as curvature. `origin`: where the vertices of a repaired mesh stand in the
/// files.
std::vector<double> read_sizing(const SizingSource& source, const std::filesystem::path& mesh_file,
                                const Mat3X& points, const MemoryOrder& memory_order,
                                const CreaseOptions& features = {}, const MeshOrigin& origin = {});

/// Sets the target lengths of the vertices (v:target_length) and records them in the parameters of the run.
/// `origin`: as of read_sizing(). Throws Error if the lengths are unreasonable for the size of the mesh, and
/// what read_sizing() throws.
void set_target_lengths(const Settings& settings, TriMesh& mesh, const MemoryOrder& memory_order,
                        const MeshOrigin& origin, RunRecord& record);

/// Sets how short edges may be in narrow regions, --min-length, in the settings and in the parameters of the
/// run, and if memory is limited the number of faces that takes. Throws Error if it is no shorter than the
/// longest target length, or less than 1e-4 of that. Pre-condition: set_target_lengths().
void set_min_length(Settings& settings, const TriMesh& mesh, const MemoryOrder& memory_order,
                    const Mat3X& points, RunRecord& record);

}  // namespace hooke::app
