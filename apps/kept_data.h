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
/// data that are not to be kept, of which it warns. Where faces stay it only tells of hard edges
/// (ConstraintOptions::hard_edges).
void keep_seams(Settings& settings, LoadedMesh& loaded, RunRecord& record);

/// Are the faces of the result those of the file's polygons, which no repair has changed?
bool keeps_polygons(const Settings& settings, const LoadedMesh& loaded);

/// Are polygons kept and most triangles parts of some, so that these must not get worse? Not where the
/// lengths of edges are given, or with --paper. Where most are halves of quadrilaterals, lets springs make
/// rectangles of those, not equilateral triangles. Whatever is written. Pre-condition: set_target_lengths().
bool keep_polygons(const Settings& settings, LoadedMesh& loaded);

/// Replaces the data of faces and corners of the input by those of the result, and brings faces with equal
/// labels together, in the order in which the input has them; ids of faces in the record follow. Does nothing
/// where faces stay. `loaded` holds the result.
void carry_data(const Settings& settings, LoadedMesh& loaded, const Original& original, RunRecord& record);

}  // namespace hooke::app
