#include "hooke/bounding_volume_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/lanes.h"
#include "hooke/parallel.h"

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

constexpr size_t block = 4096;

/// Nodes of a tree over n faces and of one over n + 1, if leaves hold up to `leaf` faces and all else is
/// halved.
std::array<size_t, 2> node_counts(size_t n, size_t leaf) {
  if (n + 1 <= leaf) return {1, 1};
  const auto [half, more] = node_counts(n / 2, leaf);
  const bool odd = n % 2 == 1;
  return {n <= leaf ? 1 : 1 + half + (odd ? more : half), 1 + more + (odd ? more : half)};
}

/// Better than `best`: closer, or as close and of a lower id.
void try_face(const Vec3& x, const BoundingVolumeTree::Face& face, ClosestPoint& best) {
  const ClosestPoint candidate = closest_point(x, face.corners[0], face.corners[1], face.corners[2]);
  const double d = candidate.squared_distance;
  if (d > best.squared_distance || (d == best.squared_distance && face.id >= best.face)) return;
  best = candidate;
  best.face = face.id;
}

/// Thinner triangles have no normal to speak of: their edges are as close as their inside.
constexpr double least_squared_area = 1e-24;  // doubled, over the fourth power of the longest edge

/// Four points and where each is closest to, as far as it is known.
struct FourPoints {
  double points[3 * lane_count];
  double squared_distance[lane_count];
  long long place[lane_count];  // of a face, in the order of the tree
};

/// Squared distances of four points to a box.
HOOKE_INLINE void distances_to(const Eigen::AlignedBox3d& box, const LaneVec& x, Lanes& squared) {
  const auto outside = [](const Lanes& t, double low, double high, Lanes& d) {
    const Lanes zero = {}, below = low - t, above = t - high;
    d = below > above ? below : above;
    d = d > zero ? d : zero;
  };
  LaneVec d;
  outside(x.x, box.min()[0], box.max()[0], d.x);
  outside(x.y, box.min()[1], box.max()[1], d.y);
  outside(x.z, box.min()[2], box.max()[2], d.z);
  dot(d, d, squared);
}

HOOKE_INLINE void dot(const LaneVec& a, const Vec3& b, Lanes& product) {
  product = a.x * b[0] + a.y * b[1] + a.z * b[2];
}

/// Squared distance from the corner a to the segment of length^2 l2 along d; x is seen from there.
HOOKE_INLINE void distances_to_segment(const LaneVec& x, const Vec3& d, double l2, Lanes& squared) {
  const Lanes zero = {}, one = zero + 1.;
  Lanes t;
  dot(x, d, t);
  t *= l2 > 0 ? 1 / l2 : 0;
  t = t > zero ? t : zero;
  t = t < one ? t : one;
  const LaneVec way = {x.x - t * d[0], x.y - t * d[1], x.z - t * d[2]};
  dot(way, way, squared);
}

/// Squared distances of four points to a triangle: closest_point() without the point.
HOOKE_INLINE void distances_to(const BoundingVolumeTree::Face& face, const LaneVec& x, Lanes& squared) {
  const auto& [a, b, c] = face.corners;
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const LaneVec from_a = {x.x - a[0], x.y - a[1], x.z - a[2]}, from_b = {x.x - b[0], x.y - b[1], x.z - b[2]},
                from_c = {x.x - c[0], x.y - c[1], x.z - c[2]};
  const double ab2 = ab.squaredNorm(), bc2 = bc.squaredNorm(), ca2 = ca.squaredNorm();
  Lanes other;
  distances_to_segment(from_a, ab, ab2, squared);
  distances_to_segment(from_b, bc, bc2, other);
  squared = other < squared ? other : squared;
  distances_to_segment(from_c, ca, ca2, other);
  squared = other < squared ? other : squared;

  const Vec3 n = ab.cross(-ca);
  const double nn = n.squaredNorm(), longest = std::max({ab2, bc2, ca2});
  if (!(nn > least_squared_area * longest * longest)) return;
  Lanes beside_ab, beside_bc, beside_ca, height;
  dot(from_a, n.cross(ab), beside_ab);
  dot(from_b, n.cross(bc), beside_bc);
  dot(from_c, n.cross(ca), beside_ca);
  dot(from_a, n, height);
  const LaneMask inside = (beside_ab >= 0.) & (beside_bc >= 0.) & (beside_ca >= 0.);
  squared = inside ? height * height * (1 / nn) : squared;
}

HOOKE_INLINE void try_face(const BoundingVolumeTree::Face& face, long long place, const LaneVec& x,
                           Lanes& best, LaneMask& places) {
  Lanes squared;
  distances_to(face, x, squared);
  const LaneMask closer = squared < best;
  best = closer ? squared : best;
  places = closer ? place + LaneMask{} : places;
}

/// One walk for four points: down wherever one of them may come closer, first where they are closer together.
HOOKE_SIMD void find_closest(const BoundingVolumeTree::Node* nodes, const BoundingVolumeTree::Face* faces,
                             int first_place, FourPoints& four) {
  LaneVec x;
  Lanes best, near, far;
  LaneMask places = {};
  load(four.points, lane_count, x);
  load(four.squared_distance, best);
  try_face(faces[first_place], first_place, x, best, places);
  int stack[BoundingVolumeTree::max_depth];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const int i = stack[--size];
    const BoundingVolumeTree::Node& node = nodes[i];
    distances_to(node.box, x, near);
    if (!any(near < best)) continue;
    if (node.count > 0) {
      for (int k = node.first_or_right; k < node.first_or_right + node.count; ++k)
        try_face(faces[k], k, x, best, places);
      continue;
    }
    const int left = i + 1, right = node.first_or_right;
    distances_to(nodes[left].box, x, near);
    distances_to(nodes[right].box, x, far);
    const bool left_first = sum_of(near) <= sum_of(far);
    const bool wants_left = any(near < best), wants_right = any(far < best);
    if (left_first && wants_right) stack[size++] = right;
    if (wants_left) stack[size++] = left;
    if (!left_first && wants_right) stack[size++] = right;
  }
  store(best, four.squared_distance);
  std::memcpy(four.place, &places, sizeof(places));
}

}  // namespace

ClosestPoint closest_point(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  ClosestPoint best;
  const Vec3 n = (b - a).cross(c - a);
  const double nn = n.squaredNorm();
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  if (nn > least_squared_area * longest * longest) {
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

BoundingVolumeTree::BoundingVolumeTree(const Mat3X& points, const std::vector<Triangle>& faces)
    : faces_(faces.size()),
      place_(faces.size()),
      nodes_(faces.empty() ? 1 : node_counts(faces.size(), leaf_size)[0]) {
  std::vector<Centre> centres(faces.size());
  parallel_for(faces.size(), block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const auto& [a, b, c] = faces[f];
      const Face face{{points.col(a), points.col(b), points.col(c)}, faces[f], static_cast<int>(f)};
      centres[f] = {face.box().center(), face.id};
    }
  });
  build_all(centres);
  parallel_for(faces.size(), block, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      const auto f = static_cast<size_t>(centres[k].face);
      const auto& [a, b, c] = faces[f];
      place_[f] = static_cast<int>(k);
      faces_[k] = {{points.col(a), points.col(b), points.col(c)}, faces[f], centres[k].face};
    }
  });
  enclose_nodes();
}

/// Makes a leaf, or halves the range along the longest side of the centres' box and returns true.
bool BoundingVolumeTree::divide(const Range& range, std::vector<Centre>& centres, Range& left, Range& right) {
  Node& node = nodes_[range.node];
  const size_t count = range.end - range.begin;
  if (count <= leaf_size) {
    node.first_or_right = static_cast<int>(range.begin);
    node.count = static_cast<int>(count);
    return false;
  }
  Box spread;
  for (size_t k = range.begin; k < range.end; ++k) spread.extend(centres[k].point);
  Eigen::Index axis;
  spread.sizes().maxCoeff(&axis);
  const size_t middle = range.begin + count / 2;
  const auto at = [&](size_t k) { return centres.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(range.begin), at(middle), at(range.end), [axis](const Centre& a, const Centre& b) {
    return a.point[axis] < b.point[axis] || (a.point[axis] == b.point[axis] && a.face < b.face);
  });
  left = {range.begin, middle, range.node + 1};
  right = {middle, range.end, range.node + 1 + node_counts(count / 2, leaf_size)[0]};
  node.first_or_right = static_cast<int>(right.node);
  return true;
}

void BoundingVolumeTree::build(const Range& range, std::vector<Centre>& centres) {
  Range left, right;
  if (!divide(range, centres, left, right)) return;
  build(left, centres);
  build(right, centres);
}

/// The top of the tree level by level, then what hangs below, each in parallel: the place of every node is
/// known beforehand.
void BoundingVolumeTree::build_all(std::vector<Centre>& centres) {
  constexpr int top_levels = 7;
  std::vector<Range> ranges = {{0, centres.size(), 0}};
  for (int level = 0; level < top_levels; ++level) {
    std::vector<Range> halves(2 * ranges.size(), Range{0, 0, 0});
    parallel_for(ranges.size(), 1, [&](size_t begin, size_t end) {
      for (size_t r = begin; r < end; ++r) divide(ranges[r], centres, halves[2 * r], halves[2 * r + 1]);
    });
    std::erase_if(halves, [](const Range& r) { return r.begin == r.end; });
    ranges = std::move(halves);
  }
  parallel_for(ranges.size(), 1, [&](size_t begin, size_t end) {
    for (size_t r = begin; r < end; ++r) build(ranges[r], centres);
  });
}

/// Children stand behind their parents.
void BoundingVolumeTree::enclose_nodes() {
  for (size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    for (const Face& face : faces_of(i)) node.box.extend(face.box());
    if (node.count > 0 || empty()) continue;
    node.box.extend(nodes_[i + 1].box);
    node.box.extend(nodes_[static_cast<size_t>(node.first_or_right)].box);
  }
}

void BoundingVolumeTree::closest(std::span<const Vec3> points, std::span<const int> hints,
                                 std::span<ClosestPoint> results) const {
  if (empty()) return std::fill(results.begin(), results.end(), closest(Vec3::Zero()));
  for (size_t first = 0; first < points.size(); first += lane_count) {
    const size_t count = std::min(lane_count, points.size() - first);
    FourPoints four;
    for (size_t i = 0; i < lane_count; ++i) {
      const size_t k = first + std::min(i, count - 1);
      for (size_t d = 0; d < 3; ++d)
        four.points[d * lane_count + i] = points[k][static_cast<Eigen::Index>(d)];
      four.place[i] = 0;
      four.squared_distance[i] = std::numeric_limits<double>::infinity();
    }
    const int hint = hints[first];
    find_closest(nodes_.data(), faces_.data(), hint < 0 ? 0 : place_[static_cast<size_t>(hint)], four);
    for (size_t i = 0; i < count; ++i) {
      const Face& f = faces_[static_cast<size_t>(four.place[i])];
      results[first + i] = closest_point(points[first + i], f.corners[0], f.corners[1], f.corners[2]);
      results[first + i].face = f.id;
    }
  }
}

ClosestPoint BoundingVolumeTree::closest(const Vec3& x, int hint) const {
  ClosestPoint best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  if (empty()) return best;
  if (hint >= 0) try_face(x, face(hint), best);

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
      for (const Face& face : faces_of(static_cast<size_t>(visit.node)))
        if (squared_distance(face.box(), x) <= best.squared_distance) try_face(x, face, best);
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
