// Vertices and faces as rows of text, for the writers of text formats.
#pragma once

#include <string>

#include "hooke/vertex_data.h"

namespace hooke {

/// A row per vertex: `prefix`, then x, y, z and the values of the channels as the shortest numbers that read
/// back as exactly the same.
void append_vertex_rows(std::string& text, Eigen::Ref<const Mat3X> points, const char* prefix,
                        const VertexData& data = {});

/// A row per face: `prefix`, then its vertex ids, counted from `first_id`.
void append_face_rows(std::string& text, const std::vector<Triangle>& faces, const char* prefix,
                      int first_id);

}  // namespace hooke
