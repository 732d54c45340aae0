#include "hooke/connectivity/edge_collapses.h"

#include "hooke/connectivity/block_collapses.h"
#include "hooke/connectivity/edge_queue.h"
#include "hooke/core/parallel.h"

namespace hooke {
namespace {

/// Of edges that are tried at the same time, against the mesh as it was before.
constexpr size_t most_edges = 1024;

std::vector<std::optional<Collapse>> try_all(const AdaptingMesh& m, const std::vector<int>& edges,
                                             const CollapseOptions& options) {
  std::vector<std::optional<Collapse>> trials(edges.size());
  parallel_for(edges.size(), 16, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) trials[i] = try_collapse(m, edges[i], options);
  });
  return trials;
}

}  // namespace

int collapse_short_edges(AdaptingMesh& m, const CollapseOptions& options) {
  int collapses = collapse_in_blocks(m, options, {});
  EdgeQueue queue(m.triangulation, [&](int h) { return options.shortest - relative_length(m, h); });
  const auto next_edges = [&] {
    return queue.pop_apart(most_edges, [&](int h) { return valence_after(m, h) <= options.valence; });
  };
  for (std::vector<int> edges = next_edges(); !edges.empty(); edges = next_edges())
    for (const std::optional<Collapse>& trial : try_all(m, edges, options)) {
      if (!trial || !curve_may_lose(m, trial->half_edge)) continue;  // others of its curve may have gone
      make_collapse(m, *trial);
      queue.push_about(trial->stays);
      ++collapses;
    }
  m.retraction.count();
  return collapses;
}

}  // namespace hooke
