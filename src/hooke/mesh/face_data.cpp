#include "hooke/mesh/face_data.h"

#include <algorithm>

namespace hooke {

const FaceChannel* find_channel(const FaceData& data, const std::string& name) {
  const auto found = std::ranges::find(data, name, &FaceChannel::name);
  return found == data.end() ? nullptr : &*found;
}

FaceData gather(const FaceData& data, const std::vector<int>& old_face) {
  FaceData result;
  for (const FaceChannel& channel : data) {
    FaceChannel& taken =
        result.emplace_back(FaceChannel{channel.name, {}, channel.names, channel.kind, channel.type});
    taken.values.reserve(old_face.size());
    for (const int face : old_face) taken.values.push_back(channel.values[face]);
  }
  return result;
}

}  // namespace hooke
