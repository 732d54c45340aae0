// Ids of vertices and faces that stand in another order than in the mesh they belong to.
#pragma once

#include <span>

#include "hooke/core/types.h"

namespace hooke {

/// By their place in that order; without a list they are the places themselves. Keeps no copy of the lists.
struct MeshIds {
  std::span<const int> vertices = {}, faces = {};

  int vertex(int v) const { return vertices.empty() ? v : vertices[static_cast<std::size_t>(v)]; }
  Triangle corners(const Triangle& t) const { return {vertex(t[0]), vertex(t[1]), vertex(t[2])}; }
  int face(int f) const { return faces.empty() ? f : faces[static_cast<std::size_t>(f)]; }
};

}  // namespace hooke
