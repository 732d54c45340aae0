#include "hooke/remesh/mending.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/remesh/attempts.h"
#include "hooke/remesh/flaws.h"
#include "hooke/remesh/limiting_factors.h"

namespace hooke {
namespace {

constexpr double well_within = .95;  // of a limit of distance

/// Two ways of a round, in turn, as what one does not mend the other may, from where that has led. A lost
/// vertex of the input is approached by the closest corner of the face closest to it, or by all three; far
/// vertices come as near as they must, or go to the input; corners of turned faces move the best first, or in
/// their order.
enum class Approach { corner_best_first, face_in_order };

Approach other(Approach a) {
  return a == Approach::face_in_order ? Approach::corner_best_first : Approach::face_in_order;
}

/// Vertices are those of the result, in memory order.
class Mending {
 public:
  Mending(const AttemptMaker& maker, Attempt& run)
      : maker_(maker),
        input_(maker.input()),
        run_(run),
        order_(run.result.memory_order.order),
        adjacency_(run.result.memory_order.adjacency),
        c_(*adjacency_),
        points_(order_.gather(vertex_points(run.mesh))),
        creases_(sorted_creases(run)),
        is_immovable_(c_.vertex_count, 0) {
    for (int v : find_junctions(c_, joined_vertices(run.mesh, order_)).vertices) is_immovable_[v] = 1;
    is_at_junction_ = is_immovable_;
    for (int v = 0; v < c_.vertex_count; ++v)
      if (is_limited(v, limited_by_boundary | limited_at_corner | limited_by_request | VertexLimit::put_back))
        is_immovable_[v] = 1;
  }

  void all_rounds() {
    constexpr double many = .1, too_many = 3000;  // per vertex, and in all: hardly ever all removed
    const bool tries_hard = !run_.is_interrupted() &&
                            static_cast<double>(run_.flaws()) <= std::min(many * c_.vertex_count, too_many);
    const int max_series = tries_hard ? 3 : 1;
    for (int series = 0; series < max_series && run_.flaws() > 0; ++series)
      if (!remove_flaws(tries_hard ? 2 : 1)) break;
    while (!run_.is_interrupted() && run_.flaws() == 0 && run_.chords() > 0 && remove_chords()) continue;
    if (is_stopped_) run_.result.reason = StopReason::interrupted;
  }

  void take_back_slivers() {
    constexpr int max_sweeps = 10;
    const Mat3X input = order_.gather(maker_.as_written(vertex_points(maker_.mesh())));
    Mat3X moved = points_;
    for (int sweep = 0; sweep < max_sweeps && !is_stopped_; ++sweep) {
      const std::vector<int> corners = corners_of_new_slivers(input, moved);
      bool moves = false;
      for (int v : corners) moves = take_back(v, input, moved) || moves;
      if (!moves) break;
      is_stopped_ = maker_.is_stopped();
    }
    if (is_stopped_) run_.result.reason = StopReason::interrupted;
    if (moved == points_) return;
    const Attempt before = run_;
    place(moved);
    if (run_.flaws() > before.flaws() || run_.lost_angle > before.lost_angle ||
        run_.chords() > before.chords() ||
        maker_.has_worse_polygons(run_) > maker_.has_worse_polygons(before))
      run_ = before;
  }

 private:
  /// Of faces with small angles that are clearly less than those in the input; ascending.
  std::vector<int> corners_of_new_slivers(const Mat3X& input, const Mat3X& points) const {
    constexpr double clearly_less = .5;
    std::vector<int> corners;
    for (const Triangle& t : c_.faces) {
      const double angle = min_angle(points, {t});
      if (angle < sliver_angle && angle < min_angle(input, {t}) - clearly_less)
        corners.insert(corners.end(), t.begin(), t.end());
    }
    sort_unique(corners);
    return corners;
  }

  static std::ptrdiff_t count_slivers(const std::vector<Triangle>& faces, const Mat3X& points) {
    return std::ranges::count_if(faces,
                                 [&](const Triangle& t) { return min_angle(points, {t}) < sliver_angle; });
  }

  /// Moves the vertex back by as much of the way as is best for the least angle around it, if no more angles
  /// get small. Returns whether any is.
  bool take_back(int v, const Mat3X& input, Mat3X& moved) const {
    constexpr double clearly_larger = .1;
    if (is_at_junction_[v] || moved.col(v) == input.col(v)) return false;
    std::vector<Triangle> around;
    for (int f : c_.vertex_faces[v]) around.push_back(c_.faces[f]);
    const Vec3 here = moved.col(v), way = input.col(v) - here;
    const std::ptrdiff_t slivers = count_slivers(around, moved);
    double least = min_angle(moved, around) + clearly_larger;
    Vec3 best = here;
    const bool on_line = is_limited(v, limited_by_boundary | limited_by_crease | limited_at_corner);
    for (const double share : {.25, .5, .75, 1.}) {
      if (share < 1 && on_line) continue;
      const Vec3 point = share < 1 ? on_input(v, here + share * way) : Vec3(input.col(v));
      moved.col(v) = point;
      const double angle = min_angle(moved, around);
      const bool is_better = angle > least && count_slivers(around, moved) <= slivers;
      moved.col(v) = here;
      if (!is_better || score_of(v, point, moved).wrong > score_of(v, here, moved).wrong) continue;
      least = angle;
      best = point;
    }
    moved.col(v) = best;
    return best != here;
  }

  /// The points after a round, and how many flaws there are at each vertex.
  struct Round {
    Mat3X points;
    std::vector<int> flaws;
  };

  Round this_round() const { return {points_, flaws_at_vertices(run_, points_)}; }

  /// Moves in rounds until so many of them have made no fewer flaws than one before. In each region about
  /// what moves it keeps the round with the fewest flaws there. Returns whether so many fewer are left that
  /// it may be worth going on.
  bool remove_flaws(std::size_t max_in_vain) {
    const std::size_t max_rounds = run_.is_interrupted() ? 2 : 6, flaws_at_start = run_.flaws();
    std::vector<Round> rounds{this_round()};
    Attempt best = run_;
    std::size_t best_round = 0;
    for (Approach turn = next_;
         run_.flaws() > 0 && rounds.size() <= std::min(max_rounds, best_round + max_in_vain);
         turn = other(turn)) {
      if (rounds.size() == best_round + 1) next_ = other(turn);  // as this one is tried on the best round now
      if (!move(turn)) break;
      if (run_.flaws() < best.flaws()) {
        best = run_;
        best_round = rounds.size();
      }
      rounds.push_back(this_round());
    }
    run_ = best;
    points_ = rounds[best_round].points;
    if (run_.flaws() > 0 && rounds.size() > 1 && max_in_vain > 1) {
      const Mat3X joined = best_by_region(rounds);
      if (std::ranges::find(rounds, joined, &Round::points) == rounds.end()) place(joined);
      if (run_.flaws() >= best.flaws()) {
        run_ = std::move(best);
        points_ = std::move(rounds[best_round].points);
      }
    }
    constexpr double well_fewer = .9;
    return static_cast<double>(run_.flaws()) <= well_fewer * static_cast<double>(flaws_at_start);
  }

  /// Returns whether there are fewer, and nothing else is worse.
  bool remove_chords() {
    const Attempt before = run_;
    const Mat3X points = points_;
    if (move(Approach::corner_best_first) && run_.flaws() == 0 && run_.chords() < before.chords() &&
        run_.angle >= before.angle)
      return true;
    run_ = before;
    points_ = points;
    return false;
  }

  bool is_limited(int vertex, unsigned char limits) const {
    return (run_.result.vertex_limits[order_.old_vertex[vertex]] & limits) != 0;
  }

  /// One round of moves, judged. Returns whether there are any, none if the work is stopped.
  bool move(Approach approach) {
    is_stopped_ = is_stopped_ || (!run_.is_interrupted() && maker_.is_stopped());
    if (is_stopped_) return false;
    Mat3X moved = points_;
    approach_lost_vertices(approach, moved);
    join_far_samples(moved);
    move_to_input(approach, moved);
    take_back_needles(moved);
    if (moved == points_ || !moved.allFinite()) return false;
    place(moved);
    return true;
  }

  void place(const Mat3X& moved) {
    for (int v = 0; v < moved.cols(); ++v)
      if (moved.col(v) != points_.col(v)) maker_.place(v, moved.col(v), run_);
    maker_.judge(run_);
    points_ = order_.gather(vertex_points(run_.mesh));
  }

  /// Moves the vertices that are closest to lost vertices of the input towards these, as near as they must
  /// be.
  void approach_lost_vertices(Approach approach, Mat3X& moved) const {
    std::vector<FarVertex> lost = run_.preservation().lost_vertices;
    std::ranges::stable_sort(lost, std::greater(), &FarVertex::distance);
    const std::vector<int>& faces = run_.result.measures->deviation.vertices_from_reference.faces;
    for (const FarVertex& tip : lost) {
      const int face = faces[tip.vertex];
      if (face < 0) continue;
      const Vec3 x = input_.points.col(tip.vertex);
      const Triangle& t = c_.faces[face];
      Vec3 weights = Vec3::Zero();
      if (approach == Approach::corner_best_first) {
        const auto distance = [&](int v) { return (points_.col(v) - x).squaredNorm(); };
        weights[std::ranges::min_element(t, {}, distance) - t.begin()] = 1;
      } else {
        ClosestPoint closest = closest_point(x, points_.col(t[0]), points_.col(t[1]), points_.col(t[2]));
        closest.face = face;
        weights = on_face(closest, points_, c_).weights;
      }
      Vec3 way = x;
      bool may_move = true;
      constexpr double rounding = 1e-9;
      for (int k = 0; k < 3; ++k) {
        if (weights[k] < rounding) weights[k] = 0;
        if (weights[k] == 0) continue;
        way -= weights[k] * points_.col(t[k]);
        may_move = may_move && !is_immovable_[t[k]] && moved.col(t[k]) == points_.col(t[k]);
      }
      const double share = 1 - well_within * tip.limit / way.norm();
      if (!(share > 0) || !may_move) continue;
      for (int k = 0; k < 3; ++k) moved.col(t[k]) += weights[k] / weights.squaredNorm() * share * way;
    }
  }

  /// Moves the corners of faces so that the points on them come as near as they must to those of the input,
  /// where that is not far: chords of more than that are for shorter edges, or faces of the input.
  void join_far_samples(Mat3X& moved) const {
    constexpr double max_excess = 4;
    constexpr double least_weight = .2;  // of a corner that may move: it moves by 1 / weight of the way
    std::vector<FarSample> samples = run_.preservation().far_samples;
    const auto distance = [](const FarSample& s) { return (s.on_reference - s.on_result).norm(); };
    std::ranges::stable_sort(samples, std::greater(), distance);
    for (const FarSample& s : samples) {
      const Triangle& t = c_.faces[s.face];
      ClosestPoint on_result =
          closest_point(s.on_result, points_.col(t[0]), points_.col(t[1]), points_.col(t[2]));
      on_result.face = s.face;
      Vec3 weights = on_face(on_result, points_, c_).weights, way = s.on_reference;
      for (int k = 0; k < 3; ++k) {
        way -= weights[k] * moved.col(t[k]);
        if (is_immovable_[t[k]]) weights[k] = 0;
      }
      const double share = 1 - well_within * s.limit / way.norm();
      if (!(share > 0) || distance(s) > max_excess * s.limit || weights.maxCoeff() < least_weight) continue;
      for (int k = 0; k < 3; ++k) moved.col(t[k]) += weights[k] / weights.squaredNorm() * share * way;
    }
  }

  /// Moves vertices that are too far towards the closest points of the input, and the corners of faces that
  /// are turned over, chords, folded or intersecting, none on a crease, to better places.
  void move_to_input(Approach approach, Mat3X& moved) const {
    const auto may_move = [&](int v) { return !is_immovable_[v] && moved.col(v) == points_.col(v); };
    for (const FarVertex& far : run_.preservation().far_vertices) {
      if (!may_move(far.vertex)) continue;
      const Vec3 way = on_input(far.vertex, points_.col(far.vertex)) - points_.col(far.vertex);
      const double share =
          approach == Approach::corner_best_first ? 1 - well_within * far.limit / way.norm() : 1;
      if (share > 0) moved.col(far.vertex) += share * way;
    }
    const std::vector<int> corners = corners_of_turned_faces();
    std::vector<Place> places(corners.size());
    parallel_for(corners.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) places[i] = best_place(corners[i], points_);
    });
    if (approach == Approach::corner_best_first)
      std::ranges::stable_sort(
          places, [](const Place& a, const Place& b) { return a.score.is_better_than(b.score); });
    for (const Place& place : places)
      if (!is_limited(place.vertex, limited_by_crease) && may_move(place.vertex))
        moved.col(place.vertex) = best_place(place.vertex, moved).point;
    for (int v : corners_of_crossing_faces())
      if (!is_limited(v, limited_by_crease) && may_move(v))
        moved.col(v) = on_input(v, middle_of_neighbours(v, points_));
  }

  /// Or of chords, if there are some to be removed, and the ends of folds, if there are more than in the
  /// input. Ascending.
  std::vector<int> corners_of_turned_faces() const {
    const Deviation& deviation = run_.result.measures->deviation;
    const std::vector<int>& turned = run_.chords() > 0 ? deviation.opposing_faces : deviation.flipped_faces;
    std::vector<int> corners;
    for (std::size_t f = 0; f < c_.faces.size(); ++f)
      if (std::ranges::binary_search(turned, order_.old_face[f]))
        corners.insert(corners.end(), c_.faces[f].begin(), c_.faces[f].end());
    if (run_.preservation().new_folds > 0)
      for (const Edge& e : folds_off_creases(run_, points_))
        corners.insert(corners.end(), e.begin(), e.end());
    sort_unique(corners);
    return corners;
  }

  /// Ascending.
  std::vector<int> corners_of_crossing_faces() const {
    std::vector<int> corners;
    for (const auto& pair : run_.preservation().crossings)
      for (int f : pair) corners.insert(corners.end(), c_.faces[f].begin(), c_.faces[f].end());
    sort_unique(corners);
    return corners;
  }

  Vec3 on_input(int v, const Vec3& x) const { return maker_.closest_on_input(v, x, run_).point; }

  Vec3 middle_of_neighbours(int v, const Mat3X& points) const {
    Vec3 sum = Vec3::Zero();
    for (int n : c_.vertex_neighbours[v]) sum += points.col(n);
    return sum / std::ssize(c_.vertex_neighbours[v]);
  }

  /// Of the faces around a vertex.
  struct Score {
    int wrong = 0;  // how many oppose the input, and how many of their edges fold off creases
    double cotangent = -std::numeric_limits<double>::infinity();  // of their least angle

    bool is_better_than(const Score& other) const {
      return std::pair(wrong, cotangent) < std::pair(other.wrong, other.cotangent);
    }
  };

  struct Place {
    int vertex = -1;
    Vec3 point = Vec3::Zero();
    Score score;
  };

  /// The best place of a vertex: its own if nothing is wrong there, else of that and, on the input, of those
  /// at its own, at the middle of its neighbours, and on the way to each of them.
  Place best_place(int v, const Mat3X& points) const {
    const Vec3 here = points.col(v);
    Place best{v, here, score_of(v, here, points)};
    if (best.score.wrong == 0) return best;
    const auto try_place = [&](const Vec3& x) {
      const Vec3 point = on_input(v, x);
      const Score score = score_of(v, point, points);
      if (score.is_better_than(best.score)) best = {v, point, score};
    };
    try_place(here);
    try_place(middle_of_neighbours(v, points));
    for (int n : c_.vertex_neighbours[v])
      for (const double share : {.15, .3, .5, .7}) try_place(here + share * (points.col(n) - here));
    return best;
  }

  bool is_crease(int edge) const {
    Edge ends = c_.edges[edge];
    std::ranges::sort(ends);
    return std::ranges::binary_search(creases_, ends);
  }

  /// With the vertex at x.
  Score score_of(int v, const Vec3& x, const Mat3X& points) const {
    const auto corners_of = [&](int f) {
      std::array<Vec3, 3> p;
      for (int k = 0; k < 3; ++k) p[k] = c_.faces[f][k] == v ? x : Vec3(points.col(c_.faces[f][k]));
      return p;
    };
    const auto normal_of = [](const std::array<Vec3, 3>& p) {
      return Vec3((p[1] - p[0]).cross(p[2] - p[0]));
    };
    Score score;
    for (int f : c_.vertex_faces[v]) {
      const std::array<Vec3, 3> p = corners_of(f);
      const Vec3 normal = normal_of(p);
      for (int e : c_.face_edges[f]) {
        const auto [left, right] = c_.edge_faces[e];
        const int other = left == f ? right : left;
        if (other < 0) continue;
        const bool at_v = c_.edges[e][0] == v || c_.edges[e][1] == v;
        if (at_v && other < f) continue;  // counted already
        score.wrong += normal_of(corners_of(other)).dot(normal) < 0 && !is_crease(e);
      }
      for (int k = 0; k < 3; ++k) {
        const double dot = (p[(k + 1) % 3] - p[k]).dot(p[(k + 2) % 3] - p[k]);
        score.cotangent = std::max(score.cotangent, dot / normal.norm());
      }
      const int closest = maker_.closest_on_input(v, (p[0] + p[1] + p[2]) / 3, run_).face;
      score.wrong += normal.dot(doubled_area_vector(input_.points, input_.adjacency.faces[closest])) <= 0;
    }
    return score;
  }

  /// Takes back what was moved at faces that would lose nearly all of their angle, as where two corners go to
  /// the same place, until there are none. With a maximum distance half of it is too much: there shorter
  /// edges do it.
  void take_back_needles(Mat3X& moved) const {
    const double kept_share = maker_.has_tolerance() ? .5 : .05;
    for (bool changed = true; changed;) {
      changed = false;
      for (const Triangle& t : c_.faces) {
        const auto has_moved = [&](int v) { return moved.col(v) != points_.col(v); };
        if (std::ranges::none_of(t, has_moved) ||
            min_angle(moved, {t}) >= kept_share * min_angle(points_, {t}))
          continue;
        for (int v : t) moved.col(v) = points_.col(v);
        changed = true;
      }
    }
  }

  /// The points, in each region those of the first round with the fewest flaws there. A region is what has
  /// moved with two rings about it.
  Mat3X best_by_region(const std::vector<Round>& rounds) const {
    const std::vector<char> is_near = near_moves(rounds);
    std::vector<char> is_seen(c_.vertex_count, 0);
    Mat3X points = points_;
    for (int first = 0; first < c_.vertex_count; ++first) {
      if (!is_near[first] || is_seen[first]) continue;
      std::vector<int> region{first};
      is_seen[first] = 1;
      for (std::size_t i = 0; i < region.size(); ++i)
        for (int n : c_.vertex_neighbours[region[i]]) {
          if (!is_near[n] || is_seen[n]) continue;
          is_seen[n] = 1;
          region.push_back(n);
        }
      const auto flaws = [&](const Round& r) {
        int sum = 0;
        for (int v : region) sum += r.flaws[v];
        return sum;
      };
      const Mat3X& best = std::ranges::min_element(rounds, {}, flaws)->points;
      for (int v : region) points.col(v) = best.col(v);
    }
    return points;
  }

  /// Per vertex: has it, or one no more than two rings away, moved in any round?
  std::vector<char> near_moves(const std::vector<Round>& rounds) const {
    std::vector<char> is_near(c_.vertex_count, 0);
    for (int v = 0; v < c_.vertex_count; ++v)
      is_near[v] = std::ranges::any_of(
          rounds, [&](const Round& r) { return r.points.col(v) != rounds[0].points.col(v); });
    for (int ring = 0; ring < 2; ++ring) {
      const std::vector<char> inner = is_near;
      for (int v = 0; v < c_.vertex_count; ++v)
        if (inner[v])
          for (int n : c_.vertex_neighbours[v]) is_near[n] = 1;
    }
    return is_near;
  }

  const AttemptMaker& maker_;
  const MeasuredSurface& input_;
  Attempt& run_;
  const Permutation order_;
  const std::shared_ptr<const Adjacency> adjacency_;
  const Adjacency& c_;
  Mat3X points_;
  const std::vector<Edge> creases_;  // see sorted_creases()
  std::vector<char> is_immovable_, is_at_junction_;
  Approach next_ = Approach::corner_best_first;
  bool is_stopped_ = false;
};

}  // namespace

void mend(const AttemptMaker& maker, Attempt& run) {
  const bool is_finite = run.result.measures != nullptr;
  if (is_finite && run.flaws() + run.chords() > 0) Mending(maker, run).all_rounds();
}

void take_back_slivers(const AttemptMaker& maker, Attempt& run) {
  if (run.result.measures && maker.options.connectivity == ConnectivityMode::fixed)
    Mending(maker, run).take_back_slivers();
}

}  // namespace hooke
