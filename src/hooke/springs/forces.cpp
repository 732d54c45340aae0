#include "hooke/springs/forces.h"

#include <cassert>
#include <cmath>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/springs/hooke_law.h"

namespace hooke {
namespace {

constexpr std::size_t forces_block = 1024;

/// T^{j,j*} = n^j x n^{j,j*}: the effective part of the torque [6] of face j* on face j. The component of
/// n^{j,j*} along n^j drops out; with s = sin theta, c = cos theta T is (n^j x n^{j*}) theta / (s (1 + c) d).
Vec3 torque_across(const FaceShape& face, const FaceShape& other, const Vec3& edge_middle) {
  constexpr double folded = 1e-12;  // of 1 + cos theta
  const Vec3 axis = face.normal.cross(other.normal);
  const double sine = axis.norm();
  const double one_plus_cosine = .5 * (face.normal + other.normal).squaredNorm();  // no cancellation near pi
  if (one_plus_cosine < folded || sine == 0) return Vec3::Zero();
  const double theta = std::atan2(sine, face.normal.dot(other.normal));                       // [5]
  const double d = (face.centre - edge_middle).norm() + (other.centre - edge_middle).norm();  // [7]
  return axis * (theta / (sine * one_plus_cosine * d));                                       // [6]
}

std::vector<FaceShape> face_shapes(const Eigen::Ref<const Mat3X>& points, const Adjacency& c) {
  std::vector<FaceShape> shapes(c.faces.size());
  parallel_for(shapes.size(), forces_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) shapes[f] = face_shape(points, c.faces[f]);
  });
  return shapes;
}

/// Torque on the first face of every edge by the second; the second receives the opposite.
Mat3X edge_torques(const Eigen::Ref<const Mat3X>& points, const Adjacency& c,
                   const std::vector<FaceShape>& shapes) {
  Mat3X torques = Mat3X::Zero(3, static_cast<Eigen::Index>(c.edges.size()));
  parallel_for(c.edges.size(), forces_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto [first, second] = c.edge_faces[e];
      if (second < 0 || shapes[first].degenerate() || shapes[second].degenerate()) continue;
      const Vec3 middle = .5 * (points.col(c.edges[e][0]) + points.col(c.edges[e][1]));
      torques.col(e) = torque_across(shapes[first], shapes[second], middle);
    }
  });
  return torques;
}

}  // namespace

void string_forces(const Eigen::Ref<const Mat3X>& points, const Adjacency& c,
                   std::span<const double> target_lengths, Eigen::Ref<Mat3X> forces) {
  assert(points.cols() == c.vertex_count && forces.cols() == points.cols());
  assert(target_lengths.size() == c.edges.size());
  Mat3X pull(3, static_cast<Eigen::Index>(c.edges.size()));  // on the first end of each edge
  parallel_for(c.edges.size(), forces_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const Vec3 d = points.col(c.edges[e][1]) - points.col(c.edges[e][0]);
      const double l = d.norm();
      if (l > 0)
        pull.col(e) = d / l * spring_potential(l, target_lengths[e]).slope;  // [4]
      else
        pull.col(e).setZero();
    }
  });
  parallel_for(forces.cols(), forces_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Vec3 sum = Vec3::Zero();
      for (int e : c.vertex_edges[v]) sum += (c.edges[e][0] == static_cast<int>(v) ? 1 : -1) * pull.col(e);
      forces.col(v) = sum;  // [3]
    }
  });
}

void torque_forces(const Eigen::Ref<const Mat3X>& points, const Adjacency& c, Eigen::Ref<Mat3X> forces) {
  assert(points.cols() == c.vertex_count && forces.cols() == points.cols());
  const std::vector<FaceShape> shapes = face_shapes(points, c);
  const Mat3X across = edge_torques(points, c, shapes);
  Mat3X torque(3, static_cast<Eigen::Index>(c.faces.size()));
  parallel_for(c.faces.size(), forces_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      Vec3 sum = Vec3::Zero();
      for (int e : c.face_edges[f])
        sum += (c.edge_faces[e][0] == static_cast<int>(f) ? 1 : -1) * across.col(e);
      torque.col(f) = sum;  // n^j x [8]
    }
  });
  parallel_for(forces.cols(), forces_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Vec3 sum = Vec3::Zero();
      for (int f : c.vertex_faces[v]) sum += torque.col(f).cross(points.col(v) - shapes[f].centre);  // [9]
      forces.col(v) = sum;                                                                           // [10]
    }
  });
}

}  // namespace hooke
