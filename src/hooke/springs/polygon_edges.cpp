#include "hooke/springs/polygon_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "hooke/core/error.h"

namespace hooke {
namespace {

constexpr int most_corners = 6;

/// Area of an equilateral triangle with sides of length 1.
const double triangle_area = std::sqrt(3.) / 4;

/// Rest area of a polygon with n sides of length 1.
double rest_area(int n) {
  return n > most_corners ? (n - 2) * triangle_area : n / (4 * std::tan(std::numbers::pi / n));
}

/// Per triangle of the polygons, the index of its polygon.
std::vector<int> polygons_of_triangles(const IntLists& polygons) {
  std::vector<int> polygon;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p)
    polygon.insert(polygon.end(), polygons[p].size() - 2, p);
  return polygon;
}

/// Length of the diagonal between two corners of a regular polygon with these ids and sides of length 1.
double diagonal(std::span<const int> corners, int from, int to) {
  const auto place = [&](int id) { return std::ranges::find(corners, id) - corners.begin(); };
  const double angle = std::numbers::pi / static_cast<double>(corners.size());
  return std::sin(static_cast<double>(std::abs(place(to) - place(from))) * angle) / std::sin(angle);
}

}  // namespace

std::vector<double> rest_ratios(const IntLists& polygons, const MemoryOrder& memory_order) {
  const Adjacency& c = *memory_order.adjacency;
  const std::vector<int> polygon = polygons_of_triangles(polygons);
  if (polygon.size() != c.faces.size()) throw Error("polygons that are not the faces of the mesh");
  double rest = 0;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p)
    rest += rest_area(static_cast<int>(polygons[p].size()));
  const double q = std::sqrt(triangle_area * static_cast<double>(c.faces.size()) / rest);
  std::vector<double> ratios(c.edges.size(), q);
  for (std::size_t e = 0; e < ratios.size(); ++e) {
    const auto [left, right] = c.edge_faces[e];
    if (right < 0) continue;
    const int p = polygon[memory_order.order.old_face[left]];
    if (p != polygon[memory_order.order.old_face[right]] || std::ssize(polygons[p]) > most_corners) continue;
    const auto [v, w] = c.edges[e];
    ratios[e] = q * diagonal(polygons[p], memory_order.order.old_vertex[v], memory_order.order.old_vertex[w]);
  }
  return ratios;
}

}  // namespace hooke
