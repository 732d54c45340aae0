#include "hooke/angle_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "hooke/least_angle.h"
#include "hooke/local_relaxation.h"
#include "hooke/parallel.h"
#include "hooke/polish.h"

namespace hooke {
namespace {

double cotangent_of(double degrees) {
  return 1 / std::tan(degrees * std::numbers::pi / 180);
}

/// The corners of the worst faces, worst first: those with an angle below `goal`.
std::vector<int> worst_corners(const Relaxation& r, double goal, const AngleSearchOptions& o) {
  const auto& faces = r.connectivity.faces;
  std::vector<double> cotangent(faces.size());
  parallel_for(faces.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) cotangent[f] = greatest_cotangent(r.placement.points, faces[f]);
  });
  const double limit = cotangent_of(goal);
  std::vector<int> worst;
  for (size_t f = 0; f < faces.size(); ++f)
    if (cotangent[f] >= limit) worst.push_back(static_cast<int>(f));
  std::ranges::stable_sort(worst, std::ranges::greater(),
                           [&](int f) { return cotangent[static_cast<size_t>(f)]; });
  if (std::ssize(worst) > o.max_faces) worst.resize(static_cast<size_t>(o.max_faces));
  std::vector<int> corners;
  for (int f : worst)
    corners.insert(corners.end(), faces[static_cast<size_t>(f)].begin(), faces[static_cast<size_t>(f)].end());
  return corners;
}

double edge_error_of(const Relaxation& r) {
  return relative_edge_deviation(r.placement.points, r.connectivity.edges, r.energy.targets());
}

class Search {
 public:
  Search(Relaxation& r, const AngleSearchOptions& options, const GuardOptions& guards)
      : r_(r),
        o_(options),
        guards_(guards),
        sides_{Side(VertexRing(r.sweeps.spokes, r.energy.targets())),
               Side(VertexRing(r.sweeps.spokes, r.energy.targets()))} {}

  /// Moves the vertex until no cotangent about it is above the goal or it finds nothing better. Returns
  /// whether it moved.
  bool improve(int vertex, double goal) {
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

 private:
  struct Side {
    explicit Side(VertexRing r) : ring(std::move(r)) {}
    VertexRing ring;
    RingShape before, after;
  };

  double worst_of(const Side& side, const RingShape& shape) const {
    double worst = 0;
    for (double c : side.ring.measures(shape).cotangent) worst = std::max(worst, c);
    return worst;
  }

  void look(int vertex) {
    const Placement& at = r_.placement;
    count_ = 1 + (at.other_side_of(vertex) >= 0);
    worst_ = 0;
    for (int s = 0; s < count_; ++s) {
      const int id = s == 0 ? vertex : at.other_side_of(vertex);
      Side& side = sides_[static_cast<size_t>(s)];
      side.ring.gather(at, id);
      side.ring.shape(at.points.col(vertex), at.normals.col(id), side.before);
      worst_ = std::max(worst_, worst_of(side, side.before));
    }
  }

  /// The greatest cotangent about the vertex if it went there; infinite where it may not.
  double outcome(const VertexPlace& place) {
    double worst = 0;
    for (int s = 0; s < count_; ++s) {
      Side& side = sides_[static_cast<size_t>(s)];
      side.ring.shape(place.point, s == 0 ? place.normal : place.other_normal, side.after);
      if (!side.ring.obeys(side.before, side.after, guards_)) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, worst_of(side, side.after));
    }
    return worst;
  }

  bool try_all(int vertex, double step) {
    Placement& at = r_.placement;
    const Vec3 tangent = at.tangents.col(vertex), normal = at.normals.col(vertex);
    const bool on_curve = !tangent.isZero(0);
    const int neighbour = r_.sweeps.spokes[vertex][0].neighbour;
    const Vec3 edge = at.points.col(neighbour) - at.points.col(vertex);
    const Vec3 u = on_curve ? tangent : Vec3((edge - normal * normal.dot(edge)).normalized());
    const Vec3 v = normal.cross(u);
    const double length = step * r_.vertex_length[static_cast<size_t>(vertex)];
    double best = worst_ - o_.least_gain * std::abs(worst_);
    std::optional<VertexPlace> best_place;
    const int count = on_curve ? 2 : o_.directions;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      const Vec3 way = on_curve ? Vec3((k == 0 ? length : -length) * u)
                                : Vec3(length * (std::cos(angle) * u + std::sin(angle) * v));
      const VertexPlace place = r_.retraction.moved(at, vertex, way);
      const double worst = outcome(place);
      if (worst >= best) continue;
      best = worst;
      best_place = place;
    }
    if (best_place) best_place->write_to(at, vertex);
    return best_place.has_value();
  }

  Relaxation& r_;
  const AngleSearchOptions& o_;
  const GuardOptions guards_;
  std::array<Side, 2> sides_;
  int count_ = 1;
  double worst_ = 0;  // greatest cotangent about the vertex
};

/// Goes on until no round raises the least angle any more.
void search_within(Relaxation& r, const AngleSearchOptions& o, const GuardOptions& guards,
                   double greatest_edge_error, AngleSearchResult& result) {
  Search search(r, o, guards);
  double least = least_angle(r.placement.points, r.connectivity.faces);
  double above = o.above_least;
  while (result.rounds < o.max_rounds && above > o.least_rise) {
    const Placement before = r.placement;
    const double goal = least + above;
    int moves = 0;
    for (int v : with_rings(r.connectivity, worst_corners(r, goal, o), o.rings))
      moves += search.improve(v, cotangent_of(goal));
    ++result.rounds;
    const double now = least_angle(r.placement.points, r.connectivity.faces);
    if (now < least + o.least_rise || edge_error_of(r) > greatest_edge_error) {
      r.placement = before;
      above /= 2;
      continue;
    }
    result.moves += moves;
    least = now;
  }
}

}  // namespace

AngleSearchResult search_angles(Relaxation& r, const AngleSearchOptions& o) {
  AngleSearchResult result;
  if (r.connectivity.faces.empty()) return result;
  const double greatest_edge_error = o.edge_error_limit * edge_error_of(r);
  GuardOptions guards = r.guards.options();
  search_within(r, o, guards, greatest_edge_error, result);
  if (o.sagitta > guards.sagitta) {
    guards.sagitta = o.sagitta;
    search_within(r, o, guards, greatest_edge_error, result);
  }
  r.retraction.count();
  return result;
}

}  // namespace hooke
