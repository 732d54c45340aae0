// The lengths that the edges of the input are to have, from what the command line asks for.
#pragma once

#include "hooke/mesh/mesh.h"
#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

/// Gives the vertices, which are at these points in the layout, their target lengths (v:target_length) and
/// tells in the record what they are. Throws Error where they are out of all proportion to the mesh, and what
/// reading a sizing throws.
void set_target_lengths(const Settings& settings, TriMesh& mesh, const Layout& layout, const Mat3X& points,
                        RunRecord& record);

}  // namespace hooke::app
