#include "hooke/springs/placed_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace hooke {
namespace {

constexpr double steps_of_half = 8;  // of lengths in groups

AabbTree tree_of(const std::vector<PlacedLength>& places) {
  Mat3X ends(3, 2 * std::ssize(places));
  std::vector<Triangle> faces;
  for (const PlacedLength& place : places) {
    const int a = 2 * static_cast<int>(faces.size());
    ends.col(a) = place.from;
    ends.col(a + 1) = place.to;
    faces.push_back({a, a + 1, a + 1});
  }
  return {ends, faces};
}

}  // namespace

PlacedLengths::PlacedLengths(const std::vector<PlacedLength>& places, double unit, double gradation)
    : gradation_(gradation) {
  std::map<int, std::vector<PlacedLength>> by_power;
  for (const PlacedLength& place : places) by_power[power_of(place.length, unit)].push_back(place);
  for (const auto& [power, group] : by_power)
    groups_.push_back({unit * std::exp2(power / steps_of_half), tree_of(group)});
}

int PlacedLengths::power_of(double length, double unit) {
  constexpr double rounding = 1e-9;
  return static_cast<int>(std::floor(steps_of_half * std::log2(length / unit) + rounding));
}

double PlacedLengths::length_at(const Vec3& x, double asked) const {
  double length = asked;
  for (const auto& [placed, segments] : groups_) {
    if (placed >= length) break;
    const double reach = (length - placed) / gradation_;
    const ClosestPoint closest =
        segments.closest(x, [](int) { return true; }, {.squared_distance = reach * reach});
    if (closest.face >= 0) length = placed + gradation_ * std::sqrt(closest.squared_distance);
  }
  return length;
}

double PlacedLengths::covering_faces(const Mat3X& points, const std::vector<Triangle>& faces,
                                     const std::vector<double>& vertex_length, double enough) const {
  struct Piece {
    std::array<Vec3, 3> corners;
    Vec3 asked;  // lengths at the corners
  };
  constexpr double least = .2;  // of a face: needles take no piece for each of the lengths along them
  double count = 0;
  std::vector<Piece> pieces;
  for (const Triangle& t : faces) {
    pieces.push_back({});
    for (std::size_t k = 0; k < 3; ++k) {
      pieces.back().corners[k] = points.col(t[k]);
      pieces.back().asked[static_cast<Eigen::Index>(k)] = vertex_length[t[k]];
    }
    while (!pieces.empty()) {
      if (count > enough) return count;
      Piece p = pieces.back();
      pieces.pop_back();
      const auto& [a, b, c] = p.corners;
      const double length = length_at((a + b + c) / 3, p.asked.mean());
      const std::array<double, 3> edges = {(b - a).norm(), (c - b).norm(), (a - c).norm()};
      const std::size_t longest = std::ranges::max_element(edges) - edges.begin(), next = (longest + 1) % 3;
      const double covering = 2 * (b - a).cross(c - a).norm() / (std::sqrt(3.) * length * length);
      if (edges[longest] <= length || covering < least) {
        count += covering;
        continue;
      }
      Piece other = p;
      const auto i = static_cast<Eigen::Index>(longest), j = static_cast<Eigen::Index>(next);
      p.corners[next] = other.corners[longest] = .5 * (p.corners[longest] + p.corners[next]);
      p.asked[j] = other.asked[i] = .5 * (p.asked[i] + p.asked[j]);
      pieces.push_back(p);
      pieces.push_back(other);
    }
  }
  return count;
}

}  // namespace hooke
