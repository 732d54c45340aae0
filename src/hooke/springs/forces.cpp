#include "hooke/springs/forces.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

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

namespace {

/// The forces of the altitude springs on the corners of a face, and their energy.
struct FaceAltitudes {
  std::array<Vec3, 3> push{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double energy = 0;
};

FaceAltitudes face_altitudes(std::array<Vec3, 3> x, const Vec3& normal, double target_length) {
  const Vec3 across = (x[1] - x[0]).cross(x[2] - x[0]);
  if (across.dot(normal) > 0)
    for (Vec3& corner : x) corner -= normal * normal.dot(corner);
  FaceAltitudes face;
  const double h0 = .5 * std::numbers::sqrt3 * target_length;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    const Vec3 base = x[last] - x[next];
    const double share = base.squaredNorm() > 0 ? (x[k] - x[next]).dot(base) / base.squaredNorm() : 0;
    const Vec3 altitude = x[k] - x[next] - share * base;
    const double h = altitude.norm();
    if (!(h > 0) || h >= h0) continue;
    const Potential spring = spring_potential(h, h0);
    const Vec3 push = -spring.slope / h * altitude;
    face.push[k] += push;
    face.push[next] -= (1 - share) * push;
    face.push[last] -= share * push;
    face.energy += spring.value / (target_length * target_length);
  }
  return face;
}

FaceAltitudes face_altitudes(const Eigen::Ref<const Mat3X>& points, const Mat3X* normals, const Adjacency& c,
                             std::span<const double> target_lengths, std::size_t face) {
  const Triangle& t = c.faces[face];
  Vec3 normal = Vec3::Zero();
  if (normals)
    for (int v : t) normal += normals->col(v);
  double length = 0;
  for (int e : c.face_edges[face]) length += target_lengths[e] / 3;
  return face_altitudes({points.col(t[0]), points.col(t[1]), points.col(t[2])}, normal.normalized(), length);
}

}  // namespace

void add_altitude_forces(const Eigen::Ref<const Mat3X>& points, const Mat3X* normals, const Adjacency& c,
                         std::span<const double> target_lengths, double weight, Eigen::Ref<Mat3X> forces) {
  assert(points.cols() == c.vertex_count && forces.cols() == points.cols());
  std::vector<FaceAltitudes> faces(c.faces.size());
  parallel_for(faces.size(), forces_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      faces[f] = face_altitudes(points, normals, c, target_lengths, f);
  });
  parallel_for(forces.cols(), forces_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Vec3 sum = Vec3::Zero();
      for (int f : c.vertex_faces[v]) sum += faces[f].push[corner_of(c.faces[f], static_cast<int>(v))];
      forces.col(v) += weight * sum;
    }
  });
}

double altitude_energy(const Eigen::Ref<const Mat3X>& points, const Mat3X* normals, const Adjacency& c,
                       std::span<const double> target_lengths) {
  return parallel_sum(c.faces.size(), forces_block, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t f = begin; f < end; ++f)
      sum += face_altitudes(points, normals, c, target_lengths, f).energy;
    return sum;
  });
}

double string_energy(const Eigen::Ref<const Mat3X>& points, const Adjacency& c,
                     std::span<const double> target_lengths) {
  return parallel_sum(c.edges.size(), forces_block, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t e = begin; e < end; ++e) {
      const double L = target_lengths[e];
      const double l = (points.col(c.edges[e][1]) - points.col(c.edges[e][0])).norm();
      sum += spring_potential(l, L).value / (L * L);
    }
    return sum;
  });
}

}  // namespace hooke
