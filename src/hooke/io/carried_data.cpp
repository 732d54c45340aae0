#include "hooke/io/carried_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "hooke/io/renewed_normals.h"
#include "hooke/mesh/corner_differences.h"
#include "hooke/mesh/hard_edges.h"

namespace hooke {
namespace {

constexpr double at_corner = 1 - 1e-9;  // weight beyond which a place is a vertex

/// Faces as lists of corners.
IntLists as_polygons(const std::vector<Triangle>& triangles) {
  IntLists polygons{{0}, {}};
  polygons.items.reserve(3 * triangles.size());
  polygons.first.reserve(triangles.size() + 1);
  for (const Triangle& t : triangles) {
    polygons.items.insert(polygons.items.end(), t.begin(), t.end());
    polygons.first.push_back(static_cast<int>(polygons.items.size()));
  }
  return polygons;
}

std::vector<int> as_list(const std::vector<Triangle>& corners) {
  std::vector<int> list;
  list.reserve(3 * corners.size());
  for (const Triangle& t : corners) list.insert(list.end(), t.begin(), t.end());
  return list;
}

/// The value at a place, if there is one.
struct Interpolated {
  Vec3 value = Vec3::Zero();
  bool exists = false;
};

Interpolated interpolate(const CornerValues& values, const SurfacePoint& place, const Permutation& order) {
  if (place.face < 0) return {};
  const Triangle& corners = values.corners[order.old_face[place.face]];
  if (corners[0] < 0) return {};
  Interpolated result{.exists = true};
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = place.weights[static_cast<Eigen::Index>(k)];
    if (weight >= at_corner) return {values.values.col(corners[k]), true};
    result.value += weight * values.values.col(corners[k]);
  }
  return result;
}

/// Interpolates values at the wedges of the result. Wedges of a vertex share a value where `are_equal`.
template <typename AreEqual>
CornerValues interpolate(const CornerValues& values, const ChartPlaces& places, const Remeshed& meshes,
                         const AreEqual& are_equal) {
  const Adjacency& c = meshes.result.adjacency;
  const std::size_t wedges = c.wedge_count();
  std::vector<Interpolated> of_wedges(wedges);
  for (std::size_t wedge = 0; wedge < wedges; ++wedge)
    of_wedges[wedge] = interpolate(values, places.wedges[wedge], meshes.input_order.order);
  std::vector<int> shared(wedges), last(c.vertex_count, -1), earlier(wedges, -1);
  for (std::size_t wedge = 0; wedge < wedges; ++wedge) {
    const auto v = c.vertex_of_wedge(static_cast<int>(wedge));
    shared[wedge] = static_cast<int>(wedge);
    for (int other = last[v]; other >= 0; other = earlier[other])
      if (of_wedges[wedge].exists && of_wedges[other].exists &&
          are_equal(of_wedges[wedge].value, of_wedges[other].value))
        shared[wedge] = shared[other];
    earlier[wedge] = std::exchange(last[v], static_cast<int>(wedge));
  }
  CornerValues result;
  result.width = values.width;
  result.corners.resize(c.faces.size());
  std::vector<Triangle> by_id(c.faces.size());
  for (std::size_t f = 0; f < c.faces.size(); ++f)
    by_id[meshes.result_order.old_face[f]] = c.wedges_of_faces()[f];
  std::vector<int> number(wedges, -1);
  int count = 0;
  for (std::size_t f = 0; f < by_id.size(); ++f) {
    const bool has_all = std::ranges::all_of(by_id[f], [&](int wedge) { return of_wedges[wedge].exists; });
    for (std::size_t k = 0; k < 3; ++k) {
      const auto wedge = shared[by_id[f][k]];
      if (has_all && number[wedge] < 0) number[wedge] = count++;
      result.corners[f][k] = has_all ? number[wedge] : -1;
    }
  }
  result.values.resize(3, count);
  for (std::size_t wedge = 0; wedge < wedges; ++wedge)
    if (number[wedge] >= 0) result.values.col(number[wedge]) = of_wedges[wedge].value;
  return result;
}

/// The vertex of the input at a place, -1 for none.
int vertex_at(const SurfacePoint& place, const Adjacency& c) {
  for (std::size_t k = 0; place.face >= 0 && k < 3; ++k)
    if (place.weights[static_cast<Eigen::Index>(k)] >= at_corner) return c.faces[place.face][k];
  return -1;
}

/// The value at the vertex of the input of its face in the direction of x; -1 for none.
int value_towards(const CornerDifferences& values, const ChartedSurface& input, int vertex, const Vec3& x) {
  constexpr double near = .01;  // of the shortest edge there
  const Mat3X& points = input.points;
  const Adjacency& c = input.adjacency;
  double shortest = std::numeric_limits<double>::infinity();
  for (const int n : c.vertex_neighbours[vertex])
    shortest = std::min(shortest, (points.col(n) - points.col(vertex)).norm());
  const Vec3 way = (x - points.col(vertex)).stableNormalized();
  const int face = locate(points, c, points.col(vertex) + near * shortest * way, vertex).face;
  const bool is_at_vertex = std::ranges::find(c.faces[face], vertex) != c.faces[face].end();
  return is_at_vertex ? values.value_in(face, vertex) : -1;
}

/// Gives each face at a pole of the input a value of its own there.
void set_values_at_poles(const CornerValues& values, const ChartPlaces& places, const Remeshed& meshes,
                         CornerValues& result) {
  const CornerDifferences differences(meshes.input_order, values);
  const std::vector<int> poles = differences.find_poles();
  if (poles.empty()) return;
  const Adjacency& c = meshes.result.adjacency;
  const Mat3X& points = meshes.result.points;
  std::vector<Vec3> added;
  for (std::size_t f = 0; f < c.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const SurfacePoint& place = places.wedges[c.wedges_of_faces()[f][k]];
      const int pole = vertex_at(place, meshes.input.adjacency);
      int& corner = result.corners[meshes.result_order.old_face[f]][k];
      if (corner < 0 || !std::ranges::binary_search(poles, pole)) continue;
      const Triangle& t = c.faces[f];
      const Vec3 centre = (points.col(t[0]) + points.col(t[1]) + points.col(t[2])) / 3;
      const int value = value_towards(differences, meshes.input, pole, centre);
      if (value < 0) continue;
      corner = static_cast<int>(result.values.cols() + std::ssize(added));
      added.push_back(values.values.col(value));
    }
  const Eigen::Index before = result.values.cols();
  result.values.conservativeResize(3, before + std::ssize(added));
  for (std::size_t i = 0; i < added.size(); ++i)
    result.values.col(before + static_cast<Eigen::Index>(i)) = added[i];
}

CornerValues carry_texture(const CornerValues& values, const ChartPlaces& places, const Remeshed& meshes) {
  constexpr double equal = 1e-9;  // of the range
  const Vec3 tolerance = equal * (values.values.rowwise().maxCoeff() - values.values.rowwise().minCoeff());
  CornerValues result = interpolate(values, places, meshes, [&](const Vec3& a, const Vec3& b) {
    return ((a - b).cwiseAbs().array() <= tolerance.array()).all();
  });
  set_values_at_poles(values, places, meshes, result);
  return result;
}

bool are_parallel(const Vec3& a, const Vec3& b, double degrees) {
  return a.dot(b) >= std::cos(degrees * std::numbers::pi / 180) * a.norm() * b.norm();
}

/// The ids of the vertices of the result's faces, by face id.
std::vector<Triangle> faces_by_id(const Remeshed& meshes) {
  return meshes.result_order.scatter(meshes.result.adjacency.faces);
}

CornerValues carry_normals(const CornerValues& normals, const ChartPlaces& places, const Remeshed& meshes) {
  constexpr double smooth = 1;  // degrees
  CornerValues result = interpolate(normals, places, meshes,
                                    [](const Vec3& a, const Vec3& b) { return are_parallel(a, b, smooth); });
  const std::vector<Triangle> faces = faces_by_id(meshes);
  const IntLists polygons = as_polygons(faces);
  const Mat3X points = meshes.result_order.scatter(meshes.result.points),
              nowhere = Mat3X::Constant(3, points.cols(), std::numeric_limits<double>::quiet_NaN());
  if (find_hard_edges(meshes.input_order, normals).is_flat_shaded) {
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (result.corners[f][0] >= 0) result.corners[f].fill(static_cast<int>(f));
    result.values = renew_polygon_normals({polygons, nowhere, points}).values;
    return result;
  }
  RenewedNormals renewed =
      renew_corner_normals({polygons, nowhere, points}, as_list(result.corners), result.values);
  for (Eigen::Index n = 0; n < result.values.cols(); ++n)
    if (renewed.renewed[n]) result.values.col(n) = renewed.values.col(n);
  return result;
}

}  // namespace

FaceData carry_face_data(const FaceData& data, const ChartPlaces& places, const Remeshed& meshes) {
  std::vector<int> source(places.faces.size());
  for (std::size_t f = 0; f < source.size(); ++f)
    source[meshes.result_order.old_face[f]] = meshes.input_order.order.old_face[places.faces[f]];
  return gather(data, source);
}

CornerData carry_corner_data(const CornerData& data, const ChartPlaces& places, const Remeshed& meshes) {
  CornerData result;
  if (!data.texture.empty()) result.texture = carry_texture(data.texture, places, meshes);
  if (!data.normals.empty()) result.normals = carry_normals(data.normals, places, meshes);
  return result;
}

CornerValues moved_normals(const CornerValues& normals, const std::vector<Triangle>& triangles,
                           const Mat3X& before, const Mat3X& after) {
  CornerValues result = normals;
  const IntLists polygons = as_polygons(triangles);
  const RenewedNormals renewed =
      renew_corner_normals({polygons, before, after}, as_list(normals.corners), normals.values);
  for (Eigen::Index n = 0; n < result.values.cols(); ++n)
    if (renewed.renewed[n]) result.values.col(n) = renewed.values.col(n);
  return result;
}

}  // namespace hooke
