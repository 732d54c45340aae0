#include "hooke/bounding_volume_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hooke {
namespace {

Vec3 closest_on_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double squared_length = d.squaredNorm();
  if (!(squared_length > 0)) return a;
  return a + std::clamp(d.dot(x - a) / squared_length, 0., 1.) * d;
}

}  // namespace

ClosestPoint closest_point(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  ClosestPoint best;
  const Vec3 n = (b - a).cross(c - a);
  const double nn = n.squaredNorm();
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  // Thinner triangles have no normal to speak of: their edges are as close as their inside.
  if (nn > 1e-24 * longest * longest) {
    const bool inside =
        n.cross(b - a).dot(x - a) >= 0 && n.cross(c - b).dot(x - b) >= 0 && n.cross(a - c).dot(x - c) >= 0;
    if (inside) {
      const double height = n.dot(x - a);
      best.point = x - (height / nn) * n;
      best.squared_distance = height * height / nn;
      return best;
    }
  }
  best.squared_distance = std::numeric_limits<double>::infinity();
  for (const Vec3& p :
       {closest_on_segment(x, a, b), closest_on_segment(x, b, c), closest_on_segment(x, c, a)}) {
    const double squared_distance = (x - p).squaredNorm();
    if (squared_distance >= best.squared_distance) continue;
    best.squared_distance = squared_distance;
    best.point = p;
  }
  return best;
}

Vec3 barycentric(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  Vec3 weights(n.dot((c - b).cross(x - b)), n.dot((a - c).cross(x - c)), n.dot((b - a).cross(x - a)));
  weights = weights.cwiseMax(0);
  const double sum = weights.sum();
  if (!(sum > 0)) return Vec3::Constant(1. / 3);
  return weights / sum;
}

BoundingVolumeTree::BoundingVolumeTree(const Mat3X& points, const std::vector<Triangle>& faces) {
  corners_.reserve(faces.size());
  face_boxes_.reserve(faces.size());
  std::vector<Vec3> centres;
  centres.reserve(faces.size());
  for (const Triangle& t : faces) {
    corners_.push_back({points.col(t[0]), points.col(t[1]), points.col(t[2])});
    Box box;
    for (const Vec3& p : corners_.back()) box.extend(p);
    face_boxes_.push_back(box);
    centres.emplace_back(box.center());
  }
  order_.resize(faces.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(faces.size());
  build(0, static_cast<int>(faces.size()), centres);
}

/// Appends the node of order_[begin, end) and all below it, halving along the longest side of the centres'
/// box.
void BoundingVolumeTree::build(int begin, int end, const std::vector<Vec3>& centres) {
  const size_t me = nodes_.size();
  nodes_.emplace_back();
  Box spread;
  for (int k = begin; k < end; ++k) {
    const auto f = static_cast<size_t>(order_[static_cast<size_t>(k)]);
    nodes_[me].box.extend(face_boxes_[f]);
    spread.extend(centres[f]);
  }
  if (end - begin <= leaf_size) {
    nodes_[me].first_or_right = begin;
    nodes_[me].count = end - begin;
    return;
  }
  Eigen::Index axis;
  spread.sizes().maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int f, int g) {
    const double x = centres[static_cast<size_t>(f)][axis], y = centres[static_cast<size_t>(g)][axis];
    return x < y || (x == y && f < g);
  });
  build(begin, middle, centres);
  nodes_[me].first_or_right = static_cast<int>(nodes_.size());
  build(middle, end, centres);
}

void BoundingVolumeTree::try_face(const Vec3& x, int face, ClosestPoint& best) const {
  const auto& [a, b, c] = corners_[static_cast<size_t>(face)];
  const ClosestPoint candidate = closest_point(x, a, b, c);
  const double d = candidate.squared_distance;
  if (d > best.squared_distance || (d == best.squared_distance && face >= best.face)) return;
  best = candidate;
  best.face = face;
}

ClosestPoint BoundingVolumeTree::closest(const Vec3& x, int hint) const {
  ClosestPoint best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  if (empty()) return best;
  if (hint >= 0) try_face(x, hint, best);

  struct Visit {
    int node;
    double squared_distance;
  };
  Visit stack[max_depth];
  int size = 0;
  stack[size++] = {0, nodes_[0].box.squaredExteriorDistance(x)};
  while (size > 0) {
    const Visit visit = stack[--size];
    if (visit.squared_distance > best.squared_distance) continue;
    const Node& node = nodes_[static_cast<size_t>(visit.node)];
    if (node.count > 0) {
      for (int k = node.first_or_right; k < node.first_or_right + node.count; ++k) {
        const int f = order_[static_cast<size_t>(k)];
        if (face_boxes_[static_cast<size_t>(f)].squaredExteriorDistance(x) <= best.squared_distance)
          try_face(x, f, best);
      }
      continue;
    }
    Visit near{visit.node + 1, 0}, far{node.first_or_right, 0};
    near.squared_distance = nodes_[static_cast<size_t>(near.node)].box.squaredExteriorDistance(x);
    far.squared_distance = nodes_[static_cast<size_t>(far.node)].box.squaredExteriorDistance(x);
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

}  // namespace hooke
