#include "hooke/polish.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <cstdlib>
#include "hooke/local_newton.h"
#include "hooke/parallel.h"

namespace hooke {

double least_angle(const Mat3X& points, const std::vector<Triangle>& faces) {
  std::vector<double> least(faces.size());
  parallel_for(faces.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      least[f] = std::numbers::pi;
      for (size_t k = 0; k < 3; ++k) {
        const Vec3 p = points.col(faces[f][k]);
        const Vec3 a = points.col(faces[f][(k + 1) % 3]) - p;
        const Vec3 b = points.col(faces[f][(k + 2) % 3]) - p;
        least[f] = std::min(least[f], std::atan2(a.cross(b).norm(), a.dot(b)));
      }
    }
  });
  const auto it = std::min_element(least.begin(), least.end());
  return it == least.end() ? 0 : *it * 180 / std::numbers::pi;
}

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

PolishResult polish(Relaxation& r, const TargetLengths& targets, const PolishOptions& o,
                    const Observer& observer) {
  const auto& faces = r.connectivity.faces;
  const auto& edges = r.connectivity.edges;
  PolishResult result;
  result.least_angle_before = result.least_angle_after = least_angle(r.placement.points, faces);
  result.edge_error_before = result.edge_error_after =
      relative_edge_deviation(r.placement.points, edges, targets);

  const EnergyTerms terms = r.energy.terms;
  Placement kept = r.placement;
  double best = result.least_angle_before;
  r.energy.terms.altitude = 0;
  double threshold = std::max(o.first_threshold, best + o.margin);
  for (; threshold <= o.last_threshold && !result.interrupted; threshold += o.threshold_step) {
    const bool first = result.stages == 0;
    r.energy.terms.angle = first ? o.first_weight : o.weight;
    r.energy.terms.angle_threshold = threshold * std::numbers::pi / 180;
    IntegrationOptions integration;
    integration.max_steps = first ? o.first_evaluations : o.evaluations;
    IntegrationResult relaxed;
    const char* es = getenv("SWEEPS");
    const char* om = getenv("OMEGA");
    int sweeps = es ? atoi(es) : 0;
    if (getenv("WF")) r.energy.terms.angle = first ? atof(getenv("WF")) : atof(getenv("W"));
    LocalNewtonOptions ln;
    if (om) ln.over_relaxation = atof(om);
    if (sweeps == 0)
      relaxed = relax_lbfgs(r, integration, LbfgsOptions{}, observer);
    else {
      double mv = 0;
      int i = 0;
      for (; i < sweeps; ++i) {
        mv = local_newton_sweep(r, {}, ln);
        ++relaxed.evaluations;
        if (mv < 1e-9) break;
        if (getenv("VERB") && (i % 20 == 0 || mv < 1e-6)) printf("  %d %.3g\n", i, mv);
      }
      if (getenv("VERB"))
        printf("t %.1f sweeps %d mv %.2g angle %.3f err %.5f\n", threshold, i, mv,
               least_angle(r.placement.points, faces),
               relative_edge_deviation(r.placement.points, edges, targets));
    }
    ++result.stages;
    result.evaluations += relaxed.evaluations;
    result.interrupted = relaxed.reason == StopReason::interrupted;

    const double angle = least_angle(r.placement.points, faces);
    const double error = relative_edge_deviation(r.placement.points, edges, targets);
    if (error > result.edge_error_before) break;
    if (angle < best - o.keep_within) continue;
    best = std::max(best, angle);
    kept = r.placement;
    result.least_angle_after = angle;
    result.edge_error_after = error;
  }
  r.placement = std::move(kept);
  positions(r.mesh) = r.placement.points;
  r.energy.terms = terms;
  return result;
}

}  // namespace hooke
