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

/// Works on one vertex at a time; made once for many, for its memory. Keeps references.
class VertexSearch {
 public:
  VertexSearch(Relaxation& relaxation, const VertexSearchOptions& options, const GuardOptions& guards);

  /// Moves the vertex, as far as the guards let it, until no cotangent about it is above the goal or it finds
  /// nothing better. Returns whether it moved.
  bool improve(int vertex, double goal);

 private:
  struct Wedge {
    VertexRing ring;
    RingShape before, after;
  };

  void look(int vertex);
  double outcome(const SurfacePosition& place);
  bool may_go() const;
  bool try_all(int vertex, double step);

  Relaxation& r_;
  const VertexSearchOptions& o_;
  const GuardOptions& guards_;
  std::vector<Eigen::Vector2d> directions_;
  std::array<Wedge, 2> wedges_;
  int count_ = 1;     // of the sides
  double worst_ = 0;  // greatest cotangent about the vertex
};

constexpr double far_off = 1.1;  // times the greatest cotangent: what the surface's bend may make of a place

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

/// The greatest cotangent about the vertex if it went there, whether it may or not.
double VertexSearch::outcome(const SurfacePosition& place) {
  double worst = 0;
  for (int s = 0; s < count_; ++s) {
    auto& [ring, before, after] = wedges_[static_cast<size_t>(s)];
    ring.shape(place.point, s == 0 ? place.normal : place.other_normal, after);
    worst = std::max(worst, ring.max_cotangent(after));
  }
  return worst;
}

/// May the vertex go where outcome() looked last?
bool VertexSearch::may_go() const {
  return std::all_of(wedges_.begin(), wedges_.begin() + count_,
                     [&](const Wedge& s) { return s.ring.obeys(s.before, s.after, guards_); });
}

/// Goes to the best of the places at this distance, if one is better than where the vertex is.
bool VertexSearch::try_all(int vertex, double step) {
  SurfacePositions& at = r_.positions;
  const Vec3 tangent = r_.retraction.tangent(at, vertex), normal = at.normals.col(vertex);
  const bool on_curve = !tangent.isZero(0);
  const int neighbour = r_.coloring.rings[vertex][0].neighbour;
  const Vec3 edge = at.points.col(neighbour) - at.points.col(vertex);
  const Vec3 u = on_curve ? tangent : Vec3((edge - normal * normal.dot(edge)).normalized());
  const Vec3 v = normal.cross(u);
  const double length = step * r_.vertex_length[static_cast<size_t>(vertex)];
  // A face without area: any finite angle is better.
  double best =
      std::isfinite(worst_) ? worst_ - o_.min_gain * std::abs(worst_) : std::numeric_limits<double>::max();
  std::optional<SurfacePosition> best_place;
  const auto look_at = [&](const Vec3& way) {
    SurfacePosition place(at, vertex);
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

namespace {

constexpr size_t block = 4096;

constexpr double max_least_angle = 60;  // degrees; of an equilateral triangle

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
  std::vector<EdgeErrors> parts((count + block - 1) / block);
  parallel_for(parts.size(), 1, [&](size_t begin, size_t end) {
    for (size_t part = begin; part < end; ++part)
      for (size_t e = part * block; e < std::min(count, (part + 1) * block); ++e) parts[part].add(r, e);
  });
  EdgeErrors errors;
  for (const EdgeErrors& part : parts) errors += part;
  return errors;
}

/// The faces and edges as they lie. Faces with small angles stand in a list of their own: rounds look at no
/// others.
class Measures {
 public:
  explicit Measures(const Relaxation& r)
      : r_(r), cotangents_(r.adjacency.faces.size()), errors_(errors_of_all(r)) {
    parallel_for(cotangents_.size(), block, [&](size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f) look(f);
    });
    start_deviation_ = deviation();
    list_worst();
  }

  double min_angle() {
    if (max_cotangent_of(listed_) < listed_from_) list_worst();
    return angle_with_cotangent(max_cotangent_of(listed_));
  }

  /// Of l / L_e, over that at the start.
  double edge_error() const { return start_deviation_ > 0 ? deviation() / start_deviation_ : 1; }

  /// The corners of the worst faces, worst first: those with an angle below `goal`.
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

  /// Calls `move` and takes in what it does to these vertices.
  template <typename Move>
  void follow(const std::vector<int>& vertices, const Move& move) {
    const std::vector<int> edges = sorted_union(r_.adjacency.vertex_edges, vertices);
    errors_ -= errors_of(r_, edges);
    move();
    errors_ += errors_of(r_, edges);
    for (int f : sorted_union(r_.adjacency.vertex_faces, vertices)) {
      look(static_cast<size_t>(f));
      list_if_low(f);
    }
  }

 private:
  static constexpr double listed_above = 3;  // degrees, above what is asked for

  void look(size_t f) { cotangents_[f] = max_cotangent(r_.positions.points, r_.adjacency.faces[f]); }
  double deviation() const { return errors_.deviation(r_.adjacency.edges.size()); }

  double max_cotangent_of(const std::vector<int>& faces) const {
    double greatest = -std::numeric_limits<double>::infinity();
    for (int f : faces) greatest = std::max(greatest, cotangents_[static_cast<size_t>(f)]);
    return greatest;
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
  std::vector<double> cotangents_;  // the greatest of each face
  double listed_from_ = 0;          // cotangent of an angle
  std::vector<int> listed_;         // all faces with a smaller angle, and some that had one
  std::vector<char> is_listed_;     // per face
  EdgeErrors errors_;
  double start_deviation_ = 0;
};

/// Improves each of the vertices, which ascend, in turn; returns how many moved.
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

/// Goes on until no round raises the least angle any more.
void search_within(Relaxation& r, const AngleSearchOptions& o, const GuardOptions& guards, Measures& measures,
                   AngleSearchResult& result) {
  double least = measures.min_angle();
  double above = o.above_least;
  VertexSearchOptions vertex = o.vertex;
  while (result.rounds < o.max_rounds && above > o.min_rise && least + o.min_rise < max_least_angle) {
    const double goal = least + above;
    std::vector<int> vertices = with_rings(r.adjacency, measures.worst_corners(goal, o.max_faces), o.rings);
    std::ranges::sort(vertices);
    std::vector<SurfacePosition> before;
    for (int v : vertices) before.emplace_back(r.positions, v);
    int moves = 0;
    measures.follow(vertices, [&] {
      for (int sweep = 0, moved = 1; sweep < o.sweeps && moved > 0; ++sweep)
        moves += moved = improve(r, vertices, vertex, guards, cotangent_of(goal));
    });
    ++result.rounds;
    if (moves == 0) return;  // nor will fewer of them
    const double now = measures.min_angle();
    if (now < least + o.min_rise || measures.edge_error() > o.edge_error_limit) {
      measures.follow(vertices, [&] {
        for (size_t i = 0; i < vertices.size(); ++i) before[i].write_to(r.positions, vertices[i]);
      });
      above /= 2;  // less, and with shorter steps, which cost less
      vertex.first_step = std::max(vertex.last_step, vertex.first_step / 2);
      continue;
    }
    result.moves += moves;
    result.vertices.insert(result.vertices.end(), vertices.begin(), vertices.end());
    least = now;
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
