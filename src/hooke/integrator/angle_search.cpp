#include "hooke/integrator/angle_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/vertex_ring.h"
#include "hooke/mesh/vertex_coloring.h"

namespace hooke {
namespace {

/// Searches for one vertex at a time; reused for many vertices to save allocations. Keeps references.
class VertexSearch {
 public:
  VertexSearch(Relaxation& relaxation, const VertexSearchOptions& options, const GuardOptions& guards);

  /// Moves the vertex, within the guards, until no cotangent around it exceeds the goal or no candidate is
  /// better. Returns whether it moved.
  bool improve(int vertex, double goal);

 private:
  struct Wedge {
    VertexRing ring;
    RingShape before, after;
  };

  void gather(int vertex);
  double max_cotangent_at(const SurfacePosition& position);
  bool guards_allow() const;
  bool move_to_best(int vertex, double step);

  Relaxation& r_;
  const VertexSearchOptions& o_;
  const GuardOptions& guards_;
  std::vector<Eigen::Vector2d> directions_;
  std::array<Wedge, 2> wedges_;
  int count_ = 1;     // number of wedges
  double worst_ = 0;  // largest cotangent around the vertex
};

/// Factor by which a candidate may exceed the cotangent to beat before it is projected to the surface.
constexpr double projection_allowance = 1.1;

}  // namespace

VertexSearch::VertexSearch(Relaxation& r, const VertexSearchOptions& options, const GuardOptions& guards)
    : r_(r),
      o_(options),
      guards_(guards),
      wedges_{Wedge{VertexRing(r.coloring.rings, r.energy.targets()), {}, {}},
              Wedge{VertexRing(r.coloring.rings, r.energy.targets()), {}, {}}} {
  for (int k = 0; k < o_.directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / o_.directions;
    directions_.emplace_back(std::cos(angle), std::sin(angle));
  }
}

bool VertexSearch::improve(int vertex, double goal) {
  if (r_.coloring.rings[vertex].empty() || r_.retraction.stands_still(vertex)) return false;
  bool moved = false;
  double step = o_.first_step;
  gather(vertex);
  while (worst_ > goal && step >= o_.last_step) {
    if (move_to_best(vertex, step)) {
      moved = true;
      gather(vertex);
    } else {
      step /= 2;
    }
  }
  return moved;
}

/// Gathers the rings around the vertex and measures them at its current position.
void VertexSearch::gather(int vertex) {
  const SurfacePositions& at = r_.positions;
  count_ = 1 + (at.other_wedge_of(vertex) >= 0);
  worst_ = 0;
  for (int s = 0; s < count_; ++s) {
    const int id = s == 0 ? vertex : at.other_wedge_of(vertex);
    auto& [ring, before, after] = wedges_[static_cast<size_t>(s)];
    ring.gather(at, id);
    ring.shape(at.points.col(vertex), at.normals.col(id), before);
    worst_ = std::max(worst_, ring.max_cotangent(before));
  }
}

/// The largest cotangent around the vertex at this position, whether or not the guards allow it.
double VertexSearch::max_cotangent_at(const SurfacePosition& position) {
  double worst = 0;
  for (int s = 0; s < count_; ++s) {
    auto& [ring, before, after] = wedges_[static_cast<size_t>(s)];
    ring.shape(position.point, s == 0 ? position.normal : position.other_normal, after);
    worst = std::max(worst, ring.max_cotangent(after));
  }
  return worst;
}

/// Do the guards allow the position evaluated last by max_cotangent_at()?
bool VertexSearch::guards_allow() const {
  return std::all_of(wedges_.begin(), wedges_.begin() + count_,
                     [&](const Wedge& s) { return s.ring.obeys(s.before, s.after, guards_); });
}

/// Moves the vertex to the best candidate at this distance if it is better than the current position.
bool VertexSearch::move_to_best(int vertex, double step) {
  SurfacePositions& at = r_.positions;
  const Vec3 tangent = r_.retraction.tangent(at, vertex), normal = at.normals.col(vertex);
  const bool on_curve = !tangent.isZero(0);
  const int neighbour = r_.coloring.rings[vertex][0].neighbour;
  const Vec3 edge = at.points.col(neighbour) - at.points.col(vertex);
  const Vec3 u = on_curve ? tangent : Vec3((edge - normal * normal.dot(edge)).normalized());
  const Vec3 v = normal.cross(u);
  const double length = step * r_.vertex_length[static_cast<size_t>(vertex)];
  // At a face without area any finite angle is better.
  double cotangent_to_beat = std::isfinite(worst_) ? worst_ - o_.min_relative_gain * std::abs(worst_)
                                                   : std::numeric_limits<double>::max();
  std::optional<SurfacePosition> best;
  const auto test = [&](const Vec3& displacement) {
    SurfacePosition candidate(at, vertex);
    candidate.point += displacement;
    if (max_cotangent_at(candidate) > projection_allowance * cotangent_to_beat)
      return;  // the projection would not make it better
    candidate = r_.retraction.moved(at, vertex, displacement);
    const double worst = max_cotangent_at(candidate);
    if (worst >= cotangent_to_beat || !guards_allow()) return;
    cotangent_to_beat = worst;
    best = candidate;
  };
  if (on_curve) {
    test(length * u);
    test(-length * u);
  } else {
    for (const Eigen::Vector2d& d : directions_) test(length * (d[0] * u + d[1] * v));
  }
  if (best) best->write_to(at, vertex);
  return best.has_value();
}

namespace {

constexpr size_t angle_search_block = 4096;

constexpr double ideal_min_angle = 60;  // degrees, of an equilateral triangle

double cotangent_of(double degrees) {
  return 1 / std::tan(degrees * std::numbers::pi / 180);
}

/// The sum and the sum of squares of l / L_e - 1.
struct EdgeErrors {
  double sum = 0, squares = 0;

  void add(const Relaxation& r, size_t edge) {
    const auto& [a, b] = r.adjacency.edges[edge];
    const double l = (r.positions.points.col(b) - r.positions.points.col(a)).norm();
    const double error = l / r.energy.targets().edge[edge] - 1;
    sum += error;
    squares += error * error;
  }
  EdgeErrors& operator+=(const EdgeErrors& other) {
    sum += other.sum;
    squares += other.squares;
    return *this;
  }
  EdgeErrors& operator-=(const EdgeErrors& other) {
    sum -= other.sum;
    squares -= other.squares;
    return *this;
  }
  double deviation(size_t edges) const {
    const double count = static_cast<double>(edges), mean = sum / count;
    return std::sqrt(std::max(0., squares / count - mean * mean));
  }
};

EdgeErrors errors_of(const Relaxation& r, const std::vector<int>& edges) {
  EdgeErrors errors;
  for (int e : edges) errors.add(r, static_cast<size_t>(e));
  return errors;
}

EdgeErrors errors_of_all(const Relaxation& r) {
  const size_t count = r.adjacency.edges.size();
  std::vector<EdgeErrors> parts((count + angle_search_block - 1) / angle_search_block);
  parallel_for(parts.size(), 1, [&](size_t begin, size_t end) {
    for (size_t part = begin; part < end; ++part)
      for (size_t e = part * angle_search_block; e < std::min(count, (part + 1) * angle_search_block); ++e)
        parts[part].add(r, e);
  });
  EdgeErrors errors;
  for (const EdgeErrors& part : parts) errors += part;
  return errors;
}

/// Measures of all faces and edges. Faces with small angles are kept in a separate list, the only one that a
/// round searches.
class Measures {
 public:
  explicit Measures(const Relaxation& r)
      : r_(r), cotangents_(r.adjacency.faces.size()), errors_(errors_of_all(r)) {
    parallel_for(cotangents_.size(), angle_search_block, [&](size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f) measure_face(f);
    });
    start_deviation_ = deviation();
    list_worst();
  }

  double min_angle() {
    if (max_cotangent_of(listed_) < listed_from_) list_worst();
    return angle_with_cotangent(max_cotangent_of(listed_));
  }

  /// Standard deviation of l / L_e, relative to its start.
  double edge_error() const { return start_deviation_ > 0 ? deviation() / start_deviation_ : 1; }

  /// The corners of at most `max_faces` faces with an angle below `goal` (degrees), worst face first.
  std::vector<int> worst_corners(double goal, int max_faces) {
    const double limit = cotangent_of(goal);
    if (limit < listed_from_) list_below(goal + listed_above);
    std::vector<std::pair<double, int>> worst;
    for (int f : listed_)
      if (const double cotangent = cotangents_[static_cast<size_t>(f)]; cotangent >= limit)
        worst.emplace_back(-cotangent, f);
    std::ranges::sort(worst);
    if (std::ssize(worst) > max_faces) worst.resize(static_cast<size_t>(max_faces));
    std::vector<int> corners;
    for (const auto& [cotangent, f] : worst) {
      const Triangle& t = r_.adjacency.faces[static_cast<size_t>(f)];
      corners.insert(corners.end(), t.begin(), t.end());
    }
    return corners;
  }

  /// Calls `move`, which moves these vertices, and updates the measures around them.
  template <typename Move>
  void update_around(const std::vector<int>& vertices, const Move& move) {
    const std::vector<int> edges = sorted_union(r_.adjacency.vertex_edges, vertices);
    errors_ -= errors_of(r_, edges);
    move();
    errors_ += errors_of(r_, edges);
    for (int f : sorted_union(r_.adjacency.vertex_faces, vertices)) {
      measure_face(static_cast<size_t>(f));
      list_if_low(f);
    }
  }

 private:
  static constexpr double listed_above = 3;  // degrees by which the list reaches beyond the angle asked for

  void measure_face(size_t f) { cotangents_[f] = max_cotangent(r_.positions.points, r_.adjacency.faces[f]); }
  double deviation() const { return errors_.deviation(r_.adjacency.edges.size()); }

  double max_cotangent_of(const std::vector<int>& faces) const {
    double largest = -std::numeric_limits<double>::infinity();
    for (int f : faces) largest = std::max(largest, cotangents_[static_cast<size_t>(f)]);
    return largest;
  }

  void list_worst() {
    list_below(angle_with_cotangent(*std::ranges::max_element(cotangents_)) + listed_above);
  }

  void list_below(double angle) {
    listed_from_ = cotangent_of(angle);
    listed_.clear();
    is_listed_.assign(cotangents_.size(), 0);
    for (size_t f = 0; f < cotangents_.size(); ++f) list_if_low(static_cast<int>(f));
  }

  void list_if_low(int f) {
    char& is_listed = is_listed_[static_cast<size_t>(f)];
    if (is_listed || !(cotangents_[static_cast<size_t>(f)] >= listed_from_)) return;
    is_listed = 1;
    listed_.push_back(f);
  }

  const Relaxation& r_;
  std::vector<double> cotangents_;  // largest cotangent per face
  double listed_from_ = 0;          // cotangent of the angle below which faces are listed
  std::vector<int> listed_;         // all faces with a smaller angle, and some that had one
  std::vector<char> is_listed_;     // per face
  EdgeErrors errors_;
  double start_deviation_ = 0;
};

/// Improves each of the vertices (ascending) in turn; returns how many moved.
int improve(Relaxation& r, const std::vector<int>& vertices, const VertexSearchOptions& options,
            const GuardOptions& guards, double goal) {
  std::vector<char> moved(vertices.size(), 0);
  for_each_block(r.coloring, [&](int begin, int end) {
    const auto first = std::ranges::lower_bound(vertices, begin);
    if (first == vertices.end() || *first >= end) return;
    VertexSearch search(r, options, guards);
    for (auto v = first; v != vertices.end() && *v < end; ++v)
      moved[static_cast<size_t>(v - vertices.begin())] = search.improve(*v, goal);
  });
  return static_cast<int>(std::ranges::count(moved, 1));
}

/// Runs rounds until none raises the minimum angle any more.
void search_within(Relaxation& r, const AngleSearchOptions& o, const GuardOptions& guards, Measures& measures,
                   AngleSearchResult& result) {
  double min_angle = measures.min_angle();
  double range = o.angle_range;
  VertexSearchOptions vertex = o.vertex;
  while (result.rounds < o.max_rounds && range > o.min_rise && min_angle + o.min_rise < ideal_min_angle) {
    const double goal = min_angle + range;
    std::vector<int> vertices = with_rings(r.adjacency, measures.worst_corners(goal, o.max_faces), o.rings);
    std::ranges::sort(vertices);
    std::vector<SurfacePosition> before;
    for (int v : vertices) before.emplace_back(r.positions, v);
    int moves = 0;
    measures.update_around(vertices, [&] {
      for (int sweep = 0, moved = 1; sweep < o.sweeps && moved > 0; ++sweep)
        moves += moved = improve(r, vertices, vertex, guards, cotangent_of(goal));
    });
    ++result.rounds;
    if (moves == 0) return;  // a smaller range of angles would not move any either
    const double now = measures.min_angle();
    if (now < min_angle + o.min_rise || measures.edge_error() > o.edge_error_limit) {
      measures.update_around(vertices, [&] {
        for (size_t i = 0; i < vertices.size(); ++i) before[i].write_to(r.positions, vertices[i]);
      });
      range /= 2;  // fewer faces and shorter steps lengthen the edges less
      vertex.first_step = std::max(vertex.last_step, vertex.first_step / 2);
      continue;
    }
    result.moves += moves;
    result.vertices.insert(result.vertices.end(), vertices.begin(), vertices.end());
    min_angle = now;
  }
}

}  // namespace

AngleSearchResult search_angles(Relaxation& r, const AngleSearchOptions& o) {
  AngleSearchResult result;
  if (r.adjacency.faces.empty()) return result;
  Measures measures(r);
  GuardOptions guards = r.guards.options();
  search_within(r, o, guards, measures, result);
  if (o.sagitta > guards.sagitta) {
    guards.sagitta = o.sagitta;
    search_within(r, o, guards, measures, result);
  }
  r.retraction.count();
  std::ranges::sort(result.vertices);
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  return result;
}

}  // namespace hooke
