#include "hooke/integrator/angle_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/gauss_seidel.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/vertex_ring.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/energy.h"

namespace hooke {
namespace {

/// Pattern search for the position of one vertex that maximises the smallest angle around it; reused for many
/// vertices to save allocations. Keeps references. Steps are in target lengths.
class VertexSearch {
 public:
  static constexpr double first_step = .3;  // halved when no direction helps
  static constexpr double last_step = .01;  // the search ends below it

  VertexSearch(Relaxation& relaxation, double step, const ShapeLimits& limits);

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
  const double first_step_;
  const ShapeLimits& limits_;
  std::vector<Eigen::Vector2d> directions_;
  std::array<Wedge, 2> wedges_;
  int count_ = 1;     // number of wedges
  double worst_ = 0;  // largest cotangent around the vertex
};

/// Factor by which a candidate may exceed the cotangent to beat before it is projected to the surface.
constexpr double projection_allowance = 1.1;

}  // namespace

VertexSearch::VertexSearch(Relaxation& r, double step, const ShapeLimits& limits)
    : r_(r),
      first_step_(step),
      limits_(limits),
      wedges_{Wedge{VertexRing(r.coloring.rings, r.energy.targets()), {}, {}},
              Wedge{VertexRing(r.coloring.rings, r.energy.targets()), {}, {}}} {
  constexpr int directions = 8;  // in the tangent plane
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    directions_.emplace_back(std::cos(angle), std::sin(angle));
  }
}

bool VertexSearch::improve(int vertex, double goal) {
  if (r_.coloring.rings[vertex].empty() || r_.retraction.stands_still(vertex)) return false;
  bool moved = false;
  double step = first_step_;
  gather(vertex);
  while (worst_ > goal && step >= last_step) {
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
    auto& [ring, before, after] = wedges_[s];
    ring.gather(at, id);
    ring.shape(at.points.col(vertex), at.normals.col(id), before);
    worst_ = std::max(worst_, ring.max_cotangent(before));
  }
}

/// The largest cotangent around the vertex at this position, whether or not the guards allow it.
double VertexSearch::max_cotangent_at(const SurfacePosition& position) {
  double worst = 0;
  for (int s = 0; s < count_; ++s) {
    auto& [ring, before, after] = wedges_[s];
    ring.shape(position.point, s == 0 ? position.normal : position.other_normal, after);
    worst = std::max(worst, ring.max_cotangent(after));
  }
  return worst;
}

/// Do the guards allow the position evaluated last by max_cotangent_at()?
bool VertexSearch::guards_allow() const {
  return std::all_of(wedges_.begin(), wedges_.begin() + count_,
                     [&](const Wedge& s) { return s.ring.obeys(s.before, s.after, limits_); });
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
  const double length = step * r_.vertex_length[vertex];
  constexpr double least_gain = 1e-3;  // relative
  // At a face without area any finite angle is better.
  double cotangent_to_beat =
      std::isfinite(worst_) ? worst_ - least_gain * std::abs(worst_) : std::numeric_limits<double>::max();
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
  for (int e : edges) errors.add(r, e);
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
/// round searches; faces that no round could raise are set aside, which leaves them to their neighbours.
class Measures {
 public:
  explicit Measures(const Relaxation& r)
      : r_(r),
        cotangents_(r.adjacency.faces.size()),
        is_aside_(r.adjacency.faces.size(), 0),
        errors_(errors_of_all(r)) {
    parallel_for(cotangents_.size(), angle_search_block, [&](size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f) measure_face(f);
    });
    start_deviation_ = deviation();
    list_worst();
  }

  /// Of the faces that are not set aside, degrees.
  double min_angle() {
    if (max_cotangent_of(listed_) < listed_from_) list_worst();
    return angle_with_cotangent(max_cotangent_of(listed_));
  }

  /// Sets the faces with at most this angle (degrees) aside.
  void set_aside(double angle) {
    const double limit = cotangent_of(angle);
    for (int f : listed_)
      if (const double cotangent = cotangents_[f]; cotangent >= limit) {
        is_aside_[f] = 1;
        aside_.emplace_back(f, angle_with_cotangent(cotangent));
      }
    std::erase_if(listed_, [&](int f) { return is_aside_[f] != 0; });
  }

  /// Has a face lost more than this (degrees) since it was set aside?
  bool has_lost_aside(double tolerance) const {
    return std::ranges::any_of(aside_, [&](const auto& face) {
      return angle_with_cotangent(cotangents_[face.first]) < face.second - tolerance;
    });
  }

  /// No face is set aside any more.
  void take_back() {
    aside_.clear();
    std::ranges::fill(is_aside_, 0);
    list_worst();
  }

  /// Standard deviation of l / L_e, relative to its start.
  double edge_error() const { return start_deviation_ > 0 ? deviation() / start_deviation_ : 1; }

  /// The corners of at most `max_faces` faces with an angle below `goal` (degrees), worst face first.
  std::vector<int> worst_corners(double goal, int max_faces) {
    const double limit = cotangent_of(goal);
    if (limit < listed_from_) list_below(goal + listed_above);
    std::vector<std::pair<double, int>> worst;
    for (int f : listed_)
      if (const double cotangent = cotangents_[f]; cotangent >= limit) worst.emplace_back(-cotangent, f);
    std::ranges::sort(worst);
    if (std::ssize(worst) > max_faces) worst.resize(max_faces);
    std::vector<int> corners;
    for (const auto& [cotangent, f] : worst) {
      const Triangle& t = r_.adjacency.faces[f];
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
      measure_face(f);
      list_if_low(f);
    }
  }

 private:
  static constexpr double listed_above = 3;  // degrees by which the list reaches beyond the angle asked for

  void measure_face(size_t f) { cotangents_[f] = max_cotangent(r_.positions.points, r_.adjacency.faces[f]); }
  double deviation() const { return errors_.deviation(r_.adjacency.edges.size()); }

  double max_cotangent_of(const std::vector<int>& faces) const {
    double largest = -std::numeric_limits<double>::infinity();
    for (int f : faces) largest = std::max(largest, cotangents_[f]);
    return largest;
  }

  void list_worst() {
    double largest = -std::numeric_limits<double>::infinity();
    for (size_t f = 0; f < cotangents_.size(); ++f)
      if (!is_aside_[f]) largest = std::max(largest, cotangents_[f]);
    list_below(angle_with_cotangent(largest) + listed_above);
  }

  void list_below(double angle) {
    listed_from_ = cotangent_of(angle);
    listed_.clear();
    is_listed_.assign(cotangents_.size(), 0);
    for (size_t f = 0; f < cotangents_.size(); ++f) list_if_low(static_cast<int>(f));
  }

  void list_if_low(int f) {
    char& is_listed = is_listed_[f];
    if (is_listed || is_aside_[f] || !(cotangents_[f] >= listed_from_)) return;
    is_listed = 1;
    listed_.push_back(f);
  }

  const Relaxation& r_;
  std::vector<double> cotangents_;             // largest cotangent per face
  std::vector<char> is_aside_;                 // per face
  std::vector<std::pair<int, double>> aside_;  // faces and the angles they had then, degrees
  double listed_from_ = 0;                     // cotangent of the angle below which faces are listed
  std::vector<int> listed_;                    // all faces with a smaller angle, and some that had one
  std::vector<char> is_listed_;                // per face
  EdgeErrors errors_;
  double start_deviation_ = 0;
};

/// Rounds of the search within some limits.
class Search {
 public:
  Search(Relaxation& r, const AngleSearchOptions& o, const ShapeLimits& limits, Measures& measures,
         AngleSearchResult& result)
      : r_(r), o_(o), limits_(limits), measures_(measures), result_(result) {}

  /// Alternates rounds of angle springs (unless `with_springs` is false) and of pattern searches: each goes
  /// on while it raises the minimum angle. Faces that neither can raise are set aside. Ends where even a
  /// pattern search makes the edges too unequal.
  void run(bool with_springs) {
    int set_aside = 0, failures = 0;
    bool springs = with_springs;
    while (result_.rounds < o_.max_rounds && measures_.min_angle() + min_rise < ideal_min_angle) {
      double& range = springs ? spring_range_ : pattern_range_;
      const double start = measures_.min_angle();
      switch (round(springs, start, range)) {
        case Outcome::raised:
          failures = 0;
          continue;
        case Outcome::kept:
          break;
        case Outcome::worse:
          range /= 2;  // fewer faces and shorter steps lengthen the edges less
          if (!springs) first_step_ = std::max(VertexSearch::last_step, first_step_ / 2);
          if (range >= min_range) continue;
          range = min_range;
          break;
        case Outcome::too_long:
          return;
      }
      ++failures;
      if (with_springs) {
        springs = !springs;
        if (failures < 2) continue;
      }
      if (++set_aside > o_.max_set_aside) return;
      measures_.set_aside(start + min_rise);
      failures = 0;
    }
  }

 private:
  static constexpr int max_faces = 500;          // in range, worst first
  static constexpr double min_range = .5;        // degrees
  static constexpr double min_rise = .02;        // degrees by which a pattern search must raise the minimum
  static constexpr double tolerated_loss = .02;  // degrees, of the minimum angle
  static constexpr double tolerated_loss_aside = .05;

  enum class Outcome {
    raised,
    kept,      // the minimum angle has risen little, or lost no more than is tolerated
    worse,     // taken back
    too_long,  // taken back: even a small range of a pattern search makes the edges too unequal
  };

  /// Moves the vertices around the faces within `range` (degrees) of the minimum angle.
  Outcome round(bool springs, double start, double range) {
    const double goal = start + range;
    const int rings = springs ? 2 : 1;  // within which vertices move
    std::vector<int> vertices = with_rings(r_.adjacency, measures_.worst_corners(goal, max_faces), rings);
    std::ranges::sort(vertices);
    std::vector<SurfacePosition> before;
    for (int v : vertices) before.emplace_back(r_.positions, v);
    int moves = 0;
    measures_.update_around(vertices,
                            [&] { moves = springs ? relax(vertices, goal) : search(vertices, goal); });
    ++result_.rounds;
    const double now = measures_.min_angle();
    const bool is_too_long = measures_.edge_error() > o_.edge_error_limit;
    if (is_too_long || now < start - tolerated_loss || measures_.has_lost_aside(tolerated_loss_aside)) {
      measures_.update_around(vertices, [&] {
        for (size_t i = 0; i < vertices.size(); ++i) before[i].write_to(r_.positions, vertices[i]);
      });
      return is_too_long && !springs && range / 2 < min_range ? Outcome::too_long : Outcome::worse;
    }
    result_.moves += moves;
    result_.vertices.insert(result_.vertices.end(), vertices.begin(), vertices.end());
    constexpr double least_share = .2;  // of the range, by which springs must raise the minimum angle
    const double rise = springs ? least_share * range : min_rise;
    return now >= start + rise ? Outcome::raised : Outcome::kept;
  }

  /// Sweeps of Newton's method with angle springs below `goal`; returns the number of moves.
  int relax(const std::vector<int>& vertices, double goal) {
    constexpr double weight = 1000;
    constexpr int sweeps = 12;
    constexpr double rest = .003;  // in target lengths; a vertex that moves less skips the next sweep
    const TermsScope scope(r_);
    r_.terms.altitude = 0;
    r_.terms.angle = weight;
    r_.terms.angle_threshold = goal * std::numbers::pi / 180;
    // Copies outside `vertices` could not be put back.
    return relax_locally(r_, vertices, {.sweeps = sweeps, .rest = rest, .slides_copies = false}, nullptr)
        .moves;
  }

  /// Sweeps of pattern searches with the same goal; returns the number of moves.
  int search(const std::vector<int>& vertices, double goal) {
    constexpr int sweeps = 3;
    int moves = 0;
    for (int sweep = 0, last = 1; sweep < sweeps && last > 0; ++sweep, moves += last) {
      std::vector<char> moved(vertices.size(), 0);
      for_each_of(
          r_.coloring, vertices, [&] { return VertexSearch(r_, first_step_, limits_); },
          [&](VertexSearch& vertex, size_t i) {
            moved[i] = vertex.improve(vertices[i], cotangent_of(goal));
          });
      last = static_cast<int>(std::ranges::count(moved, 1));
    }
    return moves;
  }

  Relaxation& r_;
  const AngleSearchOptions& o_;
  const ShapeLimits& limits_;
  Measures& measures_;
  AngleSearchResult& result_;
  double first_step_ = VertexSearch::first_step;
  double pattern_range_ = 1, spring_range_ = o_.spring_range;  // degrees above the minimum angle
};

}  // namespace

AngleSearchResult search_angles(Relaxation& r, const AngleSearchOptions& o) {
  AngleSearchResult result;
  if (r.adjacency.faces.empty()) return result;
  Measures measures(r);
  ShapeLimits limits = r.guards.limits();
  Search(r, o, limits, measures, result).run(o.spring_range > 0);
  if (o.sagitta > limits.sagitta) {
    limits.sagitta = o.sagitta;
    measures.take_back();
    Search(r, o, limits, measures, result).run(false);
  }
  r.retraction.count();
  sort_unique(result.vertices);
  return result;
}

}  // namespace hooke
