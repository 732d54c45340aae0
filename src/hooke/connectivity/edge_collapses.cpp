#include "hooke/connectivity/edge_collapses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "hooke/connectivity/edge_flips.h"
#include "hooke/connectivity/edge_queue.h"
#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

/// The three columns of a face in a CollapsedRing.
Triangle corners_of(size_t face) {
  const int first = static_cast<int>(3 * face);
  return {first, first + 1, first + 2};
}

}  // namespace

LocalShape worst_about(const WorkingMesh& m, int half_edge) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.vertices.positions.points;
  const Mat3X& N = m.vertices.positions.normals;
  LocalShape worst;
  for (int end : {t.from(half_edge), t.to(half_edge)})
    for (int outgoing : t.outgoing(end)) {
      const int face = outgoing / 3;
      worst.add_face(X, N, t.faces()[face], t.wedges()[face]);
      for (int h : {outgoing, HalfedgeMesh::next(outgoing), HalfedgeMesh::previous(outgoing)}) {
        const int from = t.from(h), to = t.to(h);
        worst.add_edge(X, N, {from, to}, {t.wedge(h), t.wedge(HalfedgeMesh::next(h))},
                       target_length(m, from, to));
        if (!t.is_feature_edge(h))
          worst.add_fold(cosine_between(X, t.faces()[face], t.faces()[t.twin(h) / 3]));
      }
    }
  return worst;
}

CollapsedRing::CollapsedRing(const WorkingMesh& mesh, int half_edge, int stays)
    : m_(mesh), t_(mesh.halfedges), stays_(stays) {
  const int twin = t_.twin(half_edge);
  const int dying[] = {half_edge / 3, twin < 0 ? -1 : twin / 3};
  for (int v : {t_.from(half_edge), t_.to(half_edge)})
    for (int outgoing : t_.outgoing(v))
      if (outgoing / 3 != dying[0] && outgoing / 3 != dying[1])
        add_face(outgoing, t_.wedge_after_collapse(half_edge, stays, outgoing));
  for (Face& face : faces_) face.next = face_after(face);
  copy_corners();
}

void CollapsedRing::add_face(int outgoing, int wedge) {
  const int next = HalfedgeMesh::next(outgoing), previous = HalfedgeMesh::previous(outgoing);
  Face face{.outgoing = outgoing,
            .wedge = wedge,
            .first_target = target_length(m_, stays_, t_.from(next)),
            .last_target = target_length(m_, stays_, t_.from(previous)),
            .has_neighbour = !t_.is_feature_edge(next),
            .neighbour_area = Vec3::Zero(),
            .next = -1};
  if (face.has_neighbour) {
    const size_t across = t_.twin(next) / 3;
    face.neighbour_area = doubled_area_vector(m_.vertices.positions.points, t_.faces()[across]);
  }
  faces_.push_back(face);
}

/// The next face counter-clockwise around the remaining vertex, also across two edges that the collapse
/// merges.
int CollapsedRing::face_after(const Face& face) const {
  const int last = HalfedgeMesh::previous(face.outgoing);
  const auto found =
      std::ranges::find_if(faces_, [&](const Face& other) { return t_.to(other.outgoing) == t_.from(last); });
  if (found == faces_.end() || t_.is_crease(last) || t_.is_crease(found->outgoing)) return -1;
  return static_cast<int>(found - faces_.begin());
}

void CollapsedRing::copy_corners() {
  const auto columns = static_cast<Eigen::Index>(3 * faces_.size());
  points_.resize(3, columns);
  normals_.resize(3, columns);
  areas_.resize(faces_.size());
  for (size_t f = 0; f < faces_.size(); ++f) {
    const int next = HalfedgeMesh::next(faces_[f].outgoing),
              previous = HalfedgeMesh::previous(faces_[f].outgoing);
    const auto [first, second, third] = corners_of(f);
    points_.col(second) = m_.vertices.positions.points.col(t_.from(next));
    points_.col(third) = m_.vertices.positions.points.col(t_.from(previous));
    normals_.col(first) =
        m_.vertices.positions.normals.col(faces_[f].wedge);  // set_position() sets at most two wedges
    normals_.col(second) = m_.vertices.positions.normals.col(t_.wedge(next));
    normals_.col(third) = m_.vertices.positions.normals.col(t_.wedge(previous));
  }
}

void CollapsedRing::set_position(const SurfacePosition& position) {
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Triangle corners = corners_of(f);
    points_.col(corners[0]) = position.point;
    if (faces_[f].wedge == stays_) normals_.col(corners[0]) = position.normal;
    if (faces_[f].wedge == position.other_wedge) normals_.col(corners[0]) = position.other_normal;
    areas_[f] = doubled_area_vector(points_, corners);
  }
}

LocalShape CollapsedRing::worst(const SurfacePosition& position) {
  set_position(position);
  LocalShape worst;
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const Triangle corners = corners_of(f);
    const Edge first = {corners[0], corners[1]}, last = {corners[0], corners[2]};
    worst.add_face(points_, normals_, corners, corners);
    worst.add_edge(points_, normals_, first, first, face.first_target);
    worst.add_edge(points_, normals_, last, last, face.last_target);
    if (face.has_neighbour) worst.add_fold(cosine_between(areas_[f], face.neighbour_area));
    if (face.next >= 0) worst.add_fold(cosine_between(areas_[f], areas_[face.next]));
  }
  return worst;
}

double CollapsedRing::distance(const Vec3& x) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Triangle t = corners_of(f);
    smallest = std::min(
        smallest, closest_point(x, points_.col(t[0]), points_.col(t[1]), points_.col(t[2])).squared_distance);
  }
  return std::sqrt(smallest);
}

namespace {

class CollapseTest {
 public:
  CollapseTest(const WorkingMesh& mesh, int half_edge, const CollapseOptions& options)
      : m_(mesh),
        t_(mesh.halfedges),
        options_(options),
        h_(half_edge),
        a_(t_.from(half_edge)),
        b_(t_.to(half_edge)) {}

  std::optional<Collapse> run() const {
    if (!is_removable(a_) && !is_removable(b_)) return std::nullopt;
    if (!keeps_valences() || !may_remove_curve_edge(m_, h_) || !t_.may_collapse(h_)) return std::nullopt;
    const Rings rings = {t_.neighbours(a_), t_.neighbours(b_)};
    const int stays = staying_end(), goes = stays == a_ ? b_ : a_;
    const SurfacePosition here(m_.vertices.positions, stays);
    const Vec3 displacement = m_.vertices.positions.points.col(goes) - here.point;
    std::optional<CollapsedRing> ring;
    std::optional<ShapeLimits> looser;
    for (double fraction : candidate_fractions(stays, goes)) {
      if (leaves_long_edges(rings, stays, here.point + fraction * displacement)) continue;
      if (!ring) ring.emplace(m_, h_, stays);
      const SurfacePosition there =
          fraction > 0 ? m_.retraction.moved(m_.vertices.positions, stays, fraction * displacement) : here;
      if (is_fair(*ring, there, looser)) return Collapse{h_, stays, there};
    }
    return std::nullopt;
  }

  bool allows(int stays, const SurfacePosition& there) const {
    if (!keeps_valences() || !t_.keeps_topology(h_)) return false;
    if (leaves_long_edges({t_.neighbours(a_), t_.neighbours(b_)}, stays, there.point)) return false;
    CollapsedRing ring(m_, h_, stays);
    std::optional<ShapeLimits> looser;
    return is_fair(ring, there, looser);
  }

 private:
  struct Rings {
    SmallIntList a, b;  // neighbours of the two ends
  };

  Freedom freedom(int v) const { return m_.vertices.constraints.freedom[v]; }

  bool is_removable(int v) const {
    if (freedom(v) == Freedom::fixed) return false;
    if (freedom(v) == Freedom::surface && !t_.on_boundary(v)) return true;
    return t_.is_feature_edge(h_);
  }

  /// Of the vertices opposite the edge: does one satisfy the predicate?
  bool any_opposite(const auto& is_such) const {
    return std::ranges::any_of(std::array{h_, t_.twin(h_)}, [&](int half_edge) {
      return half_edge >= 0 && is_such(corner_valence(m_, HalfedgeMesh::previous(half_edge)));
    });
  }

  /// Would an opposite corner have fewer edges than its target?
  bool takes_from_corner() const {
    return any_opposite([](const CornerValence& v) { return v.target > 0 && !v.may_lose(0); });
  }

  /// Is the valence within its limit, and do the opposite corners keep their target counts? With a very short
  /// edge, as in a strip narrower than the target length, they may have one edge less: a vertex in the middle
  /// is worse there.
  bool keeps_valences() const {
    constexpr double very_short = .5;  // over the target length
    if (valence_after(m_, h_) > options_.valence) return false;
    if (!takes_from_corner()) return true;
    return relative_length(m_, h_) < very_short &&
           !any_opposite([](const CornerValence& v) { return !v.may_lose(1); });
  }

  /// `looser`: the loosened limits, once they are known.
  bool is_fair(CollapsedRing& ring, const SurfacePosition& there, std::optional<ShapeLimits>& looser) const {
    const LocalShape after = ring.worst(there);
    if (takes_from_corner() && after.cotangent >= worst_about(m_, h_).cotangent) return false;
    if (!is_within(after, options_.limits)) {
      if (!looser) looser = looser_limits();
      if (!is_within(after, *looser)) return false;
    }
    return keeps_distance(ring);
  }

  /// The remaining vertex: the more constrained end, else the older one.
  int staying_end() const {
    const auto rank = [&](int v) {
      const int origin = m_.vertices.previous_ids[v];
      return std::tuple(is_removable(v), freedom(v) == Freedom::surface && !t_.on_boundary(v), origin < 0,
                        origin < 0 ? v : origin);
    };
    return rank(a_) < rank(b_) ? a_ : b_;
  }

  /// Candidate positions of the remaining vertex, as fractions of the vector to the other end.
  std::span<const double> candidate_fractions(int stays, int goes) const {
    static constexpr double anywhere[] = {.5, 0, 1}, nowhere[] = {0};
    const bool alike = is_removable(stays) && freedom(stays) == freedom(goes) &&
                       t_.on_boundary(stays) == t_.on_boundary(goes);
    return alike ? std::span<const double>(anywhere) : std::span<const double>(nowhere);
  }

  /// The longest edge over its target length, if the remaining vertex were at the point.
  double longest_edge(const Rings& rings, int stays, const Vec3& point) const {
    double longest = 0;
    for (const SmallIntList* ring : {&rings.a, &rings.b})
      for (int v : *ring)
        if (v != a_ && v != b_) longest = std::max(longest, length(point, v) / target_length(m_, stays, v));
    return longest;
  }

  double length(const Vec3& point, int v) const {
    return (m_.vertices.positions.points.col(v) - point).norm();
  }

  /// Would an edge become longer than allowed, and longer than every edge at the ends is now?
  bool leaves_long_edges(const Rings& rings, int stays, const Vec3& point) const {
    const double longest = longest_edge(rings, stays, point);
    if (longest <= options_.longest) return false;
    const auto has_as_long = [&](int end, const SmallIntList& ring) {
      return std::ranges::any_of(ring, [&](int v) {
        return length(m_.vertices.positions.points.col(end), v) / target_length(m_, end, v) >= longest;
      });
    };
    return !has_as_long(a_, rings.a) && !has_as_long(b_, rings.b);
  }

  bool keeps_distance(const CollapsedRing& ring) const {
    const double limit = options_.distance * target_length(m_, a_, b_);
    return ring.distance(m_.vertices.positions.points.col(a_)) <= limit &&
           ring.distance(m_.vertices.positions.points.col(b_)) <= limit;
  }

  /// The limits loosened to the present worst values; not that of alignment if the options insist on it.
  ShapeLimits looser_limits() const {
    ShapeLimits looser = loosened(options_.limits, worst_about(m_, h_));
    if (options_.insist_on_alignment) looser.alignment = options_.limits.alignment;
    return looser;
  }

  const WorkingMesh& m_;
  const HalfedgeMesh& t_;
  const CollapseOptions& options_;
  int h_, a_, b_;
};

}  // namespace

int valence_after(const WorkingMesh& m, int half_edge) {
  const HalfedgeMesh& t = m.halfedges;
  return t.valence(t.from(half_edge)) + t.valence(t.to(half_edge)) - (t.twin(half_edge) < 0 ? 3 : 4);
}

std::optional<Collapse> find_collapse(const WorkingMesh& m, int half_edge, const CollapseOptions& options) {
  return CollapseTest(m, half_edge, options).run();
}

bool may_collapse_to(const WorkingMesh& m, int half_edge, int stays, const SurfacePosition& position,
                     const CollapseOptions& options) {
  return CollapseTest(m, half_edge, options).allows(stays, position);
}

void make_collapse(WorkingMesh& m, const Collapse& c) {
  const int curve = m.halfedges.is_feature_edge(c.half_edge) ? curve_of(m, c.half_edge).curve : -1;
  if (curve >= 0) --m.curve_edges.present[curve];
  m.halfedges.collapse(c.half_edge, c.stays);
  c.position.write_to(m.vertices.positions, c.stays);
}

int collapse_edge(WorkingMesh& m, int half_edge, const CollapseOptions& options) {
  const std::optional<Collapse> collapse = find_collapse(m, half_edge, options);
  if (!collapse) return -1;
  make_collapse(m, *collapse);
  return collapse->stays;
}

bool may_remove_curve_edge(const WorkingMesh& m, int half_edge) {
  if (!m.halfedges.is_feature_edge(half_edge)) return true;
  const int curve = curve_of(m, half_edge).curve;
  if (curve < 0) return true;
  const size_t c = curve;
  return m.curve_edges.present[c] > m.curve_edges.target[c];
}

// Passes.

namespace {

/// Maximum number of edges tested in parallel, all against the mesh before their collapses.
constexpr size_t collapse_batch_size = 1024;

std::vector<std::optional<Collapse>> find_collapses(const WorkingMesh& m, const std::vector<int>& edges,
                                                    const CollapseOptions& options) {
  std::vector<std::optional<Collapse>> collapses(edges.size());
  parallel_for(edges.size(), 16, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) collapses[i] = find_collapse(m, edges[i], options);
  });
  return collapses;
}

}  // namespace

int collapse_short_edges(WorkingMesh& m, const CollapseOptions& options) {
  int collapses = 0;
  EdgeQueue queue(m.halfedges, [&](int h) { return options.shortest - relative_length(m, h); });
  const auto next_edges = [&] {
    return queue.pop_apart(collapse_batch_size,
                           [&](int h) { return valence_after(m, h) <= options.valence; });
  };
  for (std::vector<int> edges = next_edges(); !edges.empty(); edges = next_edges())
    for (const std::optional<Collapse>& collapse : find_collapses(m, edges, options)) {
      // Other edges of its curve may have collapsed.
      if (!collapse || !may_remove_curve_edge(m, collapse->half_edge)) continue;
      make_collapse(m, *collapse);
      queue.push_around(collapse->stays);
      ++collapses;
    }
  m.retraction.count();
  return collapses;
}

namespace {

/// Where the usual limits allow no collapse.
CollapseOptions looser_options() {
  return {.longest = 2,
          .valence = 12,
          .limits = {.sagitta = .5, .cotangent = cotangent_of(2)},
          .insist_on_alignment = true};
}

/// Collapses the first edge for which it is allowed, of the face or at its corners.
bool collapse_about(WorkingMesh& m, int face, const CollapseOptions& options) {
  const HalfedgeMesh& t = m.halfedges;
  for (int h = 3 * face; h < 3 * face + 3; ++h)
    if (collapse_edge(m, h, options) >= 0) return true;
  for (int corner : t.faces()[face])
    for (int h : t.outgoing(corner))
      if (collapse_edge(m, h, options) >= 0) return true;
  return false;
}

}  // namespace

int collapse_folded_faces(WorkingMesh& m) {
  const CollapseOptions options = looser_options();
  const HalfedgeMesh& t = m.halfedges;
  const auto is_folded = [&](int f) {
    return !m.vertices.constraints.is_frozen(t.faces()[f]) &&
           face_alignment(m.vertices.positions.points, m.vertices.positions.normals, t.faces()[f],
                          t.wedges()[f]) < options.limits.alignment;
  };
  const int count = t.half_edge_count() / 3;
  int collapses = 0;
  for (int f = 0; f < count; ++f)
    collapses += !t.is_removed(f) && is_folded(f) && collapse_about(m, f, options);
  m.retraction.count();
  return collapses;
}

}  // namespace hooke
