#include "hooke/remesh/crease_counts.h"

#include <algorithm>

#include "hooke/mesh/creases.h"

namespace hooke {

CreaseCounts count_creases(const Workspace& work) {
  const Constraints& constraints = work.constraints;
  CreaseCounts counts;
  if (constraints.creases.empty()) return counts;
  counts.curves = constraints.crease_curves;
  counts.edges = static_cast<int>(constraints.creases.size());
  counts.kept = static_cast<int>(crease_edges(*work.connectivity).size());
  counts.charts = work.chart_count();
  std::vector<int> ends;
  for (const Edge& e : constraints.creases) ends.insert(ends.end(), e.begin(), e.end());
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (int v : ends) {
    const bool inner =
        constraints.freedom[static_cast<size_t>(v)] == Freedom::curve || constraints.at_bend(v);
    ++(inner ? counts.curve_vertices : counts.corners);
  }
  return counts;
}

}  // namespace hooke
