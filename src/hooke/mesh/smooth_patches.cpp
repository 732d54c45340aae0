#include "hooke/mesh/smooth_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/disjoint_sets.h"

namespace hooke {
namespace {

constexpr int many = 100;                   // patches that are connected
constexpr double little = .1;               // area, over the median of these
constexpr double little_share = .05;        // minimum share of patches that have less
constexpr double large = 20;                // area, over the median, beyond which it is a flat side
constexpr double rounded_share = .99;       // minimum share of edges that turn by no more than rounding
constexpr double straight_share = .8;       // maximum share of edges that go on straight with the same turn
constexpr std::ptrdiff_t many_levels = 24;  // that a coordinate takes, at least; parts have few heights
constexpr double max_step = .2;             // of coordinates, in mean edges; a grid has longer ones
constexpr double min_step = 1e-3;           // below which they hardly turn faces

/// Faces in one plane, connected; without faces unless the face with its number stands for it.
struct Patch {
  int faces = 0;
  double area = 0;
  bool has_sharp_edge = false;
};

/// Connected patches without sharp edges.
struct Group {
  int polygons = 0;  // of more than two faces
  std::vector<double> areas;
  /// The edges between patches: all, those that turn by no more than rounding, and those that go on straight
  /// with the same turn, as creases do and rounding seldom makes them.
  std::size_t edges = 0, rounded_edges = 0, straight_edges = 0;
  std::array<std::vector<long long>, 3> levels;  // of the vertices, where a coordinate has steps

  bool is_rounded() {
    const auto share_of_edges = [&](double share) { return share * static_cast<double>(edges); };
    return std::ssize(areas) >= many && static_cast<double>(rounded_edges) >= share_of_edges(rounded_share) &&
           static_cast<double>(straight_edges) <= share_of_edges(straight_share) &&
           std::ranges::any_of(levels, [](std::vector<long long>& of_axis) {
             std::ranges::sort(of_axis);
             return std::unique(of_axis.begin(), of_axis.end()) - of_axis.begin() >= many_levels;
           });
  }

  /// The area up to which patches are part of a smooth surface; 0 if none are.
  double max_area() {
    const bool rounded = is_rounded();
    if (polygons < many && !rounded) return 0;
    const auto middle = areas.begin() + std::ssize(areas) / 2;
    std::ranges::nth_element(areas, middle);
    const double median = *middle;
    const auto little_ones = std::ranges::count_if(areas, [&](double a) { return a < little * median; });
    const bool differ = static_cast<double>(little_ones) >= little_share * static_cast<double>(areas.size());
    return differ || rounded ? large * median : 0;
  }
};

/// The step of which all these numbers are multiples apart, 0 if there is none above `least`.
double step_of(const Eigen::RowVectorXd& numbers, double least) {
  constexpr Eigen::Index sampled = 4096;
  constexpr double tolerance = .05;  // of a step
  const double magnitude = numbers.cwiseAbs().maxCoeff();
  const double rounding = magnitude * (numbers.cast<float>().cast<double>() == numbers ? 1e-7 : 1e-15);
  std::vector<double> some;
  const Eigen::Index stride = 1 + (numbers.size() - 1) / sampled;
  for (Eigen::Index i = 0; i < numbers.size(); i += stride) some.push_back(numbers[i]);
  std::ranges::sort(some);
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < some.size(); ++i)
    if (some[i] - some[i - 1] > 2 * rounding) step = std::min(step, some[i] - some[i - 1]);
  if (!(step >= least && tolerance * step > 2 * rounding && std::isfinite(step))) return 0;
  const double first = some.front();
  for (double x : some) {  // the farther from the first one, the more exact the step
    const double steps = std::round((x - first) / step);
    if (std::abs(x - first - steps * step) > tolerance * step) return 0;
    if (steps > 0) step = (x - first) / steps;
  }
  const auto is_off = [&](double x) {
    return std::abs(x - first - std::round((x - first) / step) * step) > tolerance * step;
  };
  return std::any_of(numbers.begin(), numbers.end(), is_off) ? 0 : step;
}

/// What rounding of coordinates to multiples of a step makes of a surface.
class Rounding {
 public:
  Rounding(const Mat3X& points, const Adjacency& c) : points_(points), c_(c) {
    if (c.edges.empty()) return;
    double mean = 0;
    for (const auto& [a, b] : c.edges) mean += (points.col(a) - points.col(b)).norm();
    mean /= static_cast<double>(c.edges.size());
    for (int k = 0; k < 3; ++k) {
      const double step = step_of(points.row(k), min_step * mean);
      if (step <= max_step * mean) steps_[k] = step;
    }
  }

  bool has_steps() const { return !steps_.isZero(); }

  /// May it have turned the faces at this edge, which is none of the boundary, as much as they turn, or half
  /// of that on a curved surface?
  bool explains(int edge) const {
    constexpr double of_rounding = 2;
    double most = 0;  // radians
    for (const int f : c_.edge_faces[edge]) {
      const Vec3 area = doubled_area_vector(points_, c_.faces[f]);
      most += area.cwiseAbs().dot(steps_) * length(edge) / area.squaredNorm();  // step over height
    }
    return turn(edge) <= of_rounding * most;
  }

  /// Does another edge go on straight at an end of this one, with the same turn?
  bool is_straight(int edge) const {
    constexpr double in_line = 1 - 1e-9, same = 1e-3;
    const auto goes_on_at = [&](int v, int from) {
      const Vec3 along = (points_.col(v) - points_.col(from)).normalized();
      return std::ranges::any_of(c_.vertex_edges[v], [&](int e) {
        const Vec3 way = (points_.col(c_.other_end(e, v)) - points_.col(v)).normalized();
        return along.dot(way) > in_line && std::abs(turn(e) - turn(edge)) < same * turn(edge);
      });
    };
    const auto& [a, b] = c_.edges[edge];
    return goes_on_at(a, b) || goes_on_at(b, a);
  }

  void add_levels(int vertex, std::array<std::vector<long long>, 3>& levels) const {
    for (int k = 0; k < 3; ++k)
      if (steps_[k] > 0) levels[k].push_back(std::llround(points_(k, vertex) / steps_[k]));
  }

 private:
  double length(int edge) const {
    return (points_.col(c_.edges[edge][0]) - points_.col(c_.edges[edge][1])).norm();
  }

  /// By how much the surface turns at the edge, in radians.
  double turn(int edge) const {
    const auto& [left, right] = c_.edge_faces[edge];
    if (right < 0) return 0;
    const Vec3 n = doubled_area_vector(points_, c_.faces[left]),
               m = doubled_area_vector(points_, c_.faces[right]);
    return std::atan2(n.cross(m).norm(), n.dot(m));
  }

  const Mat3X& points_;
  const Adjacency& c_;
  Vec3 steps_ = Vec3::Zero();
};

}  // namespace

std::vector<char> faces_in_smooth_patches(const Mat3X& points, const Adjacency& c,
                                          const std::vector<char>& flat, const std::vector<char>& sharp) {
  DisjointSets patch_of(c.faces.size()), group_of(c.faces.size());
  for (std::size_t e = 0; e < flat.size(); ++e)
    if (flat[e] && !c.is_boundary_edge(static_cast<int>(e))) patch_of.join(c.edge_faces[e]);
  std::vector<Patch> patches(c.faces.size());  // by the face that stands for it
  for (std::size_t f = 0; f < patches.size(); ++f) {
    Patch& patch = patches[patch_of.root(static_cast<int>(f))];
    ++patch.faces;
    patch.area += doubled_area_vector(points, c.faces[f]).norm();
    for (int e : c.face_edges[f]) patch.has_sharp_edge = patch.has_sharp_edge || sharp[e] != 0;
  }
  const auto patch_at = [&](int face) -> const Patch& { return patches[patch_of.root(face)]; };
  for (std::size_t e = 0; e < flat.size(); ++e) {
    if (c.is_boundary_edge(static_cast<int>(e))) continue;
    const auto& [left, right] = c.edge_faces[e];
    if (!patch_at(left).has_sharp_edge && !patch_at(right).has_sharp_edge) group_of.join({left, right});
  }
  std::vector<Group> groups;
  std::vector<int> number(c.faces.size(), -1);  // of the group that the face stands for
  const auto number_of = [&](int face) -> int& { return number[group_of.root(face)]; };
  const auto group_at = [&](int face) -> Group& { return groups[number_of(face)]; };
  for (std::size_t f = 0; f < patches.size(); ++f) {
    if (patches[f].faces == 0 || patches[f].has_sharp_edge) continue;
    int& of_group = number_of(static_cast<int>(f));
    if (of_group < 0) {
      of_group = static_cast<int>(groups.size());
      groups.emplace_back();
    }
    Group& group = groups[of_group];
    group.polygons += patches[f].faces > 2;
    group.areas.push_back(patches[f].area);
  }
  const Rounding rounding(points, c);
  if (rounding.has_steps()) {
    for (int e = 0; e < std::ssize(flat); ++e) {
      if (flat[e] || c.is_boundary_edge(e)) continue;
      const auto& [left, right] = c.edge_faces[e];
      if (patch_at(left).has_sharp_edge || patch_at(right).has_sharp_edge) continue;
      Group& group = group_at(left);
      ++group.edges;
      group.rounded_edges += rounding.explains(e);
      group.straight_edges += rounding.is_straight(e);
    }
    for (int v = 0; v < c.vertex_count; ++v) {
      const auto faces = c.vertex_faces[v];
      if (!faces.empty() && !patch_at(faces[0]).has_sharp_edge)
        rounding.add_levels(v, group_at(faces[0]).levels);
    }
  }
  std::vector<double> max_areas;
  for (Group& group : groups) max_areas.push_back(group.max_area());
  std::vector<char> marks(c.faces.size(), 0);
  for (std::size_t f = 0; f < marks.size(); ++f) {
    const auto face = static_cast<int>(f);
    const Patch& patch = patch_at(face);
    marks[f] = patch.faces > 1 && !patch.has_sharp_edge && patch.area <= max_areas[number_of(face)];
  }
  return marks;
}

}  // namespace hooke
