#include "hooke/io/obj.h"
#include "hooke/io/text_rows.h"

namespace hooke {

std::string write_obj(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      const VertexData& data) {
  const ChannelList texture = channels_named(data, texture_names);
  const ChannelList normals = channels_named(data, normal_names);
  std::vector<const char*>
      repeats;  // every vertex has the texture coordinate and the normal of its own number
  if (!texture.empty()) repeats.push_back("/");
  if (!normals.empty()) repeats.push_back(texture.empty() ? "//" : "/");
  std::string text;
  append_vertex_rows(text, points, "v ", channels_named(data, colour_names));
  append_value_rows(text, "vt", texture);
  append_value_rows(text, "vn", normals);
  append_face_rows(text, triangles, "f", 1, repeats);
  return text;
}

}  // namespace hooke
