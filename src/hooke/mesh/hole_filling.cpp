#include "hooke/mesh/hole_filling.h"

#include <cmath>
#include <limits>
#include <utility>

namespace hooke {
namespace {

// The least cost of each part of the polygon, from corner i to corner j > i, and the third corner of the
// triangle at its diagonal.
class Parts {
 public:
  explicit Parts(size_t count) : count_(count), costs_(count * count, 0), thirds_(count * count, 0) {}
  double& cost(size_t i, size_t j) { return costs_[i * count_ + j]; }
  size_t& third(size_t i, size_t j) { return thirds_[i * count_ + j]; }

 private:
  size_t count_;
  std::vector<double> costs_;
  std::vector<size_t> thirds_;
};

}  // namespace

std::optional<std::vector<Triangle>> fill_polygon(const Mat3X& points, const std::vector<int>& polygon,
                                                  const HasEdge& has_edge) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double weight_of_diagonals = 1e-3;
  const size_t n = polygon.size();
  const auto point = [&](size_t i) { return Vec3(points.col(polygon[i])); };
  const auto area = [&](size_t i, size_t k, size_t j) {
    return .5 * (point(k) - point(i)).cross(point(j) - point(i)).norm();
  };
  Parts parts(n);
  for (size_t length = 2; length < n; ++length)
    for (size_t i = 0; i + length < n; ++i) {
      const size_t j = i + length;
      double least = infinity;
      for (size_t k = i + 1; k < j; ++k) {
        if (parts.cost(i, k) == infinity || parts.cost(k, j) == infinity) continue;
        const double cost = parts.cost(i, k) + parts.cost(k, j) + area(i, k, j);
        if (cost >= least) continue;
        least = cost;
        parts.third(i, j) = k;
      }
      const bool diagonal = length + 1 < n;  // not the last side of the polygon
      if (diagonal && has_edge(polygon[i], polygon[j])) least = infinity;
      if (diagonal) least += weight_of_diagonals * (point(j) - point(i)).squaredNorm();
      parts.cost(i, j) = least;
    }
  if (parts.cost(0, n - 1) == infinity) return std::nullopt;
  std::vector<Triangle> triangles;
  std::vector<std::pair<size_t, size_t>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const size_t k = parts.third(i, j);
    triangles.push_back({polygon[i], polygon[k], polygon[j]});
    open.emplace_back(i, k);
    open.emplace_back(k, j);
  }
  return triangles;
}

}  // namespace hooke
