#include "hooke/coarse_levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hooke {
namespace {

/// How far the surface turns along an arc of the target length, radians: per edge.
std::vector<double> turns(const AdaptingMesh& m) {
  const Triangulation& t = m.triangulation;
  const Mat3X& N = m.placement.normals;
  std::vector<double> turns;
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.twin(h) > h) continue;
    const Vec3 a = N.col(t.side(h)), b = N.col(t.side(Triangulation::next(h)));
    const double length = relative_length(m, h);
    if (length > 0) turns.push_back(std::atan2(a.cross(b).norm(), a.dot(b)) / length);
  }
  return turns;
}

/// What no more than this part of the values exceeds; 0 without values.
double exceeded_by(double share, std::vector<double> values) {
  if (values.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>((1 - share) * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + place);
  return values[static_cast<size_t>(place)];
}

/// Of the chord of a circular arc that turns by so much, over the chord's length.
double relative_sagitta(double turn) {
  return turn < std::numbers::pi ? .5 * std::tan(turn / 4) : .5;
}

}  // namespace

int coarse_levels(const AdaptingMesh& m, double wanted_faces, const CoarseLimits& limits) {
  if (!m.constraints.creases.empty()) return 0;
  const double turn = exceeded_by(limits.bent_share, turns(m));
  const auto on_rim = static_cast<double>(
      std::ranges::count_if(m.constraints.freedom, [](Freedom f) { return f != Freedom::surface; }));
  const auto bears = [&](int level) {
    const double scale = std::pow(2, level), faces = wanted_faces / (scale * scale), vertices = .5 * faces;
    return faces >= limits.least_faces && relative_sagitta(scale * turn) <= limits.sagitta &&
           on_rim / scale <= limits.rim_share * vertices;
  };
  int level = 0;
  while (level < limits.levels && bears(level + 1)) ++level;
  return level;
}

}  // namespace hooke
