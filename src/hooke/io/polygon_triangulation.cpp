#include "hooke/io/polygon_triangulation.h"

#include <fmt/format.h>

#include <cmath>
#include <queue>
#include <span>
#include <tuple>

namespace hooke {
namespace {

using Vec2 = Eigen::Vector2d;

// Twice the signed area of a triangle in the plane.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Shape of a triangle in the plane: 1 if equilateral, 0 without area, negative if flipped.
double shape(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return squares > 0 ? 2 * std::sqrt(3.) * turn(a, b, c) / squares : 0;
}

// Corners whose triangle has a smaller shape count as straight.
constexpr double straight = 1e-10;

// Projects the corners to the plane of the Newell normal, seen from outside and scaled to a size of about 1.
void project(const Mat3X& points, std::span<const int> corners, std::vector<Vec2>& plane) {
  const Vec3 origin = points.col(corners[0]);
  double size = 0;
  for (const int v : corners) size = std::max(size, (points.col(v) - origin).cwiseAbs().maxCoeff());
  const double scale = size > 0 ? size : 1;
  const auto local = [&](size_t k) -> Vec3 {
    return (points.col(corners[k % corners.size()]) - origin) / scale;
  };
  Vec3 normal = Vec3::Zero();
  for (size_t k = 0; k < corners.size(); ++k) normal += local(k).cross(local(k + 1));
  const Vec3 n = normal.norm() > 0 ? normal.normalized() : Vec3::UnitZ();
  const Vec3 u = n.unitOrthogonal(), w = n.cross(u);
  plane.clear();
  for (size_t k = 0; k < corners.size(); ++k) plane.emplace_back(u.dot(local(k)), w.dot(local(k)));
}

// Clips the ears of one polygon. Corners are numbered from 0 within the polygon.
class EarClipper {
 public:
  // Appends the triangles, as triples of corners, to `out`. Returns false if no valid ear was found
  // at some step or the last triangle is degenerate.
  bool clip(const std::vector<Vec2>& plane, std::vector<Triangle>& out) {
    plane_ = &plane;
    const int n = static_cast<int>(plane.size());
    start(n);
    bool clean = true;
    for (int left = n; left > 3; --left) {
      int ear = best_ear();
      if (ear < 0) {
        for (int i = 0; i < n; ++i)
          if (live_[i]) push_if_ear(i);  // the corner that blocked them may be clipped
        ear = best_ear();
      }
      clean &= ear >= 0;
      cut(ear >= 0 ? ear : best_shaped_corner(), out);
    }
    const int last = next_live(0);
    clean &= shape_at(last) > straight;
    out.push_back({previous_[last], last, next_[last]});
    return clean;
  }

 private:
  using Candidate = std::tuple<double, int, int>;  // shape, -corner (lower corners first), stamp

  const Vec2& point(int i) const { return (*plane_)[i]; }
  double shape_at(int i) const { return shape(point(previous_[i]), point(i), point(next_[i])); }

  void start(int n) {
    previous_.resize(n);
    next_.resize(n);
    live_.assign(n, true);
    stamp_.assign(n, 0);
    candidates_ = {};
    for (int i = 0; i < n; ++i) {
      previous_[i] = (i + n - 1) % n;
      next_[i] = (i + 1) % n;
    }
    blockers_.clear();
    for (int i = 0; i < n; ++i)
      if (shape_at(i) <= straight) blockers_.push_back(i);
    for (int i = 0; i < n; ++i) push_if_ear(i);
  }

  // Whether the triangle of corner i is convex and contains no other corner. Only corners that are not convex
  // need testing.
  bool is_ear(int i) const {
    if (shape_at(i) <= straight) return false;
    const Vec2 &a = point(previous_[i]), &b = point(i), &c = point(next_[i]);
    for (const int k : blockers_) {
      const Vec2& p = point(k);
      if (!live_[k] || k == previous_[i] || k == next_[i] || p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= -straight && turn(b, c, p) >= -straight && turn(c, a, p) >= -straight)
        return false;
    }
    return true;
  }

  void push_if_ear(int i) {
    ++stamp_[i];
    if (is_ear(i)) candidates_.emplace(shape_at(i), -i, stamp_[i]);
  }

  int best_ear() {
    while (!candidates_.empty()) {
      const auto [quality, corner, stamp] = candidates_.top();
      candidates_.pop();
      if (live_[-corner] && stamp == stamp_[-corner]) return -corner;
    }
    return -1;
  }

  int next_live(int i) const {
    while (!live_[i]) ++i;
    return i;
  }

  int best_shaped_corner() const {
    int best = next_live(0);
    for (int i = 0; i < static_cast<int>(live_.size()); ++i)
      if (live_[i] && shape_at(i) > shape_at(best)) best = i;
    return best;
  }

  void cut(int ear, std::vector<Triangle>& out) {
    const int before = previous_[ear], after = next_[ear];
    out.push_back({before, ear, after});
    live_[ear] = false;
    next_[before] = after;
    previous_[after] = before;
    std::erase_if(blockers_, [&](int k) { return !live_[k] || shape_at(k) > straight; });
    push_if_ear(before);
    push_if_ear(after);
  }

  const std::vector<Vec2>* plane_ = nullptr;
  std::vector<int> previous_, next_, stamp_, blockers_;
  std::vector<bool> live_;
  std::priority_queue<Candidate> candidates_;
};

// Cuts a quadrilateral along the better diagonal; of two about as good, as in grids, along that from its
// first corner, so that rounding does not cut each of them in another way. Returns false if neither lies
// inside.
bool cut_quadrilateral(const std::vector<Vec2>& p, std::vector<Triangle>& out) {
  constexpr double alike = 1 - 1e-3;  // share of the better shape
  const double first = std::min(shape(p[0], p[1], p[2]), shape(p[0], p[2], p[3]));
  const double second = std::min(shape(p[0], p[1], p[3]), shape(p[1], p[2], p[3]));
  if (first >= alike * second)
    out.insert(out.end(), {{0, 1, 2}, {0, 2, 3}});
  else
    out.insert(out.end(), {{0, 1, 3}, {1, 2, 3}});
  return std::max(first, second) > straight;
}

}  // namespace

TriangulatedPolygons triangulate(const Mat3X& points, const IntLists& polygons) {
  TriangulatedPolygons result;
  std::vector<Vec2> plane;
  std::vector<Triangle> cuts;
  EarClipper clipper;
  const int count = static_cast<int>(polygons.first.size()) - 1;
  result.triangles.reserve(polygons.items.size() / 3);
  for (int f = 0; f < count; ++f) {
    const std::span<const int> corners = polygons[f];
    cuts.clear();
    if (corners.size() == 3) {
      cuts.push_back({0, 1, 2});
    } else {
      project(points, corners, plane);
      const bool clean = corners.size() == 4 ? cut_quadrilateral(plane, cuts) : clipper.clip(plane, cuts);
      ++result.polygons_cut;
      if (!clean) ++result.not_simple;
    }
    for (const auto& [a, b, c] : cuts) {
      result.triangles.push_back({corners[a], corners[b], corners[c]});
      result.polygon.push_back(f);
    }
  }
  return result;
}

std::size_t count_concave(const Mat3X& points, const IntLists& polygons) {
  std::vector<Vec2> plane;
  std::size_t count = 0;
  for (int f = 0; f + 1 < static_cast<int>(polygons.first.size()); ++f) {
    const std::span<const int> corners = polygons[f];
    if (corners.size() < 4) continue;
    project(points, corners, plane);
    const std::size_t n = plane.size();
    for (std::size_t k = 0; k < n; ++k)
      if (shape(plane[k], plane[(k + 1) % n], plane[(k + 2) % n]) < -straight) {
        ++count;
        break;
      }
  }
  return count;
}

bool misread_as_fans(const Mat3X& points, const IntLists& polygons,
                     const TriangulatedPolygons& triangulation) {
  if (triangulation.polygons_cut == 0) return false;
  const auto twice_area = [&](int a, int b, int c) {
    const Vec3 ab = points.col(b) - points.col(a), ac = points.col(c) - points.col(a);
    return ab.cross(ac).norm();
  };
  double area = 0, of_fans = 0;
  for (const auto& [a, b, c] : triangulation.triangles) area += twice_area(a, b, c);
  for (int f = 0; f + 1 < static_cast<int>(polygons.first.size()); ++f) {
    const std::span<const int> corners = polygons[f];
    for (size_t k = 2; k < corners.size(); ++k) of_fans += twice_area(corners[0], corners[k - 1], corners[k]);
  }
  return of_fans > 1.25 * area;
}

std::vector<Triangle> items_of_triangles(const TriangulatedPolygons& triangulation, const IntLists& polygons,
                                         const std::vector<int>& of_corners) {
  std::vector<Triangle> items(triangulation.triangles.size());
  for (size_t t = 0; t < items.size(); ++t) {
    const int polygon = triangulation.polygon[t];
    const auto corners = polygons[polygon];
    for (size_t k = 0; k < 3; ++k) {
      const auto corner = std::ranges::find(corners, triangulation.triangles[t][k]) - corners.begin();
      items[t][k] = of_corners[polygons.first[polygon] + corner];
    }
  }
  return items;
}

void append_warnings(const TriangulatedPolygons& triangulation, const std::string& name,
                     ContentWarnings& content, Warnings& warnings) {
  const auto add_cut = [&](Warnings& to, const char* what) {
    to.push_back({"polygons_triangulated", fmt::format("{}: polygons with more than three corners, {}: {}",
                                                       name, what, triangulation.polygons_cut)});
  };
  if (triangulation.polygons_cut > 0) {
    add_cut(content.anew, "cut into triangles");
    add_cut(content.preserved, "measured as triangles, written as they were");
  }
  if (triangulation.not_simple > 0)
    warnings.push_back(
        {"polygons_not_simple",
         fmt::format(
             "{}: polygons that cross or fold over themselves or have no area, whose triangles overlap: {}",
             name, triangulation.not_simple)});
}

}  // namespace hooke
