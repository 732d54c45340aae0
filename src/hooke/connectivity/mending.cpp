#include "hooke/connectivity/mending.h"

#include "hooke/connectivity/count_control.h"
#include "hooke/geometry/least_angle.h"
#include "hooke/working_mesh/adapting_work.h"

namespace hooke {
namespace {

/// In mode `flip` their number stays.
FaceCountLimits limits_of(const Workspace& work, ConnectivityMode mode, double share) {
  const auto& faces = work.connectivity->faces;
  const auto count = static_cast<double>(faces.size());
  if (mode == ConnectivityMode::flip) return {count, count};
  const double wanted = wanted_face_count(work.placement.points, faces, work.vertex_length);
  return {(1 - share) * wanted, (1 + share) * wanted};
}

}  // namespace

SliverChanges mend_slivers(Workspace& work, ConnectivityMode mode, const EnergyTerms& terms,
                           const MendOptions& options, const GuardOptions& guards, double corner_angle,
                           const Observer& observer) {
  const std::vector<double>& angles = options.trials.sliver_angles;
  if (angles.empty() || least_angle(work.placement.points, work.connectivity->faces) >= angles.back())
    return {};
  AdaptingWork adapting(work, corner_angle);
  const SliverChanges changes = change_slivers(adapting.mesh(), terms, options.trials, guards,
                                               limits_of(work, mode, options.count_share), observer);
  if (changes.count() == 0) return changes;
  if (mode == ConnectivityMode::flip) {
    adapting.replace_faces();
  } else {
    compact(adapting.mesh());
    adapting.replace_mesh();
  }
  return changes;
}

}  // namespace hooke
