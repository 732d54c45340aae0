#include "hooke/mesh/normals.h"

#include <algorithm>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"

namespace hooke {
namespace {

constexpr std::size_t normals_block = 1024;

Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

/// Normal of the face weighted for its corner at `v`: sin(angle) / (product of the two edges there).
Vec3 weighted_corner_normal(const Eigen::Ref<const Mat3X>& points, const Triangle& face, int v) {
  const std::size_t k = corner_of(face, v);
  const Vec3 a = points.col(face[(k + 1) % 3]) - points.col(v);
  const Vec3 b = points.col(face[(k + 2) % 3]) - points.col(v);
  const double weight = a.squaredNorm() * b.squaredNorm();
  return weight > 0 ? Vec3(a.cross(b) / weight) : Vec3(Vec3::Zero());
}

}  // namespace

Mat3X face_normals(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency) {
  Mat3X normals(3, static_cast<Eigen::Index>(adjacency.faces.size()));
  parallel_for(adjacency.faces.size(), normals_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const auto& [a, b, c] = adjacency.faces[f];
      const Vec3 ab = points.col(b) - points.col(a), ac = points.col(c) - points.col(a);
      normals.col(static_cast<Eigen::Index>(f)) = unit_or_zero(ab.cross(ac));
    }
  });
  return normals;
}

Mat3X vertex_normals(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency) {
  Mat3X normals(3, points.cols());
  parallel_for(points.cols(), normals_block, [&](std::size_t begin, std::size_t end) {
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
      Vec3 sum = Vec3::Zero();
      for (int f : adjacency.vertex_faces[v]) sum += weighted_corner_normal(points, adjacency.faces[f], v);
      normals.col(v) = unit_or_zero(sum);
    }
  });
  return normals;
}

Vec3 newell_normal(const Mat3X& points, std::span<const int> corners) {
  const Vec3 origin = points.col(corners[0]);
  double size = 0;
  for (const int v : corners) size = std::max(size, (points.col(v) - origin).cwiseAbs().maxCoeff());
  if (!(size > 0)) return Vec3::Zero();
  Vec3 sum = Vec3::Zero();
  Vec3 last = (points.col(corners.back()) - origin) / size;
  for (const int v : corners) {
    const Vec3 next = (points.col(v) - origin) / size;
    sum += last.cross(next);
    last = next;
  }
  return sum.allFinite() ? unit_or_zero(sum) : Vec3(Vec3::Zero());
}

Eigen::VectorXd mean_edge_lengths(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency) {
  Eigen::VectorXd lengths(points.cols());
  parallel_for(points.cols(), normals_block, [&](std::size_t begin, std::size_t end) {
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
      const auto neighbours = adjacency.vertex_neighbours[v];
      double sum = 0;
      for (int n : neighbours) sum += (points.col(n) - points.col(v)).norm();
      lengths[v] = neighbours.empty() ? 0 : sum / static_cast<double>(neighbours.size());
    }
  });
  return lengths;
}

Mat3X certain_face_normals(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency) {
  Mat3X normals(3, static_cast<Eigen::Index>(adjacency.faces.size()));
  parallel_for(adjacency.faces.size(), normals_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      normals.col(static_cast<Eigen::Index>(f)) = face_shape(points, adjacency.faces[f]).normal;
  });
  return normals;
}

std::vector<int> sharp_edges(const Mat3X& points, const Adjacency& c, double angle) {
  const Mat3X normals = certain_face_normals(points, c);
  std::vector<char> is_sharp(c.edges.size(), 0);
  parallel_for(is_sharp.size(), normals_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      if (c.is_boundary_edge(static_cast<int>(e))) continue;
      const auto& [left, right] = c.edge_faces[e];
      is_sharp[e] = angle_between(normals.col(left), normals.col(right)) > angle;
    }
  });
  std::vector<int> edges;
  for (std::size_t e = 0; e < is_sharp.size(); ++e)
    if (is_sharp[e]) edges.push_back(static_cast<int>(e));
  return edges;
}

}  // namespace hooke
