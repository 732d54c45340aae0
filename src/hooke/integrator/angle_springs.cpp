#include "hooke/integrator/angle_springs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/gauss_seidel.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/target_lengths.h"

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

/// The corners of all faces with an angle below the threshold (degrees), and the vertices around them that
/// may move.
std::vector<int> around_bad_faces(const Mat3X& points, const Adjacency& c, double threshold) {
  constexpr int rings = 2;
  const double limit = cotangent_of(threshold);
  std::vector<char> bad(c.faces.size());
  parallel_for(c.faces.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) bad[f] = max_cotangent(points, c.faces[f]) > limit;
  });
  std::vector<int> vertices;
  for (size_t f = 0; f < c.faces.size(); ++f)
    if (bad[f]) vertices.insert(vertices.end(), c.faces[f].begin(), c.faces[f].end());
  return with_rings(c, vertices, rings);
}

/// One stage: sweeps over the vertices around faces with an angle below the threshold.
void raise(Relaxation& r, double threshold, const AngleSpringOptions& o, const Observer& observer,
           AngleSpringResult& result) {
  const auto watch = [&](Progress p) {
    p.step += result.sweeps;
    return observer(p);
  };
  const LocalRelaxationResult relaxed =
      relax_locally(r, around_bad_faces(r.positions.points, r.adjacency, threshold),
                    {.sweeps = o.sweeps, .rest = o.rest}, observer ? Observer(watch) : nullptr);
  result.sweeps += relaxed.sweeps;
  result.interrupted = relaxed.interrupted;
}

}  // namespace

AngleSpringResult raise_angles(Relaxation& r, const TargetLengths& targets, const AngleSpringOptions& o,
                               const Observer& observer) {
  const auto& edges = r.adjacency.edges;
  const auto& faces = r.adjacency.faces;
  AngleSpringResult result;
  result.min_angle_before = result.min_angle_after = min_angle(r.positions.points, faces);
  result.edge_error_before = result.edge_error_after =
      relative_edge_deviation(r.positions.points, edges, targets);

  const double limit = o.edge_error_limit * result.edge_error_before;
  double best = result.min_angle_before;
  double threshold = std::max(o.first_threshold, best + o.margin);
  double too_high = o.last_threshold + 1e-9;  // the lowest threshold known to cost too much
  if (threshold >= too_high) return result;
  const TermsScope scope(r);
  r.terms.altitude = 0;
  SurfacePositions kept = r.positions;
  int kept_stages = 0;
  double last_error = result.edge_error_before, last_threshold = best;  // of the last state kept
  double step = o.threshold_step;
  double reached = best;  // the highest threshold known not to cost too much
  while (threshold < too_high && !result.interrupted) {
    r.terms.angle = result.stages == 0 ? o.first_weight : o.weight;
    r.terms.angle_threshold = threshold * std::numbers::pi / 180;
    raise(r, threshold, o, observer, result);
    ++result.stages;

    const double angle = min_angle(r.positions.points, faces);
    const double error = relative_edge_deviation(r.positions.points, edges, targets);
    if (kept_stages > 0 && angle < best - o.keep_within) break;  // the threshold is not what limits the angle
    if (error > limit) {  // half the threshold step, from the last state kept
      r.positions = kept;
      too_high = threshold;
      step = (threshold - reached) / 2;
      if (step < o.min_step) break;
      threshold = reached + step;
      continue;
    }
    reached = threshold;
    if (angle >= best - o.keep_within) {
      best = std::max(best, angle);
      kept = r.positions;
      ++kept_stages;
      result.min_angle_after = angle;
      result.edge_error_after = error;
      // The error grows faster than linearly: a step predicted to exceed the limit is not tested.
      const double rise = 2 * std::max(0., error - last_error) / (threshold - last_threshold);  // per degree
      const double left = limit - error;
      if (rise * step > left) {
        step /= 2;
        if (step < o.min_step || (rise > 0 && rise * step > left)) break;
      }
      last_error = error;
      last_threshold = threshold;
    }
    threshold += step;
  }
  r.positions = std::move(kept);
  return result;
}

}  // namespace hooke
