#include "hooke/constraints/zigzag_strips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numbers>
#include <utility>

#include "hooke/constraints/facet_creases.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"

namespace hooke {
namespace {

constexpr double coplanar_angle = 1;  // degrees; an edge between faces of one facet, below any fold
constexpr double needle_ratio = .5;   // maximum width of a needle over the length of its sides
constexpr double point_ratio = .5;    // maximum width at its point over that at its foot
constexpr double max_fold = 120;      // degrees; beyond it the surface turns back, and has no smooth strip
constexpr double fold_ratio = 2;      // maximum ratio of the angles of two folds in a row
constexpr int min_folds = 6;          // of a strip

class ZigzagStrips {
 public:
  ZigzagStrips(const Mat3X& points, const Adjacency& c, const std::vector<double>& length,
               const Mat3X& normals)
      : X_(points), c_(c), length_(length), normals_(normals) {
    find_needles();
    find_sides();
    for (size_t i = 0; i < needles_.size(); ++i) find_points(static_cast<int>(i));
    for (Side& side : sides_) find_fold(side);
    find_strips();
  }

  /// Marks the folds and sets the normals beside them.
  std::vector<char> smooth(Mat3X& normals) const {
    std::vector<char> is_fold(c_.edges.size(), 0);
    if (std::ranges::none_of(sides_, &Side::is_in_strip)) return is_fold;
    std::vector<Vec3> sums(needles_.size(), Vec3::Zero());
    for (const Side& side : sides_) {
      if (!side.is_in_strip) continue;
      for (size_t i = side.first; i < side.last; ++i) is_fold[borders_[i].edge] = 1;
      const auto& [left, right] = side.facets;
      const Vec3 sum = needles_[left].area_vector.normalized() + needles_[right].area_vector.normalized();
      sums[left] += sum;
      sums[right] += sum;
    }
    for (size_t f = 0; f < facet_of_.size(); ++f)
      if (const int needle = facet_of_[f];
          needle >= 0 && sums[needle] != Vec3::Zero() && has_normal(static_cast<int>(f)))
        normals.col(static_cast<Eigen::Index>(f)) = sums[needle].normalized();
    return is_fold;
  }

 private:
  static constexpr int none = -1;
  static constexpr int own_number(int face) { return -1 - face; }

  struct Needle {
    Vec3 area_vector;
    std::array<int, 2> sides = {none, none};  // the longest
  };

  struct Border {
    std::array<int, 2> facets;  // as in facet_of_, the smaller number first
    int edge;

    auto operator<=>(const Border&) const = default;
  };

  /// The straight line at which two facets meet, one of them a needle.
  struct Side {
    std::array<int, 2> facets;  // as in facet_of_
    size_t first, last;         // its edges, in borders_
    int longest_edge;
    std::array<int, 2> ends;                   // vertices
    std::array<int, 2> points = {none, none};  // by facet: the end at which the needle comes to its point
    double fold = 0;  // angle in degrees, positive if convex; 0 unless it joins the points of two needles
    bool is_in_strip = false;
  };

  bool has_normal(int face) const { return normals_.col(face) != Vec3::Zero(); }

  /// Is the face so narrow that it may be of a needle?
  std::vector<char> find_narrow_faces() const {
    std::vector<char> is_narrow(c_.faces.size());
    parallel_for(is_narrow.size(), 4096, [&](size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f) {
        const Triangle& t = c_.faces[f];
        double longest = 0;
        for (size_t k = 0; k < 3; ++k)
          longest = std::max(longest, (X_.col(t[k]) - X_.col(t[(k + 1) % 3])).squaredNorm());
        is_narrow[f] =
            doubled_area_vector(X_, t).norm() < needle_ratio * longest && has_normal(static_cast<int>(f));
      }
    });
    return is_narrow;
  }

  /// Numbers the facets from 0: connected faces about in one plane, as narrow as needles on the whole, with
  /// those without area at their borders. The other faces have numbers below 0, each its own.
  void find_needles() {
    const double min_cosine = std::cos(coplanar_angle * std::numbers::pi / 180);
    const std::vector<char> is_narrow = find_narrow_faces();
    facet_of_.resize(c_.faces.size());
    for (size_t f = 0; f < facet_of_.size(); ++f) facet_of_[f] = own_number(static_cast<int>(f));
    std::vector<char> seen(c_.faces.size(), 0);
    std::vector<int> members;
    for (size_t seed = 0; seed < seen.size(); ++seed) {
      if (!is_narrow[seed] || std::exchange(seen[seed], 1)) continue;
      const auto number = static_cast<int>(needles_.size());
      Needle needle{.area_vector = Vec3::Zero()};
      Eigen::AlignedBox3d box;
      members = {static_cast<int>(seed)};
      for (size_t i = 0; i < members.size(); ++i) {
        const int f = members[i];
        facet_of_[f] = number;
        needle.area_vector += .5 * doubled_area_vector(X_, c_.faces[f]);
        for (int v : c_.faces[f]) box.extend(X_.col(v));
        for (int e : c_.face_edges[f])
          for (int next : c_.edge_faces[e])
            if (next >= 0 && !seen[next] &&
                (!has_normal(next) || normals_.col(f).dot(normals_.col(next)) > min_cosine)) {
              seen[next] = 1;
              members.push_back(next);
            }
      }
      if (needle.area_vector.norm() < .5 * needle_ratio * box.diagonal().squaredNorm())
        needles_.push_back(needle);
      else
        for (int f : members) facet_of_[f] = own_number(f);
    }
  }

  /// Of each needle; each edge of the boundary is one, as if beside a facet of its own.
  void find_sides() {
    for (int e = 0; e < std::ssize(c_.edges); ++e) {
      const auto& [left, right] = c_.edge_faces[e];
      const int a = facet_of_[left],
                b = right >= 0 ? facet_of_[right] : own_number(static_cast<int>(facet_of_.size()) + e);
      if (a != b && std::max(a, b) >= 0) borders_.push_back({{std::min(a, b), std::max(a, b)}, e});
    }
    std::ranges::sort(borders_);
    for (size_t first = 0, last; first < borders_.size(); first = last) {
      last = first + 1;
      while (last < borders_.size() && borders_[last].facets == borders_[first].facets) ++last;
      const Side side = side_of(first, last);
      const auto number = static_cast<int>(sides_.size());
      const auto is_longer_than = [&](int other) {
        return other == none || length(side) > length(sides_[other]);
      };
      for (int facet : side.facets) {
        if (facet < 0) continue;
        auto& [longest, next] = needles_[facet].sides;
        if (is_longer_than(longest))
          next = std::exchange(longest, number);
        else if (is_longer_than(next))
          next = number;
      }
      sides_.push_back(side);
    }
  }

  /// The side with these edges, which are in one line.
  Side side_of(size_t first, size_t last) const {
    Side side{.facets = borders_[first].facets,
              .first = first,
              .last = last,
              .longest_edge = borders_[first].edge,
              .ends = {}};
    for (size_t i = first + 1; i < last; ++i)
      if (edge_vector(borders_[i].edge).norm() > edge_vector(side.longest_edge).norm())
        side.longest_edge = borders_[i].edge;
    const Vec3 along = edge_vector(side.longest_edge);
    side.ends = c_.edges[side.longest_edge];
    for (size_t i = first; i < last; ++i)
      for (int v : c_.edges[borders_[i].edge]) {
        if (along.dot(X_.col(v) - X_.col(side.ends[0])) < 0) side.ends[0] = v;
        if (along.dot(X_.col(v) - X_.col(side.ends[1])) > 0) side.ends[1] = v;
      }
    return side;
  }

  Vec3 edge_vector(int edge) const { return X_.col(c_.edges[edge][1]) - X_.col(c_.edges[edge][0]); }

  double length(const Side& side) const { return (X_.col(side.ends[1]) - X_.col(side.ends[0])).norm(); }

  /// Where the needle, between its two longest sides, comes to a point, unless the target length resolves it.
  void find_points(int number) {
    const auto& [first, second] = needles_[number].sides;
    if (second == none) return;
    for (const auto& [i, other] : {std::pair(first, second), std::pair(second, first)}) {
      Side& side = sides_[i];
      const Vec3 origin = X_.col(sides_[other].ends[0]);
      const Vec3 along = (X_.col(sides_[other].ends[1]) - origin).normalized();
      const auto width = [&](int end) { return along.cross(X_.col(side.ends[end]) - origin).norm(); };
      const int point = width(0) < width(1) ? 0 : 1;
      const double foot = width(1 - point);
      const auto& [a, b] = c_.edges[side.longest_edge];
      if (foot < needle_ratio * length(sides_[second]) &&
          foot < resolved_length * .5 * (length_[a] + length_[b]) && width(point) < point_ratio * foot)
        side.points[side.facets[0] == number ? 0 : 1] = point;
    }
  }

  void find_fold(Side& side) const {
    if (side.points[0] == none || side.points[1] == none || side.points[0] == side.points[1]) return;
    const int edge = side.longest_edge;  // directed as in its first face
    const Vec3& m = needles_[facet_of_[c_.edge_faces[edge][0]]].area_vector;
    const Vec3& n = needles_[facet_of_[c_.edge_faces[edge][1]]].area_vector;
    const double angle = angle_between(m, n);
    if (angle > max_fold) return;
    side.fold = m.cross(n).dot(edge_vector(edge)) > 0 ? angle : -angle;
  }

  void find_strips() {
    for (size_t seed = 0; seed < sides_.size(); ++seed) {
      if (sides_[seed].fold == 0 || sides_[seed].is_in_strip) continue;
      std::vector<int> strip = {static_cast<int>(seed)};
      sides_[seed].is_in_strip = true;
      for (size_t i = 0; i < strip.size(); ++i)
        for (int needle : sides_[strip[i]].facets)
          for (int next : needles_[needle].sides)
            if (alternate(strip[i], next) && !std::exchange(sides_[next].is_in_strip, true))
              strip.push_back(next);
      if (std::ssize(strip) < min_folds)
        for (int i : strip) sides_[i].is_in_strip = false;
    }
  }

  /// Do the sides fold in opposite ways, by about the same angle?
  bool alternate(int side, int next) const {
    const double ratio = -sides_[next].fold / sides_[side].fold;
    return ratio > 1 / fold_ratio && ratio < fold_ratio;
  }

  const Mat3X& X_;
  const Adjacency& c_;
  const std::vector<double>& length_;
  const Mat3X& normals_;
  std::vector<int> facet_of_;  // by face, see find_needles()
  std::vector<Needle> needles_;
  std::vector<Border> borders_;  // those of a side are in a row
  std::vector<Side> sides_;
};

}  // namespace

std::vector<char> smooth_zigzag_strips(const Mat3X& points, const Adjacency& c,
                                       const std::vector<double>& vertex_length, Mat3X& normals) {
  return ZigzagStrips(points, c, vertex_length, normals).smooth(normals);
}

}  // namespace hooke
