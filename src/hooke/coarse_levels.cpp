#include "hooke/coarse_levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hooke {
namespace {

/// How far the surface turns along an arc of the target length, radians, and how much of it is like that.
struct Turn {
  double angle, weight;
};

std::vector<Turn> turns(const AdaptingMesh& m) {
  const Triangulation& t = m.triangulation;
  const Mat3X& N = m.placement.normals;
  std::vector<Turn> turns;
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.twin(h) > h) continue;
    const Vec3 a = N.col(t.side(h)), b = N.col(t.side(Triangulation::next(h)));
    const double length = relative_length(m, h);
    if (length > 0) turns.push_back({std::atan2(a.cross(b).norm(), a.dot(b)) / length, length * length});
  }
  return turns;
}

/// The angle that no more than this part of the weights exceeds; 0 without any.
double exceeded_by(double share, std::vector<Turn> turns) {
  std::ranges::sort(turns, std::ranges::greater(), &Turn::angle);
  double left = 0;
  for (const Turn& turn : turns) left += share * turn.weight;
  for (const Turn& turn : turns)
    if ((left -= turn.weight) < 0) return turn.angle;
  return 0;
}

bool is_regular(const AdaptingMesh& m, const CoarseLimits& limits) {
  const Triangulation& t = m.triangulation;
  double inner = 0, irregular = 0, edges = 0, misfits = 0;
  for (int v = 0; v < t.id_count(); ++v) {
    if (t.valence(v) <= 0 || t.on_boundary(v)) continue;
    ++inner;
    irregular += t.valence(v) != 6;
  }
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.twin(h) > h) continue;
    const double length = relative_length(m, h);
    ++edges;
    misfits += length < limits.shortest || length > limits.longest;
  }
  return irregular <= limits.irregular_share * inner && misfits <= limits.misfit_share * edges;
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
