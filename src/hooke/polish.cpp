#include "hooke/polish.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/local_newton.h"
#include "hooke/parallel.h"

namespace hooke {

std::vector<double> least_angles(const Mat3X& points, const std::vector<Triangle>& faces) {
  std::vector<double> least(faces.size());
  parallel_for(faces.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      least[f] = 180;
      for (size_t k = 0; k < 3; ++k) {
        const Vec3 p = points.col(faces[f][k]);
        const Vec3 a = points.col(faces[f][(k + 1) % 3]) - p;
        const Vec3 b = points.col(faces[f][(k + 2) % 3]) - p;
        least[f] = std::min(least[f], std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
      }
    }
  });
  return least;
}

double least_angle(const Mat3X& points, const std::vector<Triangle>& faces) {
  const std::vector<double> least = least_angles(points, faces);
  const auto it = std::min_element(least.begin(), least.end());
  return it == least.end() ? 0 : *it;
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

namespace {

/// Adds the neighbours of all marked vertices.
void grow(const Connectivity& c, std::vector<char>& marked) {
  const std::vector<char> inner = marked;
  for (const auto& [a, b] : c.edges)
    if (inner[static_cast<size_t>(a)] || inner[static_cast<size_t>(b)])
      marked[static_cast<size_t>(a)] = marked[static_cast<size_t>(b)] = 1;
}

/// Vertices that still move, and their neighbours: all others have found their place.
std::vector<char> still_moving(const Connectivity& c, const std::vector<double>& moves, double rest) {
  std::vector<char> marked(moves.size());
  for (size_t v = 0; v < moves.size(); ++v) marked[v] = moves[v] > rest;
  grow(c, marked);
  return marked;
}

/// Marks the corners of all faces with an angle below the threshold (degrees) and `rings` rings around them.
std::vector<char> around_bad_faces(const Mat3X& points, const Connectivity& c, double threshold, int rings) {
  std::vector<char> active(static_cast<size_t>(c.vertex_count), 0);
  const std::vector<double> angles = least_angles(points, c.faces);
  for (size_t f = 0; f < c.faces.size(); ++f)
    if (angles[f] < threshold)
      for (int v : c.faces[f]) active[static_cast<size_t>(v)] = 1;
  for (int ring = 0; ring < rings; ++ring) grow(c, active);
  return active;
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
  double step = o.threshold_step;
  double threshold = std::max(o.first_threshold, best + o.margin);
  for (; threshold <= o.last_threshold && !result.interrupted; threshold += step) {
    r.energy.terms.angle = result.stages == 0 ? o.first_weight : o.weight;
    r.energy.terms.angle_threshold = threshold * std::numbers::pi / 180;
    const std::vector<char> around = around_bad_faces(r.placement.points, r.connectivity, threshold, o.rings);
    std::vector<char> active = around;
    for (int sweep = 0; sweep < o.sweeps && !result.interrupted; ++sweep, ++result.sweeps) {
      active = still_moving(r.connectivity, local_newton_sweep(r, active, LocalNewtonOptions{}), o.rest);
      for (size_t v = 0; v < active.size(); ++v) active[v] &= around[v];
      result.interrupted = observer && !observer({.step = result.sweeps});
    }
    ++result.stages;

    const double angle = least_angle(r.placement.points, faces);
    const double error = relative_edge_deviation(r.placement.points, edges, targets);
    if (error > o.edge_error_limit *
                    result.edge_error_before) {  // too far: half the way from the last threshold that was not
      r.placement = kept;
      threshold -= step;
      step *= .5;
      if (step < o.least_step) break;
      continue;
    }
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
