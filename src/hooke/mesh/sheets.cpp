#include "hooke/mesh/sheets.h"
#include "hooke/core/lists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace hooke {
namespace {

// A side of a face: 3 face + k is the side from its corner k to the next.
using Side = int;

int face_of(Side side) {
  return side / 3;
}
size_t next_corner(Side side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

// The sides of all faces, grouped by their edges.
struct EdgeGroups {
  std::vector<Side> sides;    // group by group, by their edges; ascending in a group
  std::vector<size_t> first;  // of each group in `sides`; one more at the end

  explicit EdgeGroups(const std::vector<Triangle>& triangles) {
    using Key = std::tuple<int, int, Side>;
    std::vector<Key> keys;
    keys.reserve(3 * triangles.size());
    for (size_t f = 0; f < triangles.size(); ++f)
      for (size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(triangles[f][k], triangles[f][(k + 1) % 3]);
        keys.emplace_back(low, high, static_cast<Side>(3 * f + k));
      }
    std::ranges::sort(keys);
    for (size_t i = 0; i < keys.size(); ++i) {
      const auto edge = [&](size_t at) { return std::pair(std::get<0>(keys[at]), std::get<1>(keys[at])); };
      if (i == 0 || edge(i) != edge(i - 1)) first.push_back(i);
      sides.push_back(std::get<2>(keys[i]));
    }
    first.push_back(keys.size());
  }

  size_t count() const { return first.size() - 1; }
  std::vector<Side> operator[](size_t group) const {
    return {sides.begin() + static_cast<std::ptrdiff_t>(first[group]),
            sides.begin() + static_cast<std::ptrdiff_t>(first[group + 1])};
  }
};

// Sets of faces that hang together; in each, which faces are turned against its first.
class TurnedSets {
 public:
  explicit TurnedSets(size_t count) : parent_(count), turned_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::pair<int, bool> root(int face) {  // and whether the face is turned against it
    int top = face;
    bool turned = false;
    while (parent_[top] != top) {
      turned ^= turned_[top] != 0;
      top = parent_[top];
    }
    for (bool rest = turned; parent_[face] != top && face != top;) {  // shortens the way
      const int up = parent_[face];
      const bool own = turned_[face] != 0;
      parent_[face] = top;
      turned_[face] = rest ? 1 : 0;
      rest ^= own;
      face = up;
    }
    return {top, turned};
  }

  /// Joins the sets of two faces that are turned against each other or not. False if that contradicts what is
  /// known.
  bool join(int a, int b, bool against) {
    const auto [root_a, turned_a] = root(a);
    const auto [root_b, turned_b] = root(b);
    const bool turned = turned_a ^ turned_b ^ against;
    if (root_a == root_b) return !turned;
    parent_[root_b] = root_a;
    turned_[root_b] = turned ? 1 : 0;
    return true;
  }

  /// Whether each face is to be flipped: the fewer of each set.
  std::vector<char> minorities() {
    std::vector<std::array<int, 2>> counts(parent_.size());
    for (int f = 0; f < static_cast<int>(parent_.size()); ++f) {
      const auto [top, turned] = root(f);
      ++counts[top][turned ? 1 : 0];
    }
    std::vector<char> flips(parent_.size());
    for (int f = 0; f < static_cast<int>(parent_.size()); ++f) {
      const auto [top, turned] = root(f);
      const bool most_are_turned = counts[top][1] > counts[top][0];
      flips[f] = turned != most_are_turned;
    }
    return flips;
  }

 private:
  std::vector<int> parent_;
  std::vector<char> turned_;  // against the parent
};

class SheetMaker {
 public:
  SheetMaker(const Mat3X& points, const std::vector<Triangle>& triangles, ManyFaces many_faces)
      : points_(points),
        old_(triangles),
        many_faces_(many_faces),
        sets_(triangles.size()),
        partner_(3 * triangles.size(), -1),
        flips_(triangles.size(), 0) {}

  Sheets make() {
    const EdgeGroups groups(old_);
    for (size_t g = 0; g < groups.count(); ++g)
      if (const std::vector<Side> sides = groups[g]; sides.size() == 2) pair_two(sides[0], sides[1]);
    flips_ = sets_.minorities();
    for (size_t g = 0; g < groups.count(); ++g)
      if (const std::vector<Side> sides = groups[g]; sides.size() > 2) pair_many(sides);
    flips_ = sets_.minorities();
    split_vertices();
    for (int round = 0; round < 100 && cut_what_still_meets(); ++round) split_vertices();
    finish();
    return std::move(result_);
  }

 private:
  int start_of(Side side) const { return old_[face_of(side)][side % 3]; }
  int end_of(Side side) const { return old_[face_of(side)][(side % 3 + 1) % 3]; }
  Edge edge_of(Side side) const {
    return {std::min(start_of(side), end_of(side)), std::max(start_of(side), end_of(side))};
  }
  bool runs_up(Side side) const { return start_of(side) < end_of(side); }  // as in the input
  bool runs_up_flipped(Side side) const { return runs_up(side) != (flips_[face_of(side)] != 0); }

  void pair(Side a, Side b) {
    partner_[a] = b;
    partner_[b] = a;
  }
  void cut(Side side) {
    if (const Side other = std::exchange(partner_[side], -1); other >= 0) partner_[other] = -1;
  }

  void pair_two(Side a, Side b) {
    if (sets_.join(face_of(a), face_of(b), runs_up(a) == runs_up(b)))
      pair(a, b);
    else
      result_.opened_edges.push_back(edge_of(a));
  }

  void pair_many(std::vector<Side> sides) {
    result_.cut_edges.push_back(edge_of(sides.front()));
    constexpr size_t most_faces = 200;  // beyond that all are cut apart: pairs are found in quadratic time
    if (many_faces_ == ManyFaces::apart || sides.size() > most_faces) {
      result_.guessed_edges.push_back(edge_of(sides.front()));
      return;
    }
    std::vector<std::pair<double, Side>> around;
    around.reserve(sides.size());
    for (const Side side : sides) around.emplace_back(angle_at_edge(side), side);
    // Of two faces in one place the one that looks to larger angles comes first: solids touch there.
    std::ranges::sort(around, {}, [this](const std::pair<double, Side>& at) {
      return std::tuple(at.first, !runs_up_flipped(at.second), at.second);
    });
    if (alternates(around)) {
      pair_around_solids(around);
    } else {
      result_.guessed_edges.push_back(edge_of(sides.front()));
      pair_best_continuations(around);
    }
  }

  // The angle of the face about its edge, counter-clockwise as seen from the edge's upper end.
  double angle_at_edge(Side side) const {
    const auto [low, high] = edge_of(side);
    const Vec3 axis = (points_.col(high) - points_.col(low)).stableNormalized();
    Eigen::Index thin = 0;
    axis.cwiseAbs().minCoeff(&thin);
    const Vec3 u = axis.cross(Vec3::Unit(thin)).stableNormalized(), v = axis.cross(u);
    const int opposite = old_[face_of(side)][(side % 3 + 2) % 3];
    const Vec3 out = (points_.col(opposite) - points_.col(low)).stableNormalized();
    return std::atan2(out.dot(v), out.dot(u));
  }

  bool alternates(const std::vector<std::pair<double, Side>>& around) const {
    const size_t n = around.size();
    if (n % 2 != 0) return false;
    for (size_t i = 0; i < n; ++i)
      if (runs_up_flipped(around[i].second) == runs_up_flipped(around[(i + 1) % n].second)) return false;
    return true;
  }

  bool try_pair(Side a, Side b) {
    const bool joined = sets_.join(face_of(a), face_of(b), runs_up(a) == runs_up(b));
    if (joined) pair(a, b);
    return joined;
  }

  // The outside of a face that runs up lies at larger angles: its solid lies between it and the face before.
  void pair_around_solids(const std::vector<std::pair<double, Side>>& around) {
    const size_t n = around.size();
    for (size_t i = 0; i < n; ++i)
      if (runs_up_flipped(around[i].second)) try_pair(around[i].second, around[(i + n - 1) % n].second);
  }

  void pair_best_continuations(const std::vector<std::pair<double, Side>>& around) {
    struct Candidate {
      bool against;  // the faces are oriented against each other
      double bend;   // 0: flat
      Side a, b;
      auto key() const { return std::tie(against, bend, a, b); }
    };
    std::vector<Candidate> candidates;
    for (size_t i = 0; i < around.size(); ++i)
      for (size_t j = i + 1; j < around.size(); ++j) {
        const auto [angle_a, a] = around[i];
        const auto [angle_b, b] = around[j];
        candidates.push_back({runs_up_flipped(a) == runs_up_flipped(b),
                              std::abs(std::numbers::pi - std::abs(angle_b - angle_a)), a, b});
      }
    std::ranges::sort(candidates, [](const Candidate& x, const Candidate& y) { return x.key() < y.key(); });
    for (const Candidate& c : candidates)
      if (partner_[c.a] < 0 && partner_[c.b] < 0) try_pair(c.a, c.b);
  }

  // Numbers the fans of neighbours around each vertex: the first keeps the vertex, others get new ones.
  void split_vertices() {
    std::vector<int> fan(partner_.size());  // of each corner: the first corner of its fan
    std::iota(fan.begin(), fan.end(), 0);
    const auto root = [&](int corner) {
      while (fan[corner] != corner) corner = fan[corner] = fan[fan[corner]];
      return corner;
    };
    const auto join = [&](int a, int b) {
      const int x = root(a), y = root(b);
      fan[std::max(x, y)] = std::min(x, y);
    };
    for (Side side = 0; side < static_cast<Side>(partner_.size()); ++side) {
      const Side other = partner_[side];
      if (other < side) continue;
      const int end = static_cast<int>(next_corner(side)), other_end = static_cast<int>(next_corner(other));
      const bool same_way = start_of(side) == start_of(other);
      join(side, same_way ? other : other_end);
      join(end, same_way ? other_end : other);
    }
    const size_t vertices = points_.cols();
    std::vector<char> taken(vertices, 0);
    std::vector<int> vertex_of_fan(partner_.size(), -1);
    result_.source.resize(vertices);
    std::iota(result_.source.begin(), result_.source.end(), 0);
    result_.triangles = old_;
    for (int corner = 0; corner < static_cast<int>(partner_.size()); ++corner) {
      int& v = result_.triangles[corner / 3][corner % 3];
      int& own = vertex_of_fan[root(corner)];
      if (own < 0) {
        own = taken[v] ? static_cast<int>(result_.source.size()) : v;
        if (taken[v]) result_.source.push_back(v);
        taken[v] = 1;
      }
      v = own;
    }
  }

  // Fans may meet at an edge a second time, as their vertices are the same at both ends: cuts there. Returns
  // whether there was such an edge.
  bool cut_what_still_meets() {
    const EdgeGroups groups(result_.triangles);
    bool found = false;
    for (size_t g = 0; g < groups.count(); ++g) {
      const std::vector<Side> sides = groups[g];
      if (sides.size() < 2 || (sides.size() == 2 && partner_[sides[0]] == sides[1])) continue;
      const bool all_cut = std::ranges::all_of(sides, [&](Side side) { return partner_[side] < 0; });
      if (sides.size() == 2 && all_cut && runs_up_flipped(sides[0]) != runs_up_flipped(sides[1])) {
        pair(sides[0], sides[1]);  // neighbours after all
        continue;
      }
      found = true;
      for (const Side side : sides) cut(side);
      for (size_t i = 1; all_cut && i < sides.size(); ++i)
        for (Side k = 0; k < 3; ++k) cut(3 * face_of(sides[i]) + k);
    }
    return found;
  }

  void finish() {
    for (size_t f = 0; f < flips_.size(); ++f) {
      if (!flips_[f]) continue;
      std::swap(result_.triangles[f][1], result_.triangles[f][2]);
      result_.flipped_faces.push_back(static_cast<int>(f));
    }
    std::vector<char> at_cut(points_.cols(), 0);
    for (const auto* edges : {&result_.cut_edges, &result_.opened_edges})
      for (const Edge& edge : *edges)
        for (const int v : edge) at_cut[v] = 1;
    std::vector<int>& split = result_.split_vertices;
    for (size_t v = at_cut.size(); v < result_.source.size(); ++v)
      if (!at_cut[result_.source[v]]) split.push_back(result_.source[v]);
    sort_unique(split);
  }

  const Mat3X& points_;
  const std::vector<Triangle>& old_;
  const ManyFaces many_faces_;
  TurnedSets sets_;
  std::vector<Side> partner_;  // the neighbour's side at each side; -1 at boundaries
  std::vector<char> flips_;    // of each face
  Sheets result_;
};

}  // namespace

Sheets make_sheets(const Mat3X& points, const std::vector<Triangle>& triangles, ManyFaces many_faces) {
  return SheetMaker(points, triangles, many_faces).make();
}

}  // namespace hooke
