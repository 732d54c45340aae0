#include "hooke/remesh/shorter_lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hooke/core/uniform_vector.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/remesh/bends.h"
#include "hooke/remesh/walls.h"
#include "hooke/springs/sizing.h"

namespace hooke {

namespace {

/// Of all edges or faces: not worth another attempt.
bool are_few(std::size_t places, std::size_t all) {
  constexpr double few = .0005;
  return static_cast<double>(places) < few * static_cast<double>(all);
}

}  // namespace

std::optional<AskedLengths> ShorterLengths::resolving_bends(const Attempt& attempt, double max_faces) const {
  constexpr double max_bend = 45;  // degrees, within an edge
  std::vector<Bend> bends = unresolved_bends(maker_, attempt, max_bend);
  std::erase_if(bends, [](const Bend& b) { return b.across_crease; });  // may be several of the input in one
  if (are_few(bends.size(), attempt.mesh.n_edges())) return std::nullopt;
  constexpr double fine_bend = 33, coarser = 4. / 3, more_faces = 2;
  const auto lengths_at = [&](double bend, double Bend::*length) {
    AskedLengths lengths = attempt.lengths;
    for (const Bend& b : bends)
      lengths.shorter.push_back({b.from, b.to, b.*length * std::min(1., bend / b.angle)});
    return lengths;
  };
  for (const auto length : {&Bend::width, &Bend::target})
    for (double bend = fine_bend; bend < 2 * max_bend; bend *= coarser) {
      AskedLengths lengths = lengths_at(bend, length);
      const bool may_be_more = length == &Bend::width && bend > fine_bend;
      const double most = may_be_more ? more_faces * max_faces : max_faces;
      if (faces_of(lengths, most) <= most) return lengths;
    }
  return std::nullopt;
}

std::optional<AskedLengths> ShorterLengths::resolving_walls(const Attempt& attempt, double max_faces) const {
  constexpr double max_share = .2, fine_share = .1, coarser = 16. / 9, least = .1;
  const std::vector<LeftWall> walls = left_walls(maker_, attempt, max_share);
  if (are_few(walls.size(), maker_.input().adjacency.faces.size())) return std::nullopt;
  for (double share = fine_share; share < 2 * max_share; share *= coarser) {
    AskedLengths lengths = attempt.lengths;
    for (const LeftWall& w : walls) {  // chords leave a smooth surface by the square of lengths
      const double finer = std::max(std::sqrt(share * w.thickness / w.distance), least);
      if (finer < 1) lengths.shorter.push_back({w.from, w.to, w.target * finer});
    }
    if (lengths.shorter.size() == attempt.lengths.shorter.size()) return std::nullopt;
    if (faces_of(lengths, max_faces) <= max_faces) return lengths;
  }
  return std::nullopt;
}

/// By how much to shorten lengths where a distance is `excess` times its limit. Where a limit is asked for
/// it tells: distances of chords of a smooth surface grow with the square of lengths.
double ShorterLengths::shortening(double excess) const {
  constexpr double least = .25, most = .6485, without_limit = .42;  // most: 2^(-5/8), see PlacedLengths
  if (!maker_.has_tolerance()) return without_limit;
  return std::isfinite(excess) ? std::clamp(most / std::sqrt(excess), least, most) : .5;
}

double ShorterLengths::faces_of(const AskedLengths& lengths, double enough) const {
  const Adjacency& c = maker_.input().adjacency;
  if (!lengths.shorter.empty())
    return placed(lengths).covering_faces(maker_.input().points, c.faces, lengths.of_vertices, enough);
  const double length =
      covering_length(maker_.input().points, c, spread_target_lengths(c, lengths.of_vertices));
  return total_area(maker_.input().points, c.faces) / (std::numbers::sqrt3 / 4 * length * length);
}

PlacedLengths ShorterLengths::placed(const AskedLengths& lengths) const {
  const double mean = std::accumulate(asked_.begin(), asked_.end(), 0.) / static_cast<double>(asked_.size());
  return {lengths.shorter, mean, Sizing().gradation};
}

void ShorterLengths::shorten_at(const std::vector<FlawPlace>& flaws, const Attempt& last,
                                AskedLengths& lengths) const {
  const PlacedLengths places = placed(lengths);
  std::vector<PlacedLength> shorter;
  for (const FlawPlace& flaw : flaws) {
    const Vec3 middle = .5 * (flaw.from + flaw.to);
    const double present =
        last.result.rescue == Rescue::kept_faces ? places.length_at(middle, asked_at(middle)) : flaw.length;
    shorter.push_back({flaw.from, flaw.to, present * shortening(flaw.excess)});
  }
  lengths.shorter.insert(lengths.shorter.end(), shorter.begin(), shorter.end());
}

std::vector<double> ShorterLengths::at_edges(const AskedLengths& lengths) const {
  constexpr int max_pieces = 8;
  const Mat3X& points = maker_.input().points;
  const PlacedLengths places = placed(lengths);
  std::vector<double> at;
  for (const auto& [a, b] : maker_.input().adjacency.edges) {
    const Vec3 from = points.col(a), to = points.col(b);
    const double asked = std::min(lengths.of_vertices[a], lengths.of_vertices[b]);
    const int pieces = std::clamp(static_cast<int>(2 * (to - from).norm() / asked), 2, max_pieces);
    double longest = 0;
    for (int i = 1; i < pieces; ++i)
      longest = std::max(longest, places.length_at(from + i * (to - from) / pieces, asked));
    at.push_back(longest);
  }
  return at;
}

int ShorterLengths::count_in(const Attempt& run) const {
  constexpr double clearly = .8, moved = 1.1;  // since they were sampled
  const std::vector<double> lengths = vertex_values(run.mesh, target_length_property);
  const Mat3X points = vertex_points(run.mesh);
  const PlacedLengths places = placed(run.lengths);
  int count = 0;
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    const double asked = asked_at(points.col(v)), length = places.length_at(points.col(v), asked);
    count += length < clearly * asked && length <= moved * lengths[v];
  }
  return count;
}

double ShorterLengths::asked_at(const Vec3& x) const {
  if (UniformVector::are_equal(asked_)) return asked_[0];
  const ClosestPoint closest = maker_.input().tree.closest(x);
  if (closest.face < 0) return asked_[0];
  const Triangle& t = maker_.input().adjacency.faces[closest.face];
  const Vec3 weights = on_face(closest, maker_.input().points, maker_.input().adjacency).weights;
  return weights.dot(Vec3(asked_[t[0]], asked_[t[1]], asked_[t[2]]));
}

}  // namespace hooke
