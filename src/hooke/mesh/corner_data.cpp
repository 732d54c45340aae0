#include "hooke/mesh/corner_data.h"

namespace hooke {

CornerData gather(const CornerData& data, const std::vector<int>& old_face) {
  CornerData result = data;
  for (const auto& [from, to] :
       {std::pair{&data.texture, &result.texture}, std::pair{&data.normals, &result.normals}}) {
    if (from->empty()) continue;
    to->corners.clear();
    for (const int face : old_face) to->corners.push_back(from->corners[face]);
  }
  return result;
}

}  // namespace hooke
