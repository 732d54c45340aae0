#include "hooke/edge_splits.h"

#include "hooke/edge_queue.h"
#include "hooke/face_shape.h"
#include "hooke/guards.h"

namespace hooke {
namespace {

/// May vertex v halve the face of h?
bool may_halve(const AdaptingMesh& m, int h, int v, const SplitOptions& o) {
  const Triangulation& t = m.triangulation;
  const Mat3X& X = m.placement.points;
  const Mat3X& N = m.placement.normals;
  const Triangle old = {t.from(h), t.to(h), t.apex(h)};
  const double least_area = o.area_share * face_shape(X, old).area;
  const double least_alignment = std::min(o.alignment, face_alignment(X, N, old));
  for (const Triangle& half : {Triangle{old[0], v, old[2]}, Triangle{v, old[1], old[2]}})
    if (face_shape(X, half).area < least_area || face_alignment(X, N, half) < least_alignment) return false;
  return true;
}

/// The ends of an edge that stands still, because its boundary does.
bool stands_still(const AdaptingMesh& m, int h) {
  const Triangulation& t = m.triangulation;
  const auto fixed = [&](int v) { return m.constraints.freedom[static_cast<size_t>(v)] == Freedom::fixed; };
  return is_rim(t, h) && fixed(t.from(h)) && fixed(t.to(h)) && curve_of(m, h).curve < 0;
}

}  // namespace

int split_edge(AdaptingMesh& m, int h, const SplitOptions& options) {
  Triangulation& t = m.triangulation;
  if (stands_still(m, h)) return -1;
  const int v = add_vertex(m, h), twin = t.twin(h);
  if (!may_halve(m, h, v, options) || (twin >= 0 && !may_halve(m, twin, v, options))) {
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
    const int v = split_edge(m, h, options);
    if (v < 0) continue;
    queue.push_spokes(v);
    ++splits;
  }
  m.retraction.count();
  return splits;
}

}  // namespace hooke
