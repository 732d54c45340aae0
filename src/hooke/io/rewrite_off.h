// The OFF part of rewrite_mesh().
#pragma once

#include "hooke/io/rewrite.h"

namespace hooke {

/// rewrite_mesh() for an OFF file without a byte order mark, as text or binary.
RewrittenMesh rewrite_off(std::string_view bytes, const std::string& name, const Mat3X& points);

}  // namespace hooke
