// The PLY part of rewrite_mesh().
#pragma once

#include "hooke/io/rewrite.h"

namespace hooke {

/// rewrite_mesh() for a PLY file without a byte order mark, in any encoding.
RewrittenMesh rewrite_ply(std::string_view bytes, const std::string& name, const Mat3X& points);

}  // namespace hooke
