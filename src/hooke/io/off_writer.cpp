#include <fmt/format.h>

#include "hooke/io/off.h"
#include "hooke/io/text_rows.h"

namespace hooke {

std::string write_off(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      const VertexData& data) {
  const ChannelList normals = channels_named(data, normal_names);
  const ChannelList colours = channels_named(data, colour_names);
  const ChannelList texture = channels_named(data, texture_names);
  ChannelList channels;
  for (const ChannelList* list : {&normals, &colours, &texture})
    channels.insert(channels.end(), list->begin(), list->end());
  std::string text =
      fmt::format("{}{}{}OFF\n{} {} 0\n", texture.empty() ? "" : "ST", colours.empty() ? "" : "C",
                  normals.empty() ? "" : "N", points.cols(), triangles.size());
  append_vertex_rows(text, points, "", channels);
  append_face_rows(text, triangles, "3", 0);
  return text;
}

}  // namespace hooke
