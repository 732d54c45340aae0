#include "hooke/mesh/image_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace hooke {
namespace {

constexpr double tolerance = .01;  // of a cell: files have few digits
constexpr double min_share_on_planes = .99;

/// The planes of a grid across one axis, at even distances.
struct GridPlanes {
  double origin = 0, spacing = 0;

  /// How many planes x is beyond the origin, with a fraction between two.
  double number_of(double x) const { return (x - origin) / spacing; }

  bool has_one_at(double x) const {
    const double number = number_of(x);
    return std::abs(number - std::round(number)) <= tolerance;
  }
};

using Grid = std::array<GridPlanes, 3>;

std::pair<double, double> extent(const Mat3X& points, const Triangle& t, Eigen::Index axis) {
  return std::minmax({points(axis, t[0]), points(axis, t[1]), points(axis, t[2])});
}

/// The planes across the axis if the faces lie in cells between them: then the widest reach across a cell.
std::optional<GridPlanes> planes_across(Eigen::Index axis, const Mat3X& points, const Adjacency& c) {
  constexpr double width_tolerance = .003;  // smaller, as the first and the last plane make the spacing
  std::vector<double> widths;
  widths.reserve(c.faces.size());
  for (const Triangle& t : c.faces) {
    const auto [low, high] = extent(points, t, axis);
    widths.push_back(high - low);
  }
  const auto at =
      widths.begin() + static_cast<std::ptrdiff_t>(min_share_on_planes * static_cast<double>(widths.size()));
  std::ranges::nth_element(widths, at);
  const double widest = *at;  // but for a few faces of something else
  if (!(widest > 0)) return std::nullopt;
  std::vector<double> planes;  // one for each face that reaches across
  double sum = 0;
  for (const Triangle& t : c.faces) {
    const auto [low, high] = extent(points, t, axis);
    if (std::abs(high - low - widest) > width_tolerance * widest) continue;
    planes.push_back(low);
    sum += high - low;
  }
  const double width = sum / static_cast<double>(planes.size());
  std::ranges::sort(planes);
  double cells = 0;  // counted from plane to plane, so that the error of the width does not add up
  for (std::size_t i = 1; i < planes.size(); ++i) cells += std::round((planes[i] - planes[i - 1]) / width);
  return GridPlanes{planes.front(), cells > 0 ? (planes.back() - planes.front()) / cells : width};
}

/// Are nearly all vertices on edges of cells, and many between the ends of these, along two axes and more?
bool are_vertices_on(const Grid& grid, const Mat3X& points, const Adjacency& c) {
  constexpr double many = .02;
  double on_edges = 0, vertices = 0;
  std::array<double, 3> between{};
  for (int v = 0; v < c.vertex_count; ++v) {
    if (c.vertex_edges[v].empty()) continue;
    ++vertices;
    std::array<bool, 3> is_between{};
    for (Eigen::Index axis = 0; axis < 3; ++axis) is_between[axis] = !grid[axis].has_one_at(points(axis, v));
    if (std::ranges::count(is_between, true) > 1) continue;
    ++on_edges;
    for (std::size_t axis = 0; axis < 3; ++axis) between[axis] += is_between[axis];
  }
  return on_edges >= min_share_on_planes * vertices &&
         std::ranges::count_if(between, [&](double count) { return count >= many * vertices; }) >= 2;
}

/// Are nearly all faces in one cell each, and few in the same?
bool are_faces_in_cells_of(const Grid& grid, const Mat3X& points, const Adjacency& c) {
  constexpr double few = 4;  // in the mean
  std::vector<std::array<double, 3>> cells;
  for (const Triangle& t : c.faces) {
    std::array<double, 3> cell{};
    bool is_in_one = true;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto [low, high] = extent(points, t, axis);
      cell[axis] = std::floor(grid[axis].number_of(low) + tolerance);
      is_in_one = is_in_one && grid[axis].number_of(high) <= cell[axis] + 1 + tolerance;
    }
    if (is_in_one) cells.push_back(cell);
  }
  const auto faces = static_cast<double>(c.faces.size());
  if (static_cast<double>(cells.size()) < min_share_on_planes * faces) return false;
  std::ranges::sort(cells);
  const auto distinct = std::unique(cells.begin(), cells.end()) - cells.begin();
  return faces <= few * static_cast<double>(distinct);
}

/// Is the target length in the mean not much longer than the edges? Else a cell is less than the length.
bool resolves_cells(const Mat3X& points, const Adjacency& c, const std::vector<double>& vertex_length) {
  constexpr double longest = 1.25;  // mean edges
  double length = 0, target = 0;
  for (const auto& [a, b] : c.edges) {
    length += (points.col(a) - points.col(b)).norm();
    target += .5 * (vertex_length[a] + vertex_length[b]);
  }
  return target <= longest * length;
}

}  // namespace

bool is_isosurface(const Mat3X& points, const Adjacency& c, const std::vector<double>& vertex_length) {
  constexpr std::size_t min_faces = 200;
  if (c.faces.size() < min_faces || !resolves_cells(points, c, vertex_length)) return false;
  Grid grid;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::optional<GridPlanes> planes = planes_across(axis, points, c);
    if (!planes) return false;
    grid[axis] = *planes;
  }
  return are_vertices_on(grid, points, c) && are_faces_in_cells_of(grid, points, c);
}

}  // namespace hooke
