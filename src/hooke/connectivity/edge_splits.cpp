#include "hooke/connectivity/edge_splits.h"

#include "hooke/connectivity/edge_queue.h"
#include "hooke/geometry/face_shape.h"
#include "hooke/integrator/guards.h"

namespace hooke {
namespace {

/// May vertex v, of which the face of h sees `side`, halve that face?
bool may_halve(const AdaptingMesh& m, int h, int v, int side, const SplitOptions& o) {
  const Triangulation& t = m.triangulation;
  const Mat3X& X = m.placement.points;
  const Mat3X& N = m.placement.normals;
  const Triangle old = {t.from(h), t.to(h), t.apex(h)};
  const Triangle seen = {t.side(h), t.side(Triangulation::next(h)), t.side(Triangulation::previous(h))};
  const double least_area = o.area_share * face_shape(X, old).area;
  const double least_alignment = std::min(o.alignment, face_alignment(X, N, old, seen));
  for (size_t k : {0, 1}) {  // the corner that the vertex replaces
    Triangle half = old, half_seen = seen;
    half[k] = v;
    half_seen[k] = side;
    if (face_shape(X, half).area < least_area || face_alignment(X, N, half, half_seen) < least_alignment)
      return false;
  }
  return true;
}

/// The ends of an edge that stands still, because its boundary does.
bool stands_still(const AdaptingMesh& m, int h) {
  const Triangulation& t = m.triangulation;
  const auto fixed = [&](int v) { return m.constraints.freedom[static_cast<size_t>(v)] == Freedom::fixed; };
  return is_rim(t, h) && fixed(t.from(h)) && fixed(t.to(h)) && curve_of(m, h).curve < 0;
}

/// Would a split leave all new edges shorter than the old one? Else splits might go on for ever where the
/// longest edge of a flat face may not be split.
bool shortens(const AdaptingMesh& m, int h) {
  const Triangulation& t = m.triangulation;
  const Mat3X& X = m.placement.points;
  const Vec3 a = X.col(t.from(h)), b = X.col(t.to(h)), middle = .5 * a + .5 * b;
  const auto shorter = [&](int side) {
    return (middle - X.col(t.apex(side))).squaredNorm() < (b - a).squaredNorm();
  };
  return shorter(h) && (t.twin(h) < 0 || shorter(t.twin(h)));
}

}  // namespace

int split_edge(AdaptingMesh& m, int h, const SplitOptions& options, const VertexPlace* middle) {
  Triangulation& t = m.triangulation;
  if (stands_still(m, h)) return -1;
  const int v = add_vertex(m, h, middle), twin = t.twin(h), right = t.is_constrained(h) ? v + 1 : v;
  if (!may_halve(m, h, v, v, options) || (twin >= 0 && !may_halve(m, twin, v, right, options))) {
    drop_vertex(m);
    return -1;
  }
  t.split(h);
  if (const int curve = m.constraints.curve[static_cast<size_t>(v)]; curve >= 0)
    ++m.curve_edges.present[static_cast<size_t>(curve)];
  return v;
}

int split_long_edges(AdaptingMesh& m, const SplitOptions& options) {
  EdgeQueue queue(m.triangulation, [&](int h) { return relative_length(m, h) - options.longest; });
  int splits = 0;
  for (int h = queue.pop(); h >= 0; h = queue.pop()) {
    if (!shortens(m, h)) continue;
    const int v = split_edge(m, h, options);
    if (v < 0) continue;
    queue.push_about(v);
    ++splits;
  }
  m.retraction.count();
  return splits;
}

}  // namespace hooke
