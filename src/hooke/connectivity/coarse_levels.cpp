#include "hooke/connectivity/coarse_levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

/// How far the surface turns along an arc of the target length, radians, and how much of it is like that.
struct Turn {
  double angle, weight;
};

/// Per half-edge; without weight where the edge has had its turn.
std::vector<Turn> turns(const AdaptingMesh& m) {
  const Triangulation& t = m.triangulation;
  const Mat3X& N = m.placement.normals;
  std::vector<Turn> turns(static_cast<size_t>(t.half_edge_count()), Turn{0, 0});
  parallel_for(turns.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int h = static_cast<int>(i);
      if (t.twin(h) > h) continue;
      const Vec3 a = N.col(t.side(h)), b = N.col(t.side(Triangulation::next(h)));
      const double length = relative_length(m, h);
      if (length > 0) turns[i] = {std::atan2(a.cross(b).norm(), a.dot(b)) / length, length * length};
    }
  });
  return turns;
}

/// The angle that no more than this part of the weights exceeds; 0 without any.
double exceeded_by(double share, std::vector<Turn> turns) {
  double left = 0;
  for (const Turn& turn : turns) left += share * turn.weight;
  std::ranges::make_heap(turns, {}, &Turn::angle);
  for (; !turns.empty(); turns.pop_back()) {
    if ((left -= turns.front().weight) < 0) return turns.front().angle;
    std::ranges::pop_heap(turns, {}, &Turn::angle);
  }
  return 0;
}

/// How many of the ids [0, count) are such; asked several at once.
double count_of(int count, const auto& is_such) {
  return parallel_sum(static_cast<size_t>(count), 4096, [&](size_t begin, size_t end) {
    double number = 0;
    for (size_t i = begin; i < end; ++i) number += is_such(static_cast<int>(i));
    return number;
  });
}

bool is_regular(const AdaptingMesh& m, const CoarseLimits& limits) {
  const Triangulation& t = m.triangulation;
  const auto is_inner = [&](int v) { return t.valence(v) > 0 && !t.on_boundary(v); };
  const auto is_edge = [&](int h) { return t.twin(h) <= h; };
  const auto is_misfit = [&](int h) {
    const double length = relative_length(m, h);
    return length < limits.shortest || length > limits.longest;
  };
  const int ids = t.id_count(), half_edges = t.half_edge_count();
  return count_of(ids, [&](int v) { return is_inner(v) && t.valence(v) != 6; }) <=
             limits.irregular_share * count_of(ids, is_inner) &&
         count_of(half_edges, [&](int h) { return is_edge(h) && is_misfit(h); }) <=
             limits.misfit_share * count_of(half_edges, is_edge);
}

/// Of the chord of a circular arc that turns by so much, over the chord's length.
double relative_sagitta(double turn) {
  return turn < std::numbers::pi ? .5 * std::tan(turn / 4) : .5;
}

}  // namespace

int coarse_levels(const AdaptingMesh& m, double wanted_faces, const CoarseLimits& limits) {
  if (!m.constraints.creases.empty() || is_regular(m, limits)) return 0;
  const double turn = exceeded_by(limits.bent_share, turns(m));
  const auto still = static_cast<double>(std::ranges::count(m.constraints.freedom, Freedom::fixed));
  const std::vector<int>& wanted = m.curve_edges.wanted;
  const double on_curves = std::accumulate(wanted.begin(), wanted.end(), 0.);
  const auto bears = [&](int level) {
    const double scale = std::pow(2, level), faces = wanted_faces / (scale * scale), vertices = .5 * faces;
    return faces >= limits.least_faces && relative_sagitta(scale * turn) <= limits.sagitta &&
           still + on_curves / scale <= limits.rim_share * vertices;
  };
  int level = 0;
  while (level < limits.levels && bears(level + 1)) ++level;
  return level;
}

}  // namespace hooke
