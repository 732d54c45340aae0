// The files that a result is written to: the mesh, as the input's bytes with other digits or anew, and its
// fields.
#pragma once

#include <string>
#include <vector>

#include "hooke/core/types.h"
#include "hooke/core/uniform_vector.h"
#include "hooke/io/read_mesh.h"
#include "hooke/io/write_mesh.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/attributes.h"
#include "hooke/report/report.h"
#include "options.h"
#include "stages.h"

namespace hooke::app {

/// Has a repair changed the mesh? Its notes of what it left do not count.
bool is_repaired(const LoadedMesh& loaded);

/// Why the output cannot be the input file with moved vertices; empty if nothing is known to be in the way.
std::string obstacle_to_preserving(const Settings& settings, const LoadedMesh& loaded);

/// Can the format of the output hold coordinates as 32-bit floats only? Of others that are preserved and hold
/// floats there is a new file of doubles where these do not do.
bool has_float_points(const Settings& settings, const LoadedMesh& loaded);

/// A file of the input's format is encoded like the input, others are binary where they can be.
PlyEncoding encoding_of_output(const Settings& settings, const LoadedMesh& loaded);

/// Prepares the output: the input file with moved vertices if that can be and is not switched off, else a new
/// file. Records which of them, and what that means for the content of the input. `loaded` holds the result,
/// `points` are its points in memory order.
PendingMesh prepare_output(const Settings& settings, const LoadedMesh& loaded, const Original& original,
                           const Mat3X& points, RunRecord& record, Stopwatch& stopwatch);

/// The map of the result's vertices as they are written, to the input as it was read; `origin`: of the input.
std::vector<MapEntry> map_of_output(const TriMesh& result, const MeshOrigin& origin, const RunRecord& record);

/// Makes ids of vertices in the record those of the files, where sheets are joined.
void join_ids(const TriMesh& result, const MeshOrigin& origin, RunRecord& record);

// Values at the vertices and faces of a result, for pictures: how far it moved, how far it is from the input,
// how it bends, and how good it is.

/// Channels by the indices of the adjacency they were measured with.
struct Fields {
  VertexData vertices;
  VertexData faces;
};

/// At vertices: `displacement`, from `start` in the same order (left out without one); `distance`, as given,
/// of the surface they came from; `mean_curvature` and `gaussian_curvature`, see measure_curvature(); and
/// `length_error`, the greatest |l - L| / L of their edges. At faces: `min_angle` in degrees. Lengths are in
/// the unit of the points. Isolated vertices have a length error of 0.
Fields measure_fields(const Mat3X& points, const Adjacency& adjacency, const UniformVector& edge_targets,
                      const std::vector<double>& distances, const Mat3X* start);

/// The values at the vertices and faces of the result as a PLY file, in the order of the output's; see
/// measure_fields().
std::string fields_text(const LoadedMesh& loaded, const Mat3X& points, const Original& original,
                        const RunRecord& record);

}  // namespace hooke::app
