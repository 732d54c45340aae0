// What a mesh file of Gmsh (MSH) holds: its reader, for those of meshes and for rewriting.
// Source: C. Geuzaine, J.-F. Remacle, "Gmsh reference manual", section "MSH file format".
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/core/types.h"
#include "hooke/io/mesh_file.h"

namespace hooke {

inline constexpr int triangle_code = 2;  // of the type of elements

/// A kind of elements of other dimension or order than polygons.
struct OtherElements {
  long long count = 0;
  bool is_straight = false;  // points or lines between two nodes
};

struct MshContent {
  bool old = false;      // version 2
  bool binary = false;   // numbers are binary
  bool swapped = false;  // with the other byte order

  std::vector<Vec3> nodes;               // in file order
  std::vector<std::size_t> coordinates;  // offset of the first of each node in the file
  bool has_parameters = false;           // have nodes parametric coordinates?
  std::vector<int> vertex;               // of each node: a number in their order, -1 if no polygon uses it
  std::vector<int> corners;              // nodes of the polygons, end to end
  std::vector<int> sizes;                // corners of each polygon
  std::vector<int> lines;                // of each polygon, in text files
  FaceChannel groups{group_channel}, entities{entity_channel};
  std::vector<int> points;                              // nodes of elements that are points
  std::vector<Edge> segments;                           // nodes of straight lines
  std::map<std::string, OtherElements> other_elements;  // by the plural of their names
  std::vector<std::string> other_sections;              // "$NodeData", each name once
  long long in_several_groups = 0;                      // polygons
};

/// Throws InputError "NAME:LINE: ...", or "NAME: byte OFFSET: ..." in binary sections.
MshContent read_msh_content(std::string_view bytes, const std::string& name);

}  // namespace hooke
