#include "hooke/filter/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr std::size_t block = 1024;

/// Of the edges across their main direction, over that along it, squared.
constexpr double least_spread = 1e-3;

/// Its shape operator: M with M d = turn in the sense of least squares, made symmetric.
SurfaceBend bend_at(const Mat3X& points, const Mat3X& normals, const Connectivity& c, int v) {
  const auto neighbours = c.vertex_neighbours[v];
  if (neighbours.empty() || normals.col(v).isZero(0)) return unknown_bend();
  const Vec3 n = normals.col(v);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = n.unitOrthogonal();
  basis.col(1) = n.cross(basis.col(0));
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(), turned = Eigen::Matrix2d::Zero();
  for (int w : neighbours) {
    const Eigen::Vector2d way = basis.transpose() * (points.col(w) - points.col(v));
    const Eigen::Vector2d turn = basis.transpose() * (normals.col(w) - normals.col(v));
    spread += way * way.transpose();
    turned += turn * way.transpose();
  }
  const double size = spread.trace();
  if (!(spread.determinant() > least_spread * size * size)) return unknown_bend();
  const Eigen::Matrix2d shape = turned * spread.inverse();
  const Eigen::Matrix2d symmetric = .5 * (shape + shape.transpose());
  return {.shape = SymmetricMatrix(basis * symmetric * basis.transpose())};
}

}  // namespace

SurfaceBend unknown_bend() {
  return {.change = std::numeric_limits<float>::infinity()};
}

std::vector<SurfaceBend> surface_bends(const Mat3X& points, const Mat3X& normals, const Connectivity& c) {
  const auto n = static_cast<std::size_t>(c.vertex_count);
  std::vector<SurfaceBend> bends(n);
  parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) bends[v] = bend_at(points, normals, c, static_cast<int>(v));
  });
  std::vector<float> change(n);
  parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      change[v] = bends[v].change;  // so far infinite or none
      if (std::isinf(change[v])) continue;
      double squares = 0;
      const auto neighbours = c.vertex_neighbours[static_cast<int>(v)];
      for (int w : neighbours) {
        const Vec3 way = points.col(w) - points.col(static_cast<Eigen::Index>(v));
        const auto normal = normals.col(static_cast<Eigen::Index>(v));
        Vec3 turn = bends[v].shape * way - bends[static_cast<std::size_t>(w)].shape * way;
        turn -= normal.dot(turn) * normal;  // the tangent plane turns too
        if (!way.isZero(0)) squares += turn.squaredNorm() / way.squaredNorm();
      }
      if (!neighbours.empty())
        change[v] = static_cast<float>(std::sqrt(squares / static_cast<double>(neighbours.size())));
    }
  });
  parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      bends[v].change = change[v];
      for (int w : c.vertex_neighbours[static_cast<int>(v)])
        bends[v].change = std::max(bends[v].change, change[static_cast<std::size_t>(w)]);
    }
  });
  return bends;
}

}  // namespace hooke
