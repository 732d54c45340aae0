#include "hooke/mesh/valid_mesh.h"

#include <utility>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/validation.h"

namespace hooke {
namespace {

/// Throws MeshError for a corner that is no vertex, since the order in memory can only be found without.
void require_ids(int vertex_count, const std::vector<Triangle>& triangles, const Mat3X& points,
                 const MeshSource& source) {
  for (const Triangle& t : triangles)
    for (int v : t)
      if (v < 0 || v >= vertex_count) require_valid(points, triangles, source);
}

ValidMesh built(const Mat3X& points, const std::vector<Triangle>& triangles, const MeshSource& source,
                const std::vector<int>& joined = {}) {
  const int vertex_count = static_cast<int>(points.cols());
  require_ids(vertex_count, triangles, points, source);
  MemoryOrder memory_order{reorder(triangles, bfs_cluster_order(vertex_count, triangles)), nullptr};
  Permutation& order = memory_order.order;
  Warnings warnings;
  VertexFans fans;
  if (!find_problems(order.gather(points), order.faces, &fans).empty())
    warnings = require_valid_sheets(points, triangles, joined, source);
  memory_order.adjacency =
      std::make_shared<const Adjacency>(make_adjacency(std::exchange(order.faces, {}), std::move(fans)));
  require_workable_size(points, source.name);
  // Constructed in place, because OpenMesh meshes can only be copied, not moved.
  ValidMesh valid{build_mesh(points, *memory_order.adjacency, order.old_ids()), std::move(memory_order),
                  std::move(warnings)};
  if (!joined.empty()) set_joined_vertices(valid.mesh, joined);
  return valid;
}

}  // namespace

ValidMesh make_valid_mesh(const Mat3X& points, const std::vector<Triangle>& triangles,
                          const std::string& name) {
  return built(points, triangles, {name, {}, {}});
}

ValidMesh make_valid_mesh(const Mat3X& points, const std::vector<Triangle>& triangles,
                          const std::string& name, const RepairOptions& options) {
  if (!options.any()) return make_valid_mesh(points, triangles, name);
  MeshSource source{name, {}, {}};
  require_ids(static_cast<int>(points.cols()), triangles, points, source);
  Repaired repaired = repair(points, triangles, options, source);
  source.face = repaired.origin.face;
  source.repaired = options.repair;
  source.keeps_junctions = options.keep_junctions;
  ValidMesh valid = built(repaired.points, repaired.triangles, source, repaired.origin.joined);
  valid.origin = std::move(repaired.origin);
  valid.repairs = std::move(repaired.changes);
  return valid;
}

}  // namespace hooke
