// The formats of rewrite_mesh(), each for files without a byte order mark.
#pragma once

#include "hooke/io/rewrite.h"

namespace hooke {

/// Elements of higher dimension or order, parametric coordinates and periodic nodes are obstacles.
RewrittenMesh rewrite_msh(std::string_view bytes, const std::string& name, const Mat3X& points);

RewrittenMesh rewrite_obj(std::string_view text, const std::string& name, const Mat3X& points,
                          bool texture_follows);

/// For text and binary files.
RewrittenMesh rewrite_off(std::string_view bytes, const std::string& name, const Mat3X& points);

/// For files in any encoding.
RewrittenMesh rewrite_ply(std::string_view bytes, const std::string& name, const Mat3X& points);

}  // namespace hooke
