#include "hooke/integrator/guards.h"

#include <algorithm>
#include <cmath>

#include "hooke/constraints/junction_curves.h"
#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {
namespace {

constexpr size_t guards_block = 2048;

constexpr int max_halvings = 8;  // of a vertex's displacement, before the vertex stays for this step

/// The indices in [0, count) that pass a test, ascending.
template <typename Test>
std::vector<int> indices_where(size_t count, const Test& test) {
  std::vector<char> passes(count);
  parallel_for(count, guards_block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) passes[i] = test(i);
  });
  std::vector<int> indices;
  for (size_t i = 0; i < count; ++i)
    if (passes[i]) indices.push_back(static_cast<int>(i));
  return indices;
}

double cosine(const Vec3& a, const Vec3& b, double otherwise) {
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0 ? a.dot(b) / lengths : otherwise;
}

Vec3 sum_of_normals(const Mat3X& normals, const Triangle& wedges) {
  return normals.col(wedges[0]) + normals.col(wedges[1]) + normals.col(wedges[2]);
}

// Sufficient tests that most faces and edges pass without a square root and without measuring the state
// before. They keep a margin, so that they never contradict the exact rules.
constexpr double margin = 1e-9;

/// Is the cosine between two vectors, given their product and squared lengths, above the limit?
bool cosine_exceeds(double limit, double product, double square, double other_square) {
  return product > 0 && product * product > limit * limit * (1 + margin) * square * other_square;
}

/// `n` is the doubled area vector of the face.
bool area_and_alignment_within_limit(const ShapeLimits& limits, const Vec3& n_before, const Vec3& n,
                                     const Vec3& normals) {
  const double square = n.squaredNorm();
  return square > limits.area * limits.area * (1 + margin) * n_before.squaredNorm() &&
         cosine_exceeds(limits.alignment, n.dot(normals), square, normals.squaredNorm());
}

bool angles_within_limit(const ShapeLimits& limits, const Mat3X& points, const Triangle& t, const Vec3& n) {
  const Vec3 p = points.col(t[0]), q = points.col(t[1]), r = points.col(t[2]);
  const double a2 = (r - q).squaredNorm(), b2 = (p - r).squaredNorm(), c2 = (q - p).squaredNorm();
  const double cosine =
      .5 *
      (a2 + b2 + c2 - 2 * std::min({a2, b2, c2}));  // of the smallest angle, times the lengths of its edges
  return cosine * cosine < limits.cotangent * limits.cotangent * (1 - margin) * n.squaredNorm();
}

/// Uses (l / 2) tan(theta / 4) <= (l / 2) sin(theta / 2).
bool sagitta_within_limit(const ShapeLimits& limits, double target, const Vec3& edge, double cosine) {
  const double limit = limits.sagitta * (1 - margin) * target;
  return .125 * edge.squaredNorm() * (1 - cosine) < limit * limit;
}

}  // namespace

double Guards::alignment(const SurfacePositions& p, size_t face) const {
  return face_alignment(p.points, p.normals, adjacency_.faces[face], adjacency_.wedges_of_faces()[face]);
}

double Guards::sagitta(const SurfacePositions& p, size_t edge) const {
  return edge_sagitta(p.points, p.normals, adjacency_.edges[edge], adjacency_.wedges_of_edges()[edge]);
}

double Guards::fold(const SurfacePositions& p, size_t edge) const {
  const auto [left, right] = adjacency_.edge_faces[edge];
  if (right < 0) return 1;
  return cosine_between(p.points, adjacency_.faces[left], adjacency_.faces[right]);
}

bool Guards::face_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t f) const {
  const Triangle& t = adjacency_.faces[f];
  const Vec3 n = doubled_area_vector(to.points, t), n_before = doubled_area_vector(from.points, t);
  const Vec3 normals = sum_of_normals(to.normals, adjacency_.wedges_of_faces()[f]);
  const bool angles_are_free = !std::isfinite(limits_.cotangent);
  if (area_and_alignment_within_limit(limits_, n_before, n, normals) &&
      (angles_are_free || angles_within_limit(limits_, to.points, t, n)))
    return false;
  const double before = alignment(from, f);
  return hooke::face_breaks(limits_, .5 * n_before.norm(), .5 * n.norm(), before, cosine(n, normals, 0)) ||
         (!angles_are_free &&
          angle_breaks(limits_, before, max_cotangent(from.points, t), max_cotangent(to.points, t)));
}

bool Guards::fold_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t e) const {
  const auto [left, right] = adjacency_.edge_faces[e];
  if (right < 0) return false;
  const Vec3 n = doubled_area_vector(to.points, adjacency_.faces[left]);
  const Vec3 m = doubled_area_vector(to.points, adjacency_.faces[right]);
  if (cosine_exceeds(limits_.fold, n.dot(m), n.squaredNorm(), m.squaredNorm())) return false;
  const double before = fold(from, e), after = cosine(n, m, 1);
  return adjacency_.is_crease(static_cast<int>(e)) ? crease_fold_breaks(limits_, before, after)
                                                   : hooke::fold_breaks(limits_, before, after);
}

bool Guards::edge_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t e) const {
  const auto& [a, b] = adjacency_.edges[e];
  const auto& [wedge, other_wedge] = adjacency_.wedges_of_edges()[e];
  const double target = targets_.edge[e];
  return (!sagitta_within_limit(limits_, target, to.points.col(b) - to.points.col(a),
                                to.normals.col(wedge).dot(to.normals.col(other_wedge))) &&
          sagitta_breaks(limits_, target, sagitta(from, e), sagitta(to, e))) ||
         fold_breaks(from, to, e);
}

void Guards::add_corners(int face, std::vector<int>& vertices) const {
  const Triangle& t = adjacency_.faces[face];
  vertices.insert(vertices.end(), t.begin(), t.end());
}

/// The ends of the edge and, for a fold, all corners of its two faces.
void Guards::add_vertices_around(int edge, bool folds, std::vector<int>& vertices) const {
  const size_t e = edge;
  vertices.insert(vertices.end(), adjacency_.edges[e].begin(), adjacency_.edges[e].end());
  if (!folds) return;
  for (int f : adjacency_.edge_faces[e]) add_corners(f, vertices);
}

std::vector<int> Guards::offenders(const SurfacePositions& from, const SurfacePositions& to) const {
  std::vector<int> vertices;
  for (int f : indices_where(adjacency_.faces.size(), [&](size_t f) { return face_breaks(from, to, f); }))
    add_corners(f, vertices);
  for (int e : indices_where(adjacency_.edges.size(), [&](size_t e) { return edge_breaks(from, to, e); }))
    add_vertices_around(e, fold_breaks(from, to, e), vertices);
  sort_unique(vertices);
  return vertices;
}

std::vector<int> Guards::offenders_around(const SurfacePositions& from, const SurfacePositions& to,
                                          const std::vector<int>& moved) const {
  std::vector<int> vertices;
  std::vector<int> edges;  // of the faces around: those opposite a moved vertex fold too
  for (int f : sorted_union(adjacency_.vertex_faces, moved)) {
    const size_t face = f;
    edges.insert(edges.end(), adjacency_.face_edges[face].begin(), adjacency_.face_edges[face].end());
    if (face_breaks(from, to, face)) add_corners(f, vertices);
  }
  sort_unique(edges);
  for (int e : edges)
    if (edge_breaks(from, to, e)) add_vertices_around(e, fold_breaks(from, to, e), vertices);
  sort_unique(vertices);
  return vertices;
}

std::vector<int> Guards::step(Retraction& retraction, const SurfacePositions& from, Mat3X& displacement,
                              SurfacePositions& to, Stopwatch* stopwatch) const {
  timed(stopwatch, "projection", [&] { retraction.step(from, displacement, to); });
  std::vector<int> offending = offenders(from, to);
  if (offending.empty()) return {};
  const Constraints& constraints = retraction.constraints();
  const IntLists copies = copies_of_junctions(constraints);

  std::vector<unsigned char> halvings(adjacency_.vertex_count, 0);
  std::vector<int> limited;
  while (!offending.empty()) {
    add_sliding_copies(constraints, copies, offending);
    std::vector<int> slowed;
    for (int v : offending) {
      auto u = displacement.col(v);
      if (u.isZero(0)) continue;
      auto& count = halvings[v];
      if (++count == 1) limited.push_back(v);
      if (count > max_halvings)
        u.setZero();
      else
        u *= .5;
      slowed.push_back(v);
    }
    if (slowed.empty()) break;  // none of the offending vertices moves any more
    timed(stopwatch, "projection", [&] { retraction.step(from, displacement, slowed, to); });
    offending = offenders_around(from, to, slowed);
  }
  return limited;
}

std::vector<int> Guards::vertices_at_limits(const SurfacePositions& p) const {
  constexpr double cosine_margin = .02, sagitta_part = .95;
  const auto is_misaligned = [&](size_t f) { return alignment(p, f) < limits_.alignment + cosine_margin; };
  const auto folds = [&](size_t e) {
    return !adjacency_.is_crease(static_cast<int>(e)) && fold(p, e) < limits_.fold + cosine_margin;
  };
  const auto is_at_limit = [&](size_t e) {
    return folds(e) || !(sagitta(p, e) < sagitta_part * limits_.sagitta * targets_.edge[e]);
  };
  std::vector<int> vertices;
  for (int f : indices_where(adjacency_.faces.size(), is_misaligned)) add_corners(f, vertices);
  for (int e : indices_where(adjacency_.edges.size(), is_at_limit))
    add_vertices_around(e, folds(e), vertices);
  sort_unique(vertices);
  return vertices;
}

std::vector<int> Guards::folded_faces(const SurfacePositions& p) const {
  return indices_where(adjacency_.faces.size(),
                       [&](size_t f) { return alignment(p, f) < limits_.alignment; });
}

}  // namespace hooke
