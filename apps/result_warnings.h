// Warnings about the input and the result of a run, added to its record.
#pragma once

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/mesh.h"
#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

/// Warns if the number of faces does not match the target length. `length` is the covering_length() of the
/// targets, `natural` the natural length of the mesh.
void warn_of_length(const Settings& settings, double length, double natural, RunRecord& run);

/// Warns if there are boundary vertices (`count`) at the same position as another.
void warn_of_coincident_boundary(const Settings& settings, std::size_t count, RunRecord& run);

/// Warns if boundary vertices nearly coincide, within welding_share of the boundary edges there.
void warn_of_near_boundary(const Mat3X& points, const Adjacency& adjacency, RunRecord& run);

/// Warns if there are cracks in the surface, see vertices_at_cracks(), whose sides may move.
void warn_of_cracks(const Settings& settings, const Mat3X& points, const Adjacency& adjacency,
                    RunRecord& run);

/// Warns where all that vertices have copies for stands still: vertices in which sheets only touch, and with
/// --paper all junctions. Pre-condition: the input was measured.
void warn_of_junctions(const Settings& settings, bool has_copies, RunRecord& run);

/// Warns if the input is closed and inside out. Pre-condition: the input was measured.
void warn_of_inside_out(RunRecord& run);

/// Warns of folded faces, new self-intersections, deviation from the input surface, and missed face counts
/// and edge lengths. Pre-condition: the run has a result that was measured, the mesh.
void add_result_warnings(const Settings& settings, const TriMesh& mesh, RunRecord& run);

/// Where a promise is broken: by the method, or by writing numbers with fewer digits.
enum class BrokenBy { method, rounding };

/// What the result does not keep of the input, the greatest damage first, and what to do; empty if it keeps
/// all, or was not measured.
std::string broken_promises(const Settings& settings, const RunRecord& record, BrokenBy cause);

}  // namespace hooke::app
