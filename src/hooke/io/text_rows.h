// Vertices and faces as rows of text, for the writers of text formats.
#pragma once

#include <string>

#include "hooke/mesh/vertex_data.h"

namespace hooke {

/// A row per vertex: `prefix`, then x, y, z and the values of the channels as the shortest numbers that read
/// back as exactly the same.
void append_vertex_rows(std::string& text, Eigen::Ref<const Mat3X> points, const char* prefix,
                        const ChannelList& channels = {});

/// A row per vertex: `prefix`, then after a blank each value of the channels; no rows without channels.
void append_value_rows(std::string& text, const char* prefix, const ChannelList& channels);

/// A row per face: `prefix`, then after a blank each vertex id, counted from `first_id`. An id is followed by
/// each of `repeats` and the id again: { "/" } makes 7/7 of 7.
void append_face_rows(std::string& text, const std::vector<Triangle>& faces, const char* prefix, int first_id,
                      const std::vector<const char*>& repeats = {});

}  // namespace hooke
