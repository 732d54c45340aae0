#include "hooke/mesh/smooth_patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/disjoint_sets.h"

namespace hooke {
namespace {

constexpr int many = 100;             // patches that are connected
constexpr double little = .1;         // area, over the median of these
constexpr double little_share = .05;  // minimum share of patches that have less
constexpr double large = 20;          // area, over the median, beyond which it is a flat side
constexpr double rounded_share = .5;  // minimum share of edges that turn by no more than rounding
constexpr double max_step = .2;       // of coordinates, in mean edges; a grid has longer ones
constexpr double min_step = 1e-3;     // below which they hardly turn faces

/// Faces in one plane, connected; without faces unless the face with its number stands for it.
struct Patch {
  int faces = 0;
  double area = 0;
  bool has_sharp_edge = false;
};

/// Connected patches without sharp edges.
struct Group {
  int polygons = 0;                          // of more than two faces
  std::size_t edges = 0, rounded_edges = 0;  // between patches; those that turn by no more than rounding
  std::vector<double> areas;

  bool is_rounded() const {
    return std::ssize(areas) >= many &&
           static_cast<double>(rounded_edges) >= rounded_share * static_cast<double>(edges);
  }

  /// The area up to which patches are part of a smooth surface; 0 if none are.
  double max_area() {
    if (polygons < many && !is_rounded()) return 0;
    const auto middle = areas.begin() + std::ssize(areas) / 2;
    std::ranges::nth_element(areas, middle);
    const double median = *middle;
    const auto little_ones = std::ranges::count_if(areas, [&](double a) { return a < little * median; });
    const bool differ = static_cast<double>(little_ones) >= little_share * static_cast<double>(areas.size());
    return differ || is_rounded() ? large * median : 0;
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

/// The angle, in radians, by which rounding to multiples of these steps may turn the faces at an edge.
class TurnsByRounding {
 public:
  TurnsByRounding(const Mat3X& points, const Adjacency& c) : points_(points), c_(c) {
    double mean = 0;
    for (const auto& [a, b] : c.edges) mean += (points.col(a) - points.col(b)).norm();
    mean /= static_cast<double>(c.edges.size());
    for (int k = 0; k < 3; ++k) {
      const double step = step_of(points.row(k), min_step * mean);
      if (step <= max_step * mean) steps_[k] = step;
    }
  }

  /// Does the surface turn by no more at the edge? It is none of the boundary.
  bool explains(std::size_t edge) const {
    if (steps_.isZero()) return false;
    const auto& [a, b] = c_.edges[edge];
    const double length = (points_.col(a) - points_.col(b)).norm();
    Vec3 normals[2];
    double most = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 area = doubled_area_vector(points_, c_.faces[c_.edge_faces[edge][i]]);
      normals[i] = area.normalized();
      most += normals[i].cwiseAbs().dot(steps_) * length / area.norm();  // over the height
    }
    return std::atan2(normals[0].cross(normals[1]).norm(), normals[0].dot(normals[1])) <= most;
  }

 private:
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
  std::vector<Group> groups(c.faces.size());
  for (std::size_t f = 0; f < patches.size(); ++f) {
    if (patches[f].faces == 0 || patches[f].has_sharp_edge) continue;
    Group& group = groups[group_of.root(static_cast<int>(f))];
    group.polygons += patches[f].faces > 2;
    group.areas.push_back(patches[f].area);
  }
  const TurnsByRounding rounding(points, c);
  for (std::size_t e = 0; e < flat.size(); ++e) {
    if (flat[e] || c.is_boundary_edge(static_cast<int>(e))) continue;
    const auto& [left, right] = c.edge_faces[e];
    if (patch_at(left).has_sharp_edge || patch_at(right).has_sharp_edge) continue;
    Group& group = groups[group_of.root(left)];
    ++group.edges;
    group.rounded_edges += rounding.explains(e);
  }
  std::vector<double> max_areas;
  for (Group& group : groups) max_areas.push_back(group.max_area());
  std::vector<char> marks(c.faces.size(), 0);
  for (std::size_t f = 0; f < marks.size(); ++f) {
    const auto face = static_cast<int>(f);
    const Patch& patch = patch_at(face);
    marks[f] = patch.faces > 1 && !patch.has_sharp_edge && patch.area <= max_areas[group_of.root(face)];
  }
  return marks;
}

}  // namespace hooke
