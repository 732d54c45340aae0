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

/// Eigen's squaredExteriorDistance without branches: they are unpredictable here.
double squared_distance(const Eigen::AlignedBox3d& box, const Vec3& x) {
  return (box.min() - x).cwiseMax(x - box.max()).cwiseMax(0).squaredNorm();
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
  std::vector<Box> boxes(faces.size());
  std::vector<Centre> centres(faces.size());
  for (size_t f = 0; f < faces.size(); ++f) {
    for (int v : faces[f]) boxes[f].extend(Vec3(points.col(v)));
    centres[f] = {boxes[f].center(), static_cast<int>(f)};
  }
  nodes_.reserve(faces.size());
  build(0, faces.size(), centres, boxes);

  place_.resize(faces.size());
  faces_.reserve(faces.size());
  for (const Centre& centre : centres) {
    const auto f = static_cast<size_t>(centre.face);
    place_[f] = static_cast<int>(faces_.size());
    faces_.push_back(
        {boxes[f], {points.col(faces[f][0]), points.col(faces[f][1]), points.col(faces[f][2])}, centre.face});
  }
}

/// Appends the node of centres[begin, end) and all below it: halves along the longest side of the centres'
/// box.
void BoundingVolumeTree::build(size_t begin, size_t end, std::vector<Centre>& centres,
                               const std::vector<Box>& boxes) {
  const size_t me = nodes_.size();
  nodes_.emplace_back();
  Box box, spread;
  for (size_t k = begin; k < end; ++k) {
    box.extend(boxes[static_cast<size_t>(centres[k].face)]);
    spread.extend(centres[k].point);
  }
  nodes_[me].box = box;
  if (end - begin <= leaf_size) {
    nodes_[me].first_or_right = static_cast<int>(begin);
    nodes_[me].count = static_cast<int>(end - begin);
    return;
  }
  Eigen::Index axis;
  spread.sizes().maxCoeff(&axis);
  const size_t middle = begin + (end - begin) / 2;
  const auto at = [&](size_t k) { return centres.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Centre& a, const Centre& b) {
    return a.point[axis] < b.point[axis] || (a.point[axis] == b.point[axis] && a.face < b.face);
  });
  build(begin, middle, centres, boxes);
  nodes_[me].first_or_right = static_cast<int>(nodes_.size());
  build(middle, end, centres, boxes);
}

void BoundingVolumeTree::try_face(const Vec3& x, const Face& face, ClosestPoint& best) {
  const ClosestPoint candidate = closest_point(x, face.corners[0], face.corners[1], face.corners[2]);
  const double d = candidate.squared_distance;
  if (d > best.squared_distance || (d == best.squared_distance && face.id >= best.face)) return;
  best = candidate;
  best.face = face.id;
}

ClosestPoint BoundingVolumeTree::closest(const Vec3& x, int hint) const {
  ClosestPoint best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  if (empty()) return best;
  if (hint >= 0) try_face(x, faces_[static_cast<size_t>(place_[static_cast<size_t>(hint)])], best);

  struct Visit {
    int node;
    double distance;  // squared
  };
  Visit stack[max_depth];
  int size = 0;
  stack[size++] = {0, squared_distance(nodes_[0].box, x)};
  while (size > 0) {
    const Visit visit = stack[--size];
    if (visit.distance > best.squared_distance) continue;
    const Node& node = nodes_[static_cast<size_t>(visit.node)];
    if (node.count > 0) {
      const Face* face = faces_.data() + node.first_or_right;
      for (int k = 0; k < node.count; ++k)
        if (squared_distance(face[k].box, x) <= best.squared_distance) try_face(x, face[k], best);
      continue;
    }
    const int left = visit.node + 1, right = node.first_or_right;
    Visit near{left, squared_distance(nodes_[static_cast<size_t>(left)].box, x)};
    Visit far{right, squared_distance(nodes_[static_cast<size_t>(right)].box, x)};
    if (far.distance < near.distance) std::swap(near, far);
    if (far.distance <= best.squared_distance) stack[size++] = far;
    if (near.distance <= best.squared_distance) stack[size++] = near;
  }
  return best;
}

}  // namespace hooke
