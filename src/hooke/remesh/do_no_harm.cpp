#include "hooke/remesh/do_no_harm.h"

#include "hooke/geometry/least_angle.h"

namespace hooke {
namespace {

/// Standard deviation of l / L_e in parts of its mean.
double spread_of_edges(const Workspace& work) {
  const auto& edges = work.connectivity->edges;
  double sum = 0, squares = 0;
  for (size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e];
    const double l = (work.start->col(a) - work.start->col(b)).norm() / work.targets.edge[e];
    sum += l;
    squares += l * l;
  }
  const double n = static_cast<double>(edges.size()), mean = sum / n;
  return std::sqrt(std::max(0., squares / n - mean * mean)) / mean;
}

}  // namespace

bool do_no_harm(Workspace& work, const HarmOptions& options) {
  const bool near_regular = least_angle(*work.start, work.connectivity->faces) >= options.angle &&
                            spread_of_edges(work) <= options.deviation;
  if (near_regular || !work.graded()) work.keep_angles();
  if (near_regular) {
    work.constraints.home = *work.start;
    for (double length : work.vertex_length) work.constraints.reach.push_back(options.reach * length);
  }
  return near_regular;
}

}  // namespace hooke
