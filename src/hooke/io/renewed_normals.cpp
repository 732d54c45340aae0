#include "hooke/io/renewed_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

constexpr std::size_t elements_per_task = 1024;
constexpr double degree = std::numbers::pi / 180;

int polygon_count(const MovedPolygons& moved) {
  return static_cast<int>(moved.polygons.first.size()) - 1;
}

Vec3 unit_normal(const Vec3& v) {
  const double length = v.norm();
  return length > 0 && std::isfinite(length) ? Vec3(v / length) : Vec3(Vec3::Zero());
}

// Which polygons have a vertex that moved.
std::vector<char> touched_polygons(const MovedPolygons& moved) {
  std::vector<char> touched(polygon_count(moved), 0);
  parallel_for(touched.size(), elements_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      touched[f] = std::ranges::any_of(moved.polygons[static_cast<int>(f)],
                                       [&](int v) { return moved.before.col(v) != moved.after.col(v); });
  });
  return touched;
}

// The length of the first edge that has one; 1 if none has.
double some_length(const MovedPolygons& moved) {
  for (int f = 0; f < polygon_count(moved); ++f) {
    const std::span<const int> corners = moved.polygons[f];
    const double length = (moved.after.col(corners[0]) - moved.after.col(corners[1])).norm();
    if (length > 0) return length;
  }
  return 1;
}

// The normal of a corner of a polygon, times its weight (edge lengths in units of `scale`); of a concave
// corner too it points to the polygon's side.
Vec3 weighted_normal(const Mat3X& points, std::span<const int> corners, std::size_t k, double scale) {
  const std::size_t n = corners.size();
  const Vec3 p = points.col(corners[k]);
  const Vec3 a = points.col(corners[k + 1 < n ? k + 1 : 0]) - p;
  const Vec3 b = points.col(corners[k > 0 ? k - 1 : n - 1]) - p;
  const double a_length = a.norm(), b_length = b.norm();
  if (!(a_length > 0) || !(b_length > 0)) return Vec3::Zero();
  const Vec3 normal = (a / a_length).cross(b / b_length) * ((scale / a_length) * (scale / b_length));
  return n > 3 && normal.dot(newell_normal(points, corners)) < 0 ? Vec3(-normal) : normal;
}

// The weighted normals of all corners.
Mat3X weighted_normals(const MovedPolygons& moved) {
  const double scale = some_length(moved);
  Mat3X normals(3, static_cast<Eigen::Index>(moved.polygons.items.size()));
  parallel_for(polygon_count(moved), elements_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::span<const int> corners = moved.polygons[static_cast<int>(f)];
      for (std::size_t k = 0; k < corners.size(); ++k)
        normals.col(moved.polygons.first[f] + static_cast<int>(k)) =
            weighted_normal(moved.after, corners, k, scale);
    }
  });
  return normals;
}

// The smooth fans: the fan of every corner, -1 for a corner without normal. The first fan of a vertex has its
// id.
struct Fans {
  std::vector<int> of_corners;
  int count = 0;
};

bool same_fan(const Mat3X& values, int a, int b) {
  if (a == b) return true;
  const Vec3 x = values.col(a), y = values.col(b);
  return x == y || (x.dot(y) > 0 && x.cross(y).norm() < std::sin(.5 * degree) * x.norm() * y.norm());
}

Fans find_fans(const MovedPolygons& moved, const std::vector<int>& elements, const Mat3X& values) {
  const std::vector<int>& vertices = moved.polygons.items;
  Fans fans{vertices, static_cast<int>(moved.after.cols())};
  std::vector<int> first(fans.count, -1);  // element of each vertex
  std::vector<char> has_several(first.size(), 0);
  for (std::size_t c = 0; c < vertices.size(); ++c) {
    int& element = first[vertices[c]];
    if (elements[c] < 0) fans.of_corners[c] = -1;
    if (element < 0) element = elements[c];
    has_several[vertices[c]] |= static_cast<char>(elements[c] >= 0 && elements[c] != element);
  }
  std::vector<std::pair<int, std::size_t>> corners;  // of vertices with several elements
  for (std::size_t c = 0; c < vertices.size(); ++c)
    if (has_several[vertices[c]] && elements[c] >= 0) corners.emplace_back(vertices[c], c);
  std::ranges::sort(corners);
  std::vector<std::pair<int, int>> here;  // elements and fans at a vertex
  int vertex = -1;
  for (const auto& [v, c] : corners) {
    if (v != vertex) here.clear();
    vertex = v;
    const int element = elements[c];
    auto found =
        std::ranges::find_if(here, [&](const auto& fan) { return same_fan(values, fan.first, element); });
    if (found == here.end()) found = here.insert(here.end(), {element, here.empty() ? v : fans.count++});
    fans.of_corners[c] = found->second;
  }
  return fans;
}

// Unit normals of the fans, and which of them have moved.
struct FanNormals {
  Mat3X values;
  std::vector<char> moved;
};

FanNormals fan_normals(const MovedPolygons& moved, const Fans& fans) {
  const Mat3X corners = weighted_normals(moved);
  const std::vector<char> touched = touched_polygons(moved);
  FanNormals result{Mat3X::Zero(3, fans.count), std::vector<char>(fans.count, 0)};
  for (int f = 0; f < polygon_count(moved); ++f)
    for (int c = moved.polygons.first[f]; c < moved.polygons.first[f + 1]; ++c) {
      const int fan = fans.of_corners[c];
      if (fan < 0) continue;
      result.values.col(fan) += corners.col(c);
      result.moved[fan] |= touched[f];
    }
  for (Eigen::Index fan = 0; fan < fans.count; ++fan)
    result.values.col(fan) = unit_normal(result.values.col(fan));
  return result;
}

// The mean normals of the elements: over the corners that refer to each.
RenewedNormals mean_normals(const Fans& fans, const FanNormals& normals, const std::vector<int>& elements,
                            Eigen::Index count) {
  RenewedNormals result{Mat3X::Zero(3, count), std::vector<char>(count, 0)};
  const auto for_corners = [&](const auto& use) {  // calls use(element, its index, fan)
    for (std::size_t c = 0; c < elements.size(); ++c)
      if (elements[c] >= 0) use(elements[c], elements[c], fans.of_corners[c]);
  };
  for_corners([&](int element, std::size_t e, int fan) {
    result.values.col(element) += normals.values.col(fan);
    result.renewed[e] |= normals.moved[fan];
  });
  for (Eigen::Index n = 0; n < count; ++n) {
    result.values.col(n) = unit_normal(result.values.col(n));
    result.renewed[n] &= static_cast<char>(!result.values.col(n).isZero(0));
  }
  std::vector<char> torn(result.renewed.size(), 0);
  for_corners([&](int element, std::size_t e, int fan) {
    const auto normal = normals.values.col(fan);
    const bool far = normal.dot(result.values.col(element)) < std::cos(5 * degree) && !normal.isZero(0);
    torn[e] |= static_cast<char>(far && result.renewed[e]);
  });
  result.torn = static_cast<int>(std::ranges::count(torn, 1));
  return result;
}

}  // namespace

RenewedNormals renew_corner_normals(const MovedPolygons& moved, const std::vector<int>& elements,
                                    const Mat3X& values) {
  const Fans fans = find_fans(moved, elements, values);
  return mean_normals(fans, fan_normals(moved, fans), elements, values.cols());
}

RenewedNormals renew_vertex_normals(const MovedPolygons& moved) {
  const Fans fans{moved.polygons.items, static_cast<int>(moved.after.cols())};
  FanNormals normals = fan_normals(moved, fans);
  for (Eigen::Index v = 0; v < fans.count; ++v)
    normals.moved[v] &= static_cast<char>(!normals.values.col(v).isZero(0));
  return {std::move(normals.values), std::move(normals.moved)};
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
