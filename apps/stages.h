// The stages of a run between reading the mesh and writing the result: lengths, measures, remeshing.
#pragma once

#include "hooke/core/lists.h"
#include "hooke/mesh/repair.h"
#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

/// The input mesh, kept as the reference for measuring the result.
struct Original {
  Mat3X points;  // in memory order
  MemoryOrder memory_order;
  std::vector<int> joined;             // likewise, of the input, see mesh/junctions.h
  std::vector<int> tree_order;         // order of the faces in its bounding volume tree
  const IntLists* polygons = nullptr;  // of the file, if guards_polygons()
};

/// Whether the run moves vertices only.
bool keeps_faces(const Settings& settings);

/// The parameters of the run for its report, but those of the target lengths and of the output.
nlohmann::ordered_json parameters_of(const Settings& settings);

/// Completes the fixed vertices of the settings, whose ids are those before a repair, with those of their
/// file. `vertices`: of the mesh, as `origin` tells. Throws InputError for what the file is not, Error for
/// vertices that a repair has dropped.
void set_fixed_vertices(Settings& settings, const MeshOrigin& origin, int vertices);

/// Measures the input, completes the settings by what follows from its size, and warns of its boundaries and
/// orientation. Throws Error for --min-length out of range. Pre-condition: set_target_lengths().
void measure_input(Settings& settings, const TriMesh& mesh, const MemoryOrder& memory_order,
                   Original& original, RunRecord& record, Stopwatch& stopwatch);

/// Remeshes the mesh and measures the result; `memory_order` becomes the result's, `original` is completed.
/// Throws NumericalError for a result that is not finite, ResultError for one that does not keep what it must
/// keep, unless that is accepted, and what remesh() throws, with the name of the input.
void remesh_and_measure(const Settings& settings, TriMesh& mesh, MemoryOrder& memory_order,
                        Original& original, RunRecord& record, const Observer& observer,
                        Stopwatch& stopwatch);

/// Measures the result again if its coordinates were rounded for the file, as in preserved files of floats:
/// `rounded` are those in the file. Sets the points of the mesh, and what the record tells of the result, its
/// deviation and what it keeps. Pre-condition: remesh_and_measure().
void measure_rounded(const Settings& settings, const Mat3X& rounded, TriMesh& mesh,
                     const MemoryOrder& memory_order, const Original& original, RunRecord& record,
                     Stopwatch& stopwatch);

}  // namespace hooke::app
