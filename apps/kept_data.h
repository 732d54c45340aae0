// What a file has beside triangles: the seams that are kept for data of faces and corners, these data where
// faces are replaced, and its polygons where they stay.
#pragma once

#include "hooke/io/read_mesh.h"
#include "hooke/report/report.h"
#include "options.h"
#include "stages.h"

namespace hooke::app {

/// Makes the seams of the input that are to be kept, of data that the output can hold, feature edges
/// (RemeshOptions::constraints), and warns if they are so many that hardly anything can change. Drops the
/// data that are not to be kept, of which it warns, unless faces stay: these keep their data. Tells of hard
/// edges (ConstraintOptions::hard_edges).
void keep_seams(Settings& settings, LoadedMesh& loaded, RunRecord& record);

/// Are the faces of the result those of the file's polygons, which no repair has changed?
bool keeps_polygons(const Settings& settings, const LoadedMesh& loaded);

/// Are polygons kept and most triangles parts of those with more than three corners, so that their angles
/// must not get worse? Not where lengths are asked for that change them: a sizing or single edges; nor with
/// --paper.
bool guards_polygons(const Settings& settings, const LoadedMesh& loaded);

/// Where polygons are kept and most triangles are halves of quadrilaterals, lets springs make rectangles of
/// those, not equilateral triangles, whatever is written; not where the lengths of edges are given, or with
/// --paper. Pre-condition: set_target_lengths().
void set_rest_ratios(const Settings& settings, LoadedMesh& loaded);

/// Replaces the data of faces and corners of the input by those of the result, and brings faces with equal
/// labels together, in the order in which the input has them; ids of faces in the record follow. Where
/// faces stay it only warns of borders that have moved with them, unless they were to be kept. `loaded` holds
/// the result.
void carry_data(const Settings& settings, LoadedMesh& loaded, const Original& original, RunRecord& record);

}  // namespace hooke::app
