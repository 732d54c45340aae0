// The OBJ part of rewrite_mesh().
#pragma once

#include "hooke/io/rewrite.h"

namespace hooke {

/// rewrite_mesh() for an OBJ text without a byte order mark.
RewrittenMesh rewrite_obj(std::string_view text, const std::string& name, const Mat3X& points,
                          bool texture_follows);

}  // namespace hooke
