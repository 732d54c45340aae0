#include "hooke/connectivity/collapse_passes.h"

#include <vector>

#include "hooke/connectivity/edge_queue.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

/// Maximum number of edges tested in parallel, all against the mesh before their collapses.
constexpr size_t collapse_batch_size = 1024;

std::vector<std::optional<Collapse>> find_collapses(const WorkingMesh& m, const std::vector<int>& edges,
                                                    const CollapseOptions& options) {
  std::vector<std::optional<Collapse>> collapses(edges.size());
  parallel_for(edges.size(), 16, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) collapses[i] = find_collapse(m, edges[i], options);
  });
  return collapses;
}

}  // namespace

int collapse_short_edges(WorkingMesh& m, const CollapseOptions& options) {
  int collapses = 0;
  EdgeQueue queue(m.halfedges, [&](int h) { return options.shortest - relative_length(m, h); });
  const auto next_edges = [&] {
    return queue.pop_apart(collapse_batch_size,
                           [&](int h) { return valence_after(m, h) <= options.valence; });
  };
  for (std::vector<int> edges = next_edges(); !edges.empty(); edges = next_edges())
    for (const std::optional<Collapse>& collapse : find_collapses(m, edges, options)) {
      // Other edges of its curve may have collapsed.
      if (!collapse || !may_remove_curve_edge(m, collapse->half_edge)) continue;
      make_collapse(m, *collapse);
      queue.push_around(collapse->stays);
      ++collapses;
    }
  m.retraction.count();
  return collapses;
}

namespace {

/// Where the usual limits allow no collapse.
CollapseOptions looser_options() {
  return {.longest = 2,
          .valence = 12,
          .limits = {.sagitta = .5, .cotangent = cotangent_of(2)},
          .insist_on_alignment = true};
}

/// Collapses the first edge for which it is allowed, of the face or at its corners.
bool collapse_about(WorkingMesh& m, int face, const CollapseOptions& options) {
  const HalfedgeMesh& t = m.halfedges;
  for (int h = 3 * face; h < 3 * face + 3; ++h)
    if (collapse_edge(m, h, options) >= 0) return true;
  for (int corner : t.faces()[face])
    for (int h : t.outgoing(corner))
      if (collapse_edge(m, h, options) >= 0) return true;
  return false;
}

}  // namespace

int collapse_folded_faces(WorkingMesh& m) {
  const CollapseOptions options = looser_options();
  const HalfedgeMesh& t = m.halfedges;
  const auto is_folded = [&](int f) {
    const size_t face = f;
    return !m.vertices.constraints.is_frozen(t.faces()[face]) &&
           face_alignment(m.vertices.positions.points, m.vertices.positions.normals, t.faces()[face],
                          t.wedges()[face]) < options.limits.alignment;
  };
  const int count = t.half_edge_count() / 3;
  int collapses = 0;
  for (int f = 0; f < count; ++f)
    collapses += !t.is_removed(f) && is_folded(f) && collapse_about(m, f, options);
  m.retraction.count();
  return collapses;
}

}  // namespace hooke
