#include "hooke/working_mesh/adapting_work.h"

#include <numeric>

#include "hooke/connectivity/corner_rule.h"

namespace hooke {

AdaptingWork::AdaptingWork(Workspace& work, double corner_angle)
    : work_(work),
      triangulation_(*work.connectivity),
      corner_valences_(
          corner_valences(work.placement.points, *work.connectivity, work.constraints, corner_angle)),
      origins_(work.vertex_length.size()),
      curve_finder_(work.constraints.curves),
      mesh_{triangulation_,   work.placement, *work.retraction, work.constraints, work.vertex_length,
            corner_valences_, origins_,       curve_finder_,    curve_edges_} {
  std::iota(origins_.begin(), origins_.end(), 0);
}

}  // namespace hooke
