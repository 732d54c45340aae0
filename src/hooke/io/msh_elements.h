// The types of elements in Gmsh's mesh files.
// Source: C. Geuzaine, J.-F. Remacle, "Gmsh reference manual", section "Node ordering" and "MSH file format".
#pragma once

namespace hooke {

struct MshElementType {
  int code;            // in the file
  int nodes;           // of an element
  const char* plural;  // "triangles"
};

inline constexpr int msh_triangle = 2, msh_quadrangle = 3;

/// The type with this code; null if there is none.
const MshElementType* msh_element_type(long long code);

}  // namespace hooke
