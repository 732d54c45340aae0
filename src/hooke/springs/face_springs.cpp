#include "hooke/springs/face_springs.h"

#include <algorithm>
#include <numbers>

#include "hooke/core/fast_log.h"

namespace hooke {
namespace {

constexpr double altitude_ratio = std::numbers::sqrt3 / 2;  // of an equilateral triangle

/// An edge and what the energy changes by with its length.
struct EdgeLanes {
  LaneVec vector;
  Lanes length, by_length;
};

HOOKE_INLINE void load_edges(const FaceSprings& f, EdgeLanes (&edges)[3]) {
  Lanes target;
  load(f.face_target, target);
  const Lanes floor = FaceSprings::least_length * target;
  for (std::size_t k = 0; k < 3; ++k) {
    LaneVec a, b;
    load(f.corners + 3 * lane_count * ((k + 1) % 3), lane_count, a);
    load(f.corners + 3 * lane_count * ((k + 2) % 3), lane_count, b);
    EdgeLanes& e = edges[k];
    e.vector = {b.x - a.x, b.y - a.y, b.z - a.z};
    dot(e.vector, e.vector, e.length);
    take_sqrt(e.length);
    e.length = e.length > floor ? e.length : floor;
  }
}

/// U(l; L) / L^2. [4]
HOOKE_INLINE void add_strings(const FaceSprings& f, double weight, EdgeLanes (&edges)[3], Lanes& energy) {
  const Lanes one = Lanes{} + 1.;
  Lanes ratios = one, sum = {};
  for (std::size_t k = 0; k < 3; ++k) {
    Lanes L, has;
    load(f.edge_target + lane_count * k, L);
    load(f.has_edge + lane_count * k, has);
    EdgeLanes& e = edges[k];
    const LaneMask stretched = e.length >= L, counts = has > 0.;
    const Lanes excess = e.length / L - 1.;
    sum += has * (stretched ? .5 * excess * excess : excess);
    ratios *= counts & ~stretched ? L / e.length : one;
    e.by_length = weight * has * excess / (stretched ? L : e.length);
  }
  take_log(ratios);
  energy += weight * (sum + ratios);
}

/// U(h; h0) / h0^2 of the altitudes below h0.
HOOKE_INLINE void add_altitudes(const FaceSprings& f, double weight, const Lanes& area, EdgeLanes (&edges)[3],
                                Lanes& by_area, Lanes& energy) {
  const Lanes zero = {}, one = zero + 1.;
  Lanes h0, has;
  load(f.face_target, h0);
  load(f.has_face, has);
  h0 *= altitude_ratio;
  const Lanes w = weight * has;
  Lanes ratios = one, sum = zero;
  for (EdgeLanes& e : edges) {
    const Lanes z = h0 * e.length / area;  // h0 / h
    const LaneMask below = z > 1.;
    ratios *= below ? z : one;
    sum += below ? 1. / z - 1. : zero;
    const Lanes slope = below ? w * (1. - z) / h0 : zero;
    const Lanes over_length = slope / e.length;
    by_area += over_length;
    e.by_length -= over_length * area / e.length;
  }
  take_log(ratios);
  energy += w * (sum + ratios);
}

HOOKE_INLINE void add_to_corner(FaceSprings& f, std::size_t corner, const Lanes& factor, const LaneVec& v) {
  LaneVec g;
  load(f.gradient + 3 * lane_count * corner, lane_count, g);
  g = {g.x + factor * v.x, g.y + factor * v.y, g.z + factor * v.z};
  store(g, f.gradient + 3 * lane_count * corner, lane_count);
}

}  // namespace

HOOKE_SIMD void evaluate_face_springs(double string, double altitude, FaceSprings& f) {
  EdgeLanes edges[3];
  load_edges(f, edges);
  LaneVec normal;
  Lanes area, target;  // doubled
  cross(edges[1].vector, edges[2].vector, normal);
  dot(normal, normal, area);
  take_sqrt(area);
  load(f.face_target, target);
  f.flat = any(~(area > FaceSprings::least_length * target * target));
  if (f.flat) return;

  Lanes energy = {}, by_area = {};
  add_strings(f, string, edges, energy);
  if (altitude > 0) add_altitudes(f, altitude, area, edges, by_area, energy);
  f.energy = sum_of(energy);

  by_area /= area;
  const Lanes zero = {};
  std::fill(std::begin(f.gradient), std::end(f.gradient), 0.);
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgeLanes& e = edges[k];
    const Lanes pull = e.by_length / e.length;
    LaneVec lift;
    cross(normal, e.vector, lift);
    add_to_corner(f, k, by_area, lift);
    add_to_corner(f, (k + 2) % 3, pull, e.vector);
    add_to_corner(f, (k + 1) % 3, zero - pull, e.vector);
  }
}

}  // namespace hooke
