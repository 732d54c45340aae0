#include "hooke/remesh/restarts.h"

#include "hooke/remesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hooke/core/stopwatch.h"
#include "hooke/geometry/self_intersection.h"
#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/mesh.h"

namespace hooke {
namespace {

struct Attempt {
  TriMesh mesh;
  RemeshResult result;
  std::size_t flaws = 0;  // flipped faces, and pairs of faces that cross beyond those of the input
  double angle = 0;       // the least, degrees
  double bound = 60;      // of that face

  bool is_interrupted() const { return result.reason == StopReason::interrupted; }

  std::size_t face_count() const { return result.layout.connectivity->faces.size(); }

  bool is_better_than(const Attempt& other) const {
    return std::pair(flaws, -angle) < std::pair(other.flaws, -other.angle);
  }
};

class Attempts {
 public:
  Attempts(const TriMesh& mesh, const Layout& layout, const RemeshOptions& options,
           const AttemptOptions& attempts, const Observer& observer, Stopwatch* stopwatch)
      : mesh_(mesh),
        layout_(layout),
        options_(options),
        attempts_(attempts),
        observer_(observer),
        stopwatch_(stopwatch),
        input_(layout.order.in_new_order(positions(mesh)), *layout.connectivity),
        crossings_(find_self_intersections(input_.tree).size()) {}

  Attempt best() const {
    Attempt best = make(0);
    const auto most =
        std::min<double>(attempts_.most, attempts_.most_faces / static_cast<double>(best.face_count()));
    if (most < 2 || best.is_interrupted()) return best;
    judge(best);
    int tries = best.result.sliver_tries, kept = 1, made = 1;
    while (made + 1 <= most && tries < attempts_.most_tries && !is_good(best)) {
      Attempt next = make(made);
      if (next.is_interrupted()) {
        best.result.reason = StopReason::interrupted;
        break;
      }
      ++made;
      tries += next.result.sliver_tries;
      judge(next);
      if (!next.is_better_than(best)) continue;
      best = std::move(next);
      kept = made;
    }
    best.result.attempts = made;
    best.result.kept_attempt = kept;
    return best;
  }

 private:
  bool is_good(const Attempt& a) const {
    constexpr double close = .99;
    return a.flaws == 0 && a.angle >= std::min(attempts_.good_angle, close * a.bound);
  }

  /// Another start: edges are split a little sooner or later, flow goes on for a little longer or shorter,
  /// and the surface is drawn closer to its faces.
  RemeshOptions varied(int number) const {
    RemeshOptions o = options_;
    if (number == 0) return o;
    const int by = number % 2 == 1 ? (number + 1) / 2 : -number / 2;
    o.flips.flow.rounds = std::max(1, o.flips.flow.rounds + 4 * by);
    o.adaptation.steps.split.longest *= 1 - .02 * by;
    o.filter.reach *= std::pow(.9, std::abs(by));
    return o;
  }

  Attempt make(int number) const {
    Attempt a;
    a.mesh = mesh_;
    a.result = remesh(a.mesh, layout_, varied(number), observer_, stopwatch_);
    return a;
  }

  void judge(Attempt& a) const {
    const Stage stage(stopwatch_, "judge");
    const Layout& layout = a.result.layout;
    const Mat3X points = positions(a.mesh);
    if (!points.allFinite()) {
      a.flaws = std::numeric_limits<std::size_t>::max();
      return;
    }
    const MeasuredSurface surface(layout.order.in_new_order(points), *layout.connectivity,
                                  layout.order.old_ids());
    Quality quality = measure_quality(surface, {}, {.worst_faces = 1});
    bound_between_creases(quality.worst_faces, surface, a.result.crease_edges);
    const auto crossings = *quality.self_intersections;
    a.flaws =
        measure_deviation(input_, surface).flipped_faces + (crossings - std::min(crossings, crossings_));
    a.angle = quality.worst_faces.front().min_angle;
    a.bound = quality.worst_faces.front().bound.degrees;
  }

  const TriMesh& mesh_;
  const Layout& layout_;
  const RemeshOptions& options_;
  const AttemptOptions& attempts_;
  const Observer& observer_;
  Stopwatch* stopwatch_;
  const MeasuredSurface input_;
  const std::size_t crossings_;
};

}  // namespace

AttemptOptions attempt_options(Effort effort) {
  switch (effort) {
    case Effort::fast:
      return {.most = 1};
    case Effort::standard:
      break;
    case Effort::thorough:
      return {.most = 20, .most_faces = 2e5, .most_tries = 4000};
  }
  return {};
}

RemeshResult remesh_in_attempts(TriMesh& mesh, Layout layout, const RemeshOptions& options,
                                const AttemptOptions& attempts, const Observer& observer,
                                Stopwatch* stopwatch) {
  const bool small = 2 * static_cast<double>(layout.connectivity->faces.size()) <= attempts.most_faces;
  if (options.connectivity == ConnectivityMode::fixed || attempts.most < 2 || !small)
    return remesh(mesh, std::move(layout), options, observer, stopwatch);
  Attempt best = Attempts(mesh, layout, options, attempts, observer, stopwatch).best();
  mesh = std::move(best.mesh);
  return std::move(best.result);
}

}  // namespace hooke
