#include "hooke/geometry/closest_faces.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "hooke/core/simd.h"
#include "hooke/geometry/aabb_tree.h"

namespace hooke {
namespace {

// Distances of four points at a time to one face, bitwise equal to those of closest_point().

/// Factor that keeps a lower bound valid under rounding.
constexpr double safety_factor = 1 - 1e-9;

/// A face with everything that does not depend on the query point.
struct PreparedFace {
  PreparedFace() = default;
  PreparedFace(const AabbTree::Face& face, size_t its_index)
      : corners(face.corners), index(static_cast<long long>(its_index)) {
    const auto& [a, b, c] = corners;
    normal = (b - a).cross(c - a);
    double longest = 0;
    for (size_t k = 0; k < 3; ++k) {
      edges[k] = corners[(k + 1) % 3] - corners[k];
      squared_edges[k] = edges[k].squaredNorm();
      longest = std::max(longest, squared_edges[k]);
      if (!(squared_edges[k] > 0)) squared_edges[k] = 1;
      inward[k] = normal.cross(edges[k]);
    }
    const double nn = normal.squaredNorm();
    has_area = nn > min_triangle_squared_area * longest * longest;
    squared_normal = has_area ? nn : 1;
    if (!(nn > min_for_bounds * longest * longest)) return;
    height_weight = 1 / nn;
    inward_weight = height_weight / longest;  // for the longest edge, the smallest of the three
  }

  /// Minimum of the same ratio for a bound: thinner triangles could get too large a bound from the rounding
  /// of their normal.
  static constexpr double min_for_bounds = 1e-4;

  std::array<Vec3, 3> corners;
  long long index = 0;
  Vec3 normal;
  std::array<Vec3, 3> edges;  // edge vectors from corner k to corner k + 1
  std::array<double, 3> squared_edges;
  std::array<Vec3, 3> inward;  // in the plane, perpendicular to edge k, pointing inside
  bool has_area = false;
  double squared_normal = 1;
  // Factors from squared products to squared distances; 0 where the result would be unreliable.
  double inward_weight = 0;
  double height_weight = 0;
};

/// Sums in Eigen's order, so that the results equal those of closest_point().
HOOKE_INLINE void dot(const LaneVec& a, const Vec3& b, Lanes& product) {
  product = a.x * b[0] + a.y * b[1] + a.z * b[2];
}
HOOKE_INLINE void difference(const LaneVec& x, const Vec3& a, LaneVec& d) {
  d = {x.x - a[0], x.y - a[1], x.z - a[2]};
}

HOOKE_INLINE void distances_to_edge(const PreparedFace& face, size_t k, const LaneVec& x,
                                    const LaneVec& from_corner, Lanes& squared) {
  const Vec3 &a = face.corners[k], &d = face.edges[k];
  const Lanes zero = {}, one = zero + 1.;
  Lanes t;
  dot(from_corner, d, t);
  t /= zero + face.squared_edges[k];
  t = t > zero ? t : zero;
  t = t < one ? t : one;
  const LaneVec difference_vector = {x.x - (a[0] + t * d[0]), x.y - (a[1] + t * d[1]),
                                     x.z - (a[2] + t * d[2])};
  dot(difference_vector, difference_vector, squared);
}

/// Updates the nearest face of four points. Among faces at the same distance the first one wins.
HOOKE_INLINE void test_face(const PreparedFace& face, const LaneVec& x, Lanes& best, LaneMask& indices) {
  std::array<LaneVec, 3> from;
  std::array<Lanes, 3> inward;
  Lanes height, outside = {};
  for (size_t k = 0; k < 3; ++k) {
    difference(x, face.corners[k], from[k]);
    dot(from[k], face.inward[k], inward[k]);
    outside = outside < inward[k] ? outside : inward[k];
  }
  dot(from[0], face.normal, height);
  const Lanes bound =
      (height * height * face.height_weight + outside * outside * face.inward_weight) * safety_factor;
  const LaneMask promising = bound <= best;
  if (!any(promising)) return;

  const LaneMask everywhere = ~LaneMask{}, nowhere = {};
  const LaneMask inside =
      ((inward[0] >= 0.) & (inward[1] >= 0.) & (inward[2] >= 0.)) & (face.has_area ? everywhere : nowhere);
  Lanes squared = height * height / (Lanes{} + face.squared_normal);
  Lanes to_edge = Lanes{} + std::numeric_limits<double>::infinity(), other;
  if (any(promising & ~inside)) {
    distances_to_edge(face, 0, x, from[0], to_edge);
    distances_to_edge(face, 1, x, from[1], other);
    to_edge = other < to_edge ? other : to_edge;
    distances_to_edge(face, 2, x, from[2], other);
    to_edge = other < to_edge ? other : to_edge;
  }
  squared = inside ? squared : to_edge;
  const LaneMask closer = (squared < best) | ((squared == best) & (indices > face.index));
  best = closer ? squared : best;
  indices = closer ? face.index + LaneMask{} : indices;
}

using Box = AabbTree::Box;
using Face = AabbTree::Face;

/// Squared distances of four points to a box.
HOOKE_INLINE void distances_to(const Box& box, const LaneVec& x, Lanes& squared) {
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

/// The same where the slab is farther away.
HOOKE_INLINE void raise_to_distances_to(const AabbTree::Slab& slab, const LaneVec& x, Lanes& squared) {
  const Lanes zero = {};
  LaneVec d;
  difference(x, slab.centre, d);
  Lanes height;
  dot(d, slab.across, height);
  const Lanes to_centre = (d.x > zero ? d.x : -d.x) + (d.y > zero ? d.y : -d.y) + (d.z > zero ? d.z : -d.z);
  Lanes gap = (height > zero ? height : -height) - slab.half_width - slab_rounding * to_centre;
  gap = gap > zero ? gap : zero;
  gap *= gap;
  squared = squared > gap ? squared : gap;
}

/// Lower bounds of the squared distances of four points to the faces of a node.
HOOKE_INLINE void distances_to_node(const AabbTree& tree, size_t node, const LaneVec& x, Lanes& squared) {
  distances_to(tree.boxes()[node], x, squared);
  if (!tree.slabs().empty()) raise_to_distances_to(tree.slabs()[node], x, squared);
}

}  // namespace

/// Query points in lanes, with the nearest face found so far.
struct NearestFaceSearch::Packet {
  static constexpr size_t max_points = 160;

  size_t groups = 0;  // of four points; the last one is padded with its first point
  std::array<double, 3 * max_points> points;
  std::array<double, max_points> squared_distance;
  std::array<long long, max_points> index;
  Box box;

  explicit Packet(std::span<const Vec3> given) : groups(padded_to_lanes(given.size()) / lane_count) {
    for (size_t i = 0; i < groups * lane_count; ++i) {
      const Vec3& p = given[i < given.size() ? i : i / lane_count * lane_count];
      for (size_t d = 0; d < 3; ++d)
        points[(i / lane_count * 3 + d) * lane_count + i % lane_count] = p[static_cast<Eigen::Index>(d)];
      squared_distance[i] = std::numeric_limits<double>::infinity();
      index[i] = -1;
      box.extend(p);
    }
  }

  double farthest() const {
    return *std::max_element(squared_distance.begin(),
                             squared_distance.begin() + static_cast<std::ptrdiff_t>(groups * lane_count));
  }
  void store(std::span<NearestFace> results) const {
    for (size_t i = 0; i < results.size(); ++i) results[i] = {squared_distance[i], index[i]};
  }
};

/// Candidate faces and their boxes, coordinate by coordinate.
struct NearestFaceSearch::Candidates {
  static constexpr size_t max_count = 192;

  std::vector<PreparedFace> faces;
  bool too_many = false;
  std::array<std::array<double, max_count>, 3> low, high;

  void clear() {
    faces.clear();
    too_many = false;
  }

  void add(const Face& face, size_t index, const Box& box) {
    const size_t k = faces.size();
    too_many = too_many || k == max_count;
    if (too_many) return;
    faces.emplace_back(face, index);
    for (size_t d = 0; d < 3; ++d) {
      low[d][k] = box.min()[static_cast<Eigen::Index>(d)];
      high[d][k] = box.max()[static_cast<Eigen::Index>(d)];
    }
  }

  /// Pads the last lanes with boxes at infinity.
  void pad() {
    for (size_t d = 0; d < 3; ++d)
      for (size_t k = faces.size(); k < padded_to_lanes(faces.size()); ++k)
        low[d][k] = high[d][k] = std::numeric_limits<double>::infinity();
  }
};

namespace {

using Packet = NearestFaceSearch::Packet;
using Candidates = NearestFaceSearch::Candidates;

HOOKE_INLINE void distances_between(const std::array<double, 3>& low, const std::array<double, 3>& high,
                                    const Candidates& candidates, size_t first, Lanes& squared) {
  squared = Lanes{};
  for (size_t d = 0; d < 3; ++d) {
    Lanes other_low, other_high;
    load(&candidates.low[d][first], other_low);
    load(&candidates.high[d][first], other_high);
    const Lanes zero = {}, below = other_low - high[d], above = low[d] - other_high;
    Lanes gap = below > above ? below : above;
    gap = gap > zero ? gap : zero;
    squared += gap * gap;
  }
}

HOOKE_INLINE double max_of(const Lanes& x) {
  return std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
}

/// Tests the faces whose boxes overlap that of the four points, then those that may still be closer.
HOOKE_SIMD void test_all(const Candidates& candidates, Packet& packet) {
  std::array<double, Candidates::max_count> distances;
  const size_t count = candidates.faces.size();
  for (size_t g = 0; g < packet.groups; ++g) {
    LaneVec x;
    Lanes best;
    LaneMask indices;
    load(&packet.points[g * 3 * lane_count], lane_count, x);
    load(&packet.squared_distance[g * lane_count], best);
    std::memcpy(&indices, &packet.index[g * lane_count], sizeof(indices));
    std::array<double, 3> low, high;
    for (size_t d = 0; d < 3; ++d) {
      const double* const t = &packet.points[(g * 3 + d) * lane_count];
      low[d] = std::min(std::min(t[0], t[1]), std::min(t[2], t[3]));
      high[d] = std::max(std::max(t[0], t[1]), std::max(t[2], t[3]));
    }
    Lanes smallest = Lanes{} + std::numeric_limits<double>::infinity();  // over the boxes that do not overlap
    for (size_t k = 0; k < count; k += lane_count) {
      Lanes squared;
      distances_between(low, high, candidates, k, squared);
      squared *= safety_factor;
      store(squared, &distances[k]);
      const LaneMask meets = squared <= 0.;
      smallest = (meets | (squared > smallest)) ? smallest : squared;
      if (!any(meets)) continue;
      for (size_t i = 0; i < lane_count; ++i)
        if (meets[i]) test_face(candidates.faces[k + i], x, best, indices);
    }
    double farthest = max_of(best);
    for (size_t k = 0; k < count && any(smallest <= farthest); k += lane_count) {
      Lanes squared;
      load(&distances[k], squared);
      farthest = max_of(best);
      const LaneMask near = (squared > 0.) & (squared <= farthest);
      if (!any(near)) continue;
      for (size_t i = 0; i < std::min(lane_count, count - k); ++i)
        if (near[i]) test_face(candidates.faces[k + i], x, best, indices);
    }
    store(best, &packet.squared_distance[g * lane_count]);
    std::memcpy(&packet.index[g * lane_count], &indices, sizeof(indices));
  }
}

/// One traversal for four points: descends wherever one of them may get closer, into the closer child first.
HOOKE_SIMD void traverse(const AabbTree& tree, Packet& packet) {
  LaneVec x;
  Lanes best, near, far;
  LaneMask indices;
  load(packet.points.data(), lane_count, x);
  load(packet.squared_distance.data(), best);
  std::memcpy(&indices, packet.index.data(), sizeof(indices));
  size_t stack[AabbTree::max_depth + 1];
  int size = 0;
  stack[size++] = 1;
  while (size > 0) {
    const size_t i = stack[--size];
    distances_to_node(tree, i, x, near);
    if (!any(near * safety_factor <= best)) continue;
    if (tree.is_leaf(i)) {
      const size_t leaf = i - tree.leaf_count();
      for (size_t k = tree.first_face(leaf); k < tree.first_face(leaf + 1); ++k)
        test_face(PreparedFace(tree.faces()[k], k), x, best, indices);
      continue;
    }
    const size_t left = 2 * i, right = left + 1;
    distances_to_node(tree, left, x, near);
    distances_to_node(tree, right, x, far);
    const bool left_first = sum_of(near) <= sum_of(far);
    const bool wants_left = any(near * safety_factor <= best), wants_right = any(far * safety_factor <= best);
    if (left_first && wants_right) stack[size++] = right;
    if (wants_left) stack[size++] = left;
    if (!left_first && wants_right) stack[size++] = right;
  }
  store(best, packet.squared_distance.data());
  std::memcpy(packet.index.data(), &indices, sizeof(indices));
}

}  // namespace

NearestFaceSearch::NearestFaceSearch(const AabbTree& tree)
    : tree_(tree), candidates_(std::make_unique<Candidates>()) {}

NearestFaceSearch::~NearestFaceSearch() = default;

/// Tests the faces whose squared distance to the box of the packet lies in (beyond, within]. Returns false if
/// there are too many to test with each point.
bool NearestFaceSearch::test_candidates(double beyond, double within, Packet& packet) {
  Candidates& candidates = *candidates_;
  candidates.clear();
  const auto distance_to = [&](const Box& box) {
    return box.squaredExteriorDistance(packet.box) * safety_factor;
  };
  tree_.for_each_leaf(
      0, [&](size_t node) { return !candidates.too_many && distance_to(tree_.boxes()[node]) <= within; },
      [&](size_t leaf) {
        for (size_t index = tree_.first_face(leaf); index < tree_.first_face(leaf + 1); ++index) {
          const Face& face = tree_.faces()[index];
          const Box box = face.box();
          const double squared = distance_to(box);
          if (squared > beyond && squared <= within) candidates.add(face, index, box);
        }
      });
  if (candidates.too_many) return false;
  candidates.pad();
  test_all(candidates, packet);
  return true;
}

/// Tests the faces near the box of all points first; this is enough if no nearest face is farther away.
/// Returns false if there are too many candidates.
bool NearestFaceSearch::find_together(Packet& packet) {
  const double near = std::min(expected_, packet.box.sizes().squaredNorm() / 16);
  if (!test_candidates(-1, near, packet)) return false;
  const double farthest = packet.farthest();
  expected_ = 4 * farthest;
  return farthest <= near || test_candidates(near, farthest, packet);
}

void NearestFaceSearch::find(std::span<const Vec3> points, std::span<NearestFace> results) {
  Packet packet(points);
  if (packet.groups == 1) {
    traverse(tree_, packet);
  } else if (!tree_.slabs().empty() || !find_together(packet)) {  // too many boxes overlap that of the packet
    const size_t half = packet.groups / 2 * lane_count;
    find(points.first(half), results.first(half));
    return find(points.subspan(half), results.subspan(half));
  }
  packet.store(results);
}

void NearestFaceSearch::operator()(std::span<const Vec3> points, std::span<NearestFace> results) {
  for (size_t first = 0; first < points.size(); first += Packet::max_points) {
    const size_t count = std::min(Packet::max_points, points.size() - first);
    find(points.subspan(first, count), results.subspan(first, count));
  }
}

}  // namespace hooke
