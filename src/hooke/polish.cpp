#include "hooke/polish.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hooke/least_angle.h"
#include "hooke/local_newton.h"
#include "hooke/parallel.h"

namespace hooke {

double relative_edge_deviation(const Mat3X& points, const std::vector<Edge>& edges,
                               const TargetLengths& targets) {
  const auto ratio = [&](size_t e) {
    return (points.col(edges[e][1]) - points.col(edges[e][0])).norm() / targets.edge[e];
  };
  const auto moment = [&](double centre, bool squared) {
    return parallel_sum(edges.size(), 4096,
                        [&](size_t begin, size_t end) {
                          double sum = 0;
                          for (size_t e = begin; e < end; ++e) {
                            const double d = ratio(e) - centre;
                            sum += squared ? d * d : d;
                          }
                          return sum;
                        }) /
           static_cast<double>(edges.size());
  };
  return std::sqrt(moment(moment(0, false), true));
}

namespace {

/// Marks the neighbours of these vertices and adds them to the list.
void grow(const Connectivity& c, std::vector<char>& marked, std::vector<int>& vertices) {
  for (size_t i = 0, count = vertices.size(); i < count; ++i)
    for (int n : c.vertex_neighbours[vertices[i]])
      if (!std::exchange(marked[static_cast<size_t>(n)], 1)) vertices.push_back(n);
}

/// The corners of all faces with an angle below the threshold (degrees) and `rings` rings around them.
std::vector<int> around_bad_faces(const Mat3X& points, const Connectivity& c, double threshold, int rings) {
  const double limit = 1 / std::tan(threshold * std::numbers::pi / 180);
  std::vector<char> bad(c.faces.size());
  parallel_for(c.faces.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) bad[f] = greatest_cotangent(points, c.faces[f]) > limit;
  });
  std::vector<char> marked(static_cast<size_t>(c.vertex_count), 0);
  std::vector<int> vertices;
  for (size_t f = 0; f < c.faces.size(); ++f)
    if (bad[f])
      for (int v : c.faces[f])
        if (!std::exchange(marked[static_cast<size_t>(v)], 1)) vertices.push_back(v);
  for (int ring = 0; ring < rings; ++ring) grow(c, marked, vertices);
  return vertices;
}

/// Marks those of the vertices that moved farther than `rest` and the neighbours of those: all others have
/// found their place.
void mark_restless(const Connectivity& c, const std::vector<int>& vertices, const std::vector<double>& moves,
                   double rest, std::vector<char>& active) {
  const auto moved = [&](int v) { return moves[static_cast<size_t>(v)] > rest; };
  parallel_for(vertices.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      active[static_cast<size_t>(vertices[i])] =
          moved(vertices[i]) || std::ranges::any_of(c.vertex_neighbours[vertices[i]], moved);
  });
}

/// One stage: sweeps over what lies around faces with an angle below the threshold.
void raise(Relaxation& r, double threshold, const PolishOptions& o, const Observer& observer,
           PolishResult& result) {
  const std::vector<int> vertices = around_bad_faces(r.placement.points, r.connectivity, threshold, o.rings);
  std::vector<char> active(static_cast<size_t>(r.connectivity.vertex_count), 0);
  for (int v : vertices) active[static_cast<size_t>(v)] = 1;
  for (int sweep = 0; sweep < o.sweeps && !result.interrupted; ++sweep, ++result.sweeps) {
    const std::vector<double> moves =
        local_newton_sweep(r, active, {.over_relaxation = o.over_relaxation, .rest = .3 * o.rest});
    mark_restless(r.connectivity, vertices, moves, o.rest, active);
    result.interrupted = observer && !observer({.step = result.sweeps});
  }
}

}  // namespace

PolishResult polish(Relaxation& r, const TargetLengths& targets, const PolishOptions& o,
                    const Observer& observer) {
  const auto& edges = r.connectivity.edges;
  const auto& faces = r.connectivity.faces;
  PolishResult result;
  result.least_angle_before = result.least_angle_after = least_angle(r.placement.points, faces);
  result.edge_error_before = result.edge_error_after =
      relative_edge_deviation(r.placement.points, edges, targets);

  const EnergyTerms terms = r.energy.terms;
  Placement kept = r.placement;
  double best = result.least_angle_before;
  r.energy.terms.altitude = 0;
  int kept_stages = 0;
  double step = o.threshold_step;
  double threshold = std::max(o.first_threshold, best + o.margin);
  for (; threshold <= o.last_threshold && !result.interrupted; threshold += step) {
    r.energy.terms.angle = result.stages == 0 ? o.first_weight : o.weight;
    r.energy.terms.angle_threshold = threshold * std::numbers::pi / 180;
    raise(r, threshold, o, observer, result);
    ++result.stages;

    const double angle = least_angle(r.placement.points, faces);
    const double error = relative_edge_deviation(r.placement.points, edges, targets);
    if (kept_stages > 0 && angle < best - o.keep_within) break;  // what bounds it is not the threshold
    const double limit = kept_stages > 0 ? o.edge_error_limit : 1;
    if (error > limit * result.edge_error_before) {  // too far: half the way, from where it was not
      r.placement = kept;
      const double reached = kept_stages > 0 ? threshold - step : best;
      step = std::min(step, threshold - reached) / 2;
      if (kept_stages == 0) step = (threshold - reached) / 2;
      if (step < o.least_step) break;
      threshold = reached;
      continue;
    }
    if (angle < best - o.keep_within) continue;
    best = std::max(best, angle);
    kept = r.placement;
    ++kept_stages;
    result.least_angle_after = angle;
    result.edge_error_after = error;
  }
  r.placement = std::move(kept);
  positions(r.mesh) = r.placement.points;
  r.energy.terms = terms;
  return result;
}

}  // namespace hooke
