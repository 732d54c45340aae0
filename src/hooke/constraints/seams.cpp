#include "hooke/constraints/seams.h"

#include <algorithm>

#include "hooke/mesh/corner_differences.h"
#include "hooke/mesh/hard_edges.h"

namespace hooke {
Seams find_seams(const MemoryOrder& memory_order, const CornerData& corners, const FaceData& faces,
                 const SeamKinds& kinds) {
  const Adjacency& c = *memory_order.adjacency;
  const CornerDifferences differences(memory_order, corners.texture);
  const bool has_texture = kinds.texture && !corners.texture.empty();
  const std::vector<int> poles = has_texture ? differences.find_poles() : std::vector<int>();
  const auto texture_differs = [&](int edge) {
    return has_texture && std::ranges::any_of(c.edges[edge], [&](int v) {
             const bool is_pole = std::ranges::binary_search(poles, v);
             return differences.differ_at(edge, is_pole ? c.other_end(edge, v) : v);
           });
  };
  const auto labels_differ = [&](std::size_t edge, LabelKind kind) {
    const auto& [left, right] = c.edge_faces[edge];
    const std::size_t a = memory_order.order.old_face[left], b = memory_order.order.old_face[right];
    return std::ranges::any_of(faces, [&](const FaceChannel& channel) {
      return channel.kind == kind && channel.values[a] != channel.values[b];
    });
  };
  Seams seams;
  for (const int v : poles) seams.poles.push_back(memory_order.order.old_vertex[v]);
  if (corners.empty() && faces.empty()) return seams;
  const std::vector<int> hard_edges =
      kinds.hard_edges ? find_hard_edges(memory_order, corners.normals).edges : std::vector<int>();
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    if (c.is_boundary_edge(static_cast<int>(e))) continue;
    const bool by_texture = texture_differs(static_cast<int>(e)),
               by_normals = std::ranges::binary_search(hard_edges, static_cast<int>(e)),
               by_material = kinds.materials && labels_differ(e, LabelKind::material),
               by_group = kinds.groups && labels_differ(e, LabelKind::group);
    seams.texture += by_texture;
    seams.hard_edges += by_normals;
    seams.materials += by_material;
    seams.groups += by_group;
    if (!by_texture && !by_normals && !by_material && !by_group) continue;
    const auto& [a, b] = c.edges[e];
    seams.edges.push_back(static_cast<int>(e));
    seams.ends.push_back({memory_order.order.old_vertex[a], memory_order.order.old_vertex[b]});
  }
  return seams;
}

}  // namespace hooke
