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

struct Run {
  TriMesh mesh;
  RemeshResult result;
  std::size_t flaws = 0;  // flipped faces, and intersecting pairs of faces in excess of the input's
  double angle = 0;       // minimum angle, degrees
  double bound = 60;      // upper bound of the minimum angle of that face, degrees

  bool is_interrupted() const { return result.reason == StopReason::interrupted; }

  std::size_t face_count() const { return result.memory_order.adjacency->faces.size(); }

  bool is_better_than(const Run& other) const {
    return std::pair(flaws, -angle) < std::pair(other.flaws, -other.angle);
  }
};

class Restarts {
 public:
  Restarts(const TriMesh& mesh, const MemoryOrder& memory_order, const RemeshOptions& options,
           const RestartOptions& restarts, const Observer& observer, Stopwatch* stopwatch)
      : mesh_(mesh),
        memory_order_(memory_order),
        options_(options),
        restarts_(restarts),
        observer_(observer),
        stopwatch_(stopwatch),
        input_(memory_order.order.gather(vertex_points(mesh)), *memory_order.adjacency),
        crossings_(find_self_intersections(input_.tree).size()) {}

  Run best() const {
    Run best = make(0);
    const auto max_runs =
        std::min<double>(restarts_.max_runs, restarts_.max_faces / static_cast<double>(best.face_count()));
    if (max_runs < 2 || best.is_interrupted()) return best;
    judge(best);
    int tests = best.result.sliver_tests, kept = 1, made = 1;
    while (made + 1 <= max_runs && tests < restarts_.max_sliver_tests && !is_good(best)) {
      Run next = make(made);
      if (next.is_interrupted()) {
        best.result.reason = StopReason::interrupted;
        break;
      }
      ++made;
      tests += next.result.sliver_tests;
      judge(next);
      if (!next.is_better_than(best)) continue;
      best = std::move(next);
      kept = made;
    }
    best.result.restarts = made;
    best.result.kept_run = kept;
    return best;
  }

 private:
  bool is_good(const Run& a) const {
    constexpr double close = .99;
    return a.flaws == 0 && a.angle >= std::min(restarts_.good_angle, close * a.bound);
  }

  /// The options of a restart: edges are split at a slightly different length, Lloyd flow has a few more or
  /// fewer rounds, and the deviation bound of the surface is smaller.
  RemeshOptions varied(int number) const {
    RemeshOptions o = options_;
    if (number == 0) return o;
    const int by = number % 2 == 1 ? (number + 1) / 2 : -number / 2;
    o.flips.flow.rounds = std::max(1, o.flips.flow.rounds + 4 * by);
    o.adaptation.steps.split.longest *= 1 - .02 * by;
    o.filter.max_deviation *= std::pow(.9, std::abs(by));
    return o;
  }

  Run make(int number) const {
    Run a;
    a.mesh = mesh_;
    a.result = remesh(a.mesh, memory_order_, varied(number), observer_, stopwatch_);
    return a;
  }

  void judge(Run& a) const {
    const Stage stage(stopwatch_, "judge");
    const MemoryOrder& memory_order = a.result.memory_order;
    const Mat3X points = vertex_points(a.mesh);
    if (!points.allFinite()) {
      a.flaws = std::numeric_limits<std::size_t>::max();
      return;
    }
    const MeasuredSurface surface(memory_order.order.gather(points), *memory_order.adjacency,
                                  memory_order.order.old_ids());
    Quality quality = measure_quality(surface, {}, {.worst_faces = 1});
    bound_between_creases(quality.worst_faces, surface, a.result.crease_edges);
    const auto crossings = *quality.self_intersections;
    a.flaws =
        measure_deviation(input_, surface).flipped_faces + (crossings - std::min(crossings, crossings_));
    a.angle = quality.worst_faces.front().min_angle;
    a.bound = quality.worst_faces.front().bound.degrees;
  }

  const TriMesh& mesh_;
  const MemoryOrder& memory_order_;
  const RemeshOptions& options_;
  const RestartOptions& restarts_;
  const Observer& observer_;
  Stopwatch* stopwatch_;
  const MeasuredSurface input_;
  const std::size_t crossings_;
};

}  // namespace

RestartOptions restart_options(Effort effort) {
  switch (effort) {
    case Effort::fast:
      return {.max_runs = 1};
    case Effort::standard:
      break;
    case Effort::thorough:
      return {.max_runs = 20, .max_faces = 2e5, .max_sliver_tests = 4000};
  }
  return {};
}

RemeshResult remesh_with_restarts(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                                  const RestartOptions& restarts, const Observer& observer,
                                  Stopwatch* stopwatch) {
  const bool small = 2 * static_cast<double>(memory_order.adjacency->faces.size()) <= restarts.max_faces;
  if (options.connectivity == ConnectivityMode::fixed || restarts.max_runs < 2 || !small)
    return remesh(mesh, std::move(memory_order), options, observer, stopwatch);
  Run best = Restarts(mesh, memory_order, options, restarts, observer, stopwatch).best();
  mesh = std::move(best.mesh);
  return std::move(best.result);
}

}  // namespace hooke
