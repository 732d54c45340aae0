// Integer labels of faces: the group, solid or other part that a face belongs to.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "hooke/mesh/attributes.h"

namespace hooke {

/// What a channel tells of its faces: where it changes may be a seam, see constraints/seams.h.
enum class LabelKind {
  material,  // what the surface is made of, or another label: materials of OBJ, groups of Gmsh
  group,     // which part it is of: groups, objects and smoothing groups of OBJ, solids of STL
  other,     // no label: colours, flags
};

/// One integer per face.
struct FaceChannel {
  std::string name;
  std::vector<int> values = {};
  std::map<int, std::string> names = {};  // of those values that have a name
  LabelKind kind = LabelKind::material;
  NumberType type = NumberType::int32;  // in a PLY file; uint32 beyond the range of int as negative numbers
};
using FaceData = std::vector<FaceChannel>;

/// The channels that formats share.
inline constexpr char group_channel[] =
    "group";  // group of OBJ, physical group of Gmsh, solid of an STL file, from 1
inline constexpr char material_channel[] = "material";    // of OBJ, from 1; 0: none
inline constexpr char object_channel[] = "object";        // of OBJ, from 1; 0: none
inline constexpr char smoothing_channel[] = "smoothing";  // smoothing group of OBJ; 0: off
inline constexpr char entity_channel[] = "entity";        // geometrical entity of Gmsh
inline constexpr char attribute_channel[] = "attribute";  // the 16 bits at each facet of a binary STL file

/// The channel with this name; null if there is none.
const FaceChannel* find_channel(const FaceData& data, const std::string& name);

/// The data of new faces, of which each takes that of an old face.
FaceData gather(const FaceData& data, const std::vector<int>& old_face);

}  // namespace hooke
