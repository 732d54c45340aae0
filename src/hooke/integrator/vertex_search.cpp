#include "hooke/integrator/vertex_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace hooke {
namespace {

constexpr double far_off = 1.1;  // times the greatest cotangent: what the surface's bend may make of a place

}  // namespace

VertexSearch::VertexSearch(Relaxation& r, const VertexSearchOptions& options, const GuardOptions& guards)
    : r_(r),
      o_(options),
      guards_(guards),
      sides_{Side{VertexRing(r.sweeps.spokes, r.energy.targets()), {}, {}},
             Side{VertexRing(r.sweeps.spokes, r.energy.targets()), {}, {}}} {
  for (int k = 0; k < o_.directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / o_.directions;
    directions_.emplace_back(std::cos(angle), std::sin(angle));
  }
}

bool VertexSearch::improve(int vertex, double goal) {
  if (r_.sweeps.spokes[vertex].empty() || r_.retraction.stands_still(vertex)) return false;
  bool moved = false;
  double step = o_.first_step;
  look(vertex);
  while (worst_ > goal && step >= o_.last_step) {
    if (try_all(vertex, step)) {
      moved = true;
      look(vertex);
    } else {
      step /= 2;
    }
  }
  return moved;
}

/// Takes in the rings about the vertex as they lie.
void VertexSearch::look(int vertex) {
  const Placement& at = r_.placement;
  count_ = 1 + (at.other_side_of(vertex) >= 0);
  worst_ = 0;
  for (int s = 0; s < count_; ++s) {
    const int id = s == 0 ? vertex : at.other_side_of(vertex);
    auto& [ring, before, after] = sides_[static_cast<size_t>(s)];
    ring.gather(at, id);
    ring.shape(at.points.col(vertex), at.normals.col(id), before);
    worst_ = std::max(worst_, ring.greatest_cotangent(before));
  }
}

/// The greatest cotangent about the vertex if it went there, whether it may or not.
double VertexSearch::outcome(const VertexPlace& place) {
  double worst = 0;
  for (int s = 0; s < count_; ++s) {
    auto& [ring, before, after] = sides_[static_cast<size_t>(s)];
    ring.shape(place.point, s == 0 ? place.normal : place.other_normal, after);
    worst = std::max(worst, ring.greatest_cotangent(after));
  }
  return worst;
}

/// May the vertex go where outcome() looked last?
bool VertexSearch::may_go() const {
  return std::all_of(sides_.begin(), sides_.begin() + count_,
                     [&](const Side& s) { return s.ring.obeys(s.before, s.after, guards_); });
}

/// Goes to the best of the places at this distance, if one is better than where the vertex is.
bool VertexSearch::try_all(int vertex, double step) {
  Placement& at = r_.placement;
  const Vec3 tangent = r_.retraction.tangent(at, vertex), normal = at.normals.col(vertex);
  const bool on_curve = !tangent.isZero(0);
  const int neighbour = r_.sweeps.spokes[vertex][0].neighbour;
  const Vec3 edge = at.points.col(neighbour) - at.points.col(vertex);
  const Vec3 u = on_curve ? tangent : Vec3((edge - normal * normal.dot(edge)).normalized());
  const Vec3 v = normal.cross(u);
  const double length = step * r_.vertex_length[static_cast<size_t>(vertex)];
  // A face without area: any finite angle is better.
  double best =
      std::isfinite(worst_) ? worst_ - o_.least_gain * std::abs(worst_) : std::numeric_limits<double>::max();
  std::optional<VertexPlace> best_place;
  const auto look_at = [&](const Vec3& way) {
    VertexPlace place(at, vertex);
    place.point += way;
    if (outcome(place) > far_off * best) return;  // nor will it be better once it is on the surface
    place = r_.retraction.moved(at, vertex, way);
    const double worst = outcome(place);
    if (worst >= best || !may_go()) return;
    best = worst;
    best_place = place;
  };
  if (on_curve) {
    look_at(length * u);
    look_at(-length * u);
  } else {
    for (const Eigen::Vector2d& d : directions_) look_at(length * (d[0] * u + d[1] * v));
  }
  if (best_place) best_place->write_to(at, vertex);
  return best_place.has_value();
}

}  // namespace hooke
