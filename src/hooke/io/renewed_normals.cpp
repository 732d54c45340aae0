#include "hooke/io/renewed_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr std::size_t elements_per_task = 1024;
constexpr double degree = std::numbers::pi / 180;

std::size_t to_index(int i) {
  return static_cast<std::size_t>(i);
}

int polygon_count(const MovedPolygons& moved) {
  return static_cast<int>(moved.polygons.first.size()) - 1;
}

Vec3 unit_normal(const Vec3& v) {
  const double length = v.norm();
  return length > 0 && std::isfinite(length) ? Vec3(v / length) : Vec3(Vec3::Zero());
}

// Newell's normal of a polygon, of unit length; zero without area.
Vec3 newell_normal(const Mat3X& points, std::span<const int> corners) {
  const Vec3 origin = points.col(corners[0]);
  double size = 0;
  for (const int v : corners) size = std::max(size, (points.col(v) - origin).cwiseAbs().maxCoeff());
  if (!(size > 0)) return Vec3::Zero();
  Vec3 sum = Vec3::Zero();
  Vec3 last = (points.col(corners.back()) - origin) / size;
  for (const int v : corners) {
    const Vec3 next = (points.col(v) - origin) / size;
    sum += last.cross(next);
    last = next;
  }
  return unit_normal(sum);
}

// Which polygons have a vertex that moved.
std::vector<char> touched_polygons(const MovedPolygons& moved) {
  std::vector<char> touched(to_index(polygon_count(moved)), 0);
  parallel_for(touched.size(), elements_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      touched[f] = std::ranges::any_of(moved.polygons[static_cast<int>(f)],
                                       [&](int v) { return moved.before.col(v) != moved.after.col(v); });
  });
  return touched;
}

// The normal of a corner of a polygon, times its weight (edge lengths in units of `scale`); of a concave
// corner too it points to the polygon's side.
Vec3 weighted_normal(const Mat3X& points, std::span<const int> corners, std::size_t k, double scale) {
  const std::size_t n = corners.size();
  const Vec3 p = points.col(corners[k]);
  const Vec3 a = points.col(corners[(k + 1) % n]) - p, b = points.col(corners[(k + n - 1) % n]) - p;
  const double a_length = a.norm(), b_length = b.norm();
  if (!(a_length > 0) || !(b_length > 0)) return Vec3::Zero();
  const Vec3 normal = (a / a_length).cross(b / b_length) * ((scale / a_length) * (scale / b_length));
  return n > 3 && normal.dot(newell_normal(points, corners)) < 0 ? Vec3(-normal) : normal;
}

bool same_fan(const Mat3X& values, int a, int b) {
  if (a == b) return true;
  const Vec3 x = values.col(a), y = values.col(b);
  return x == y || (x.dot(y) > 0 && x.cross(y).norm() < std::sin(.5 * degree) * x.norm() * y.norm());
}

// The new normal of every corner, and whether its fan has moved.
struct FanNormals {
  Mat3X of_corners;
  std::vector<char> moved;
};

// Sums the fans at a vertex, where the polygons `here` meet, and stores the result at their corners.
void add_fans(const MovedPolygons& moved, std::span<const int> here, const std::vector<char>& touched,
              const std::vector<int>& elements, const Mat3X& values, int v, FanNormals& result) {
  struct Fan {
    int element;  // of its first corner
    Vec3 sum = Vec3::Zero();
    bool moved = false;
  };
  std::vector<Fan> fans;
  std::vector<std::array<std::size_t, 2>> placed;  // a corner and its fan
  double scale = 0;
  for (const int f : here) {
    const std::span<const int> polygon = moved.polygons[f];
    const auto k = static_cast<std::size_t>(std::ranges::find(polygon, v) - polygon.begin());
    const std::size_t corner = to_index(moved.polygons.first[to_index(f)]) + k;
    const int element = elements[corner];
    if (element < 0) continue;
    const auto found =
        std::ranges::find_if(fans, [&](const Fan& fan) { return same_fan(values, fan.element, element); });
    placed.push_back({corner, static_cast<std::size_t>(found - fans.begin())});
    if (found == fans.end()) fans.push_back({element});
    if (!(scale > 0))
      scale = (moved.after.col(polygon[(k + 1) % polygon.size()]) - moved.after.col(v)).norm();
    Fan& fan = fans[placed.back()[1]];
    fan.sum += weighted_normal(moved.after, polygon, k, scale);
    fan.moved |= touched[to_index(f)] != 0;
  }
  for (const auto& [corner, fan] : placed) {
    result.of_corners.col(static_cast<Eigen::Index>(corner)) = unit_normal(fans[fan].sum);
    result.moved[corner] = fans[fan].moved;
  }
}

FanNormals fan_normals(const MovedPolygons& moved, const std::vector<int>& elements, const Mat3X& values) {
  const int vertices = static_cast<int>(moved.after.cols());
  std::vector<std::span<const int>> rows;
  for (int f = 0; f < polygon_count(moved); ++f) rows.push_back(moved.polygons[f]);
  const IntLists at_vertices = inverse(vertices, rows);
  const std::vector<char> touched = touched_polygons(moved);
  FanNormals result{Mat3X::Zero(3, static_cast<Eigen::Index>(elements.size())),
                    std::vector<char>(elements.size(), 0)};
  parallel_for(to_index(vertices), elements_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      add_fans(moved, at_vertices[static_cast<int>(v)], touched, elements, values, static_cast<int>(v),
               result);
  });
  return result;
}

// The means of the corners of each element.
RenewedNormals mean_normals(const FanNormals& fans, const std::vector<int>& elements, Eigen::Index count) {
  RenewedNormals result{Mat3X::Zero(3, count), std::vector<char>(static_cast<std::size_t>(count), 0)};
  for (std::size_t c = 0; c < elements.size(); ++c) {
    if (elements[c] < 0) continue;
    result.values.col(elements[c]) += fans.of_corners.col(static_cast<Eigen::Index>(c));
    result.renewed[to_index(elements[c])] |= fans.moved[c];
  }
  for (Eigen::Index n = 0; n < count; ++n) {
    result.values.col(n) = unit_normal(result.values.col(n));
    result.renewed[static_cast<std::size_t>(n)] &= static_cast<char>(!result.values.col(n).isZero(0));
  }
  std::vector<char> torn(result.renewed.size(), 0);
  for (std::size_t c = 0; c < elements.size(); ++c) {
    if (elements[c] < 0 || !result.renewed[to_index(elements[c])]) continue;
    const Vec3 normal = fans.of_corners.col(static_cast<Eigen::Index>(c));
    torn[to_index(elements[c])] |=
        !normal.isZero(0) && normal.dot(result.values.col(elements[c])) < std::cos(5 * degree);
  }
  result.torn = static_cast<int>(std::ranges::count(torn, 1));
  return result;
}

}  // namespace

RenewedNormals renew_corner_normals(const MovedPolygons& moved, const std::vector<int>& elements,
                                    const Mat3X& values) {
  return mean_normals(fan_normals(moved, elements, values), elements, values.cols());
}

RenewedNormals renew_vertex_normals(const MovedPolygons& moved) {
  const std::vector<int>& vertices = moved.polygons.items;
  return mean_normals(fan_normals(moved, vertices, moved.before), vertices, moved.after.cols());
}

RenewedNormals renew_polygon_normals(const MovedPolygons& moved) {
  RenewedNormals result{Mat3X::Zero(3, polygon_count(moved)), touched_polygons(moved)};
  parallel_for(result.renewed.size(), elements_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const auto column = static_cast<Eigen::Index>(f);
      result.values.col(column) = newell_normal(moved.after, moved.polygons[static_cast<int>(f)]);
      result.renewed[f] &= static_cast<char>(!result.values.col(column).isZero(0));
    }
  });
  return result;
}

}  // namespace hooke
