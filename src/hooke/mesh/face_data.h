// Integer labels of faces: the group, solid or other part that a face belongs to.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace hooke {

/// One integer per face.
struct FaceChannel {
  std::string name;
  std::vector<int> values = {};
  std::map<int, std::string> names = {};  // of those values that have a name
};
using FaceData = std::vector<FaceChannel>;

/// The channels that formats share.
inline constexpr char group_channel[] = "group";    // physical group of Gmsh, solid of an STL file, from 1
inline constexpr char entity_channel[] = "entity";  // geometrical entity of Gmsh
inline constexpr char attribute_channel[] = "attribute";  // the 16 bits at each facet of a binary STL file

/// The channel with this name; null if there is none.
const FaceChannel* find_channel(const FaceData& data, const std::string& name);

/// The data of new faces, of which each takes that of an old face.
FaceData gather(const FaceData& data, const std::vector<int>& old_face);

}  // namespace hooke
