#include "hooke/mesh/staircase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

constexpr double resolved_step = .75;  // target lengths
constexpr double tolerance = 1e-3;     // of the length of a step
constexpr std::size_t min_edges = 100;
constexpr double corner_share = 1. / 3;

/// The steps along the edges, at most three up to their sign.
class Steps {
 public:
  /// The index of the step, 3 if there are three others.
  std::size_t index_of(const Vec3& step) {
    const auto is_same = [&](const Vec3& other) {
      const double limit = tolerance * other.norm();
      return (step - other).norm() <= limit || (step + other).norm() <= limit;
    };
    const auto found = std::ranges::find_if(steps_, is_same);
    const std::size_t index = found - steps_.begin();
    if (found == steps_.end() && steps_.size() < 3) steps_.push_back(step);
    return index;
  }

 private:
  std::vector<Vec3> steps_;
};

}  // namespace

bool is_staircase(const Mat3X& points, const Adjacency& c, const std::vector<double>& vertex_length) {
  const double cosine = std::cos(std::numbers::pi / 4);
  const Mat3X normals = certain_face_normals(points, c);
  Steps steps;
  std::size_t count = 0;
  // Per vertex: how many sharp edges there are along each step.
  std::vector<std::array<int, 3>> along(c.vertex_count, {0, 0, 0});
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    const auto& [left, right] = c.edge_faces[e];
    if (right < 0) continue;
    const Vec3 n = normals.col(left), m = normals.col(right);
    if (n.dot(m) > cosine || n.isZero(0) || m.isZero(0)) continue;
    const auto& [a, b] = c.edges[e];
    const Vec3 step = points.col(b) - points.col(a);
    const auto length = [&](int v) { return vertex_length[v]; };
    const std::size_t index = steps.index_of(step);
    if (index == 3 || step.norm() > resolved_step * std::min(length(a), length(b))) return false;
    for (int v : {a, b}) ++along[v][index];
    ++count;
  }
  const auto is_sharp = [](const std::array<int, 3>& n) { return n != std::array<int, 3>{0, 0, 0}; };
  const auto is_corner = [&](const std::array<int, 3>& n) {
    return is_sharp(n) && std::ranges::find(n, 2) == n.end();
  };
  const auto sharp = static_cast<double>(std::ranges::count_if(along, is_sharp));
  return count >= min_edges &&
         static_cast<double>(std::ranges::count_if(along, is_corner)) >= corner_share * sharp;
}

}  // namespace hooke
