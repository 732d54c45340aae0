#include "hooke/working_mesh/working_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/wedges.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {
namespace {

/// Ensures capacity for `ids` ids. It grows geometrically, because resizing copies the matrices.
void reserve_ids(WorkingMesh& m, size_t ids) {
  SurfacePositions& p = m.positions;
  if (p.drift.size() >= ids) return;
  const size_t capacity = std::max<size_t>(16, 2 * p.hints.size());
  for (Mat3X* matrix : {&p.points, &p.normals})
    matrix->conservativeResize(3, static_cast<Eigen::Index>(capacity));
  p.hints.resize(capacity, 0);
  p.segments.resize(capacity, 0);
  p.drift.resize(capacity, 0);
  if (!p.other_wedge.empty()) p.other_wedge.resize(capacity, -1);
  m.retraction.resize(capacity);
}

/// Resizes the lists to `ids` entries.
void resize_lists(WorkingMesh& m, int ids) {
  const size_t n = ids;
  m.constraints.freedom.resize(n, Freedom::fixed);
  m.constraints.curve.resize(n, -1);
  m.constraints.segment.resize(n, 0);
  m.vertex_length.resize(n, 0);
  m.corner_valences.resize(n, 0);
  m.origins.resize(n, -1);
}

template <typename T>
void keep_only(std::vector<T>& values, const std::vector<int>& kept) {
  std::vector<T> left(kept.size());
  for (size_t i = 0; i < kept.size(); ++i) left[i] = values[kept[i]];
  values = std::move(left);
}

}  // namespace

CurveFinder::Location curve_of(const WorkingMesh& m, int h) {
  const int a = m.halfedges.from(h), b = m.halfedges.to(h);
  for (int v : {a, b})
    if (const int curve = m.constraints.curve[v]; curve >= 0) return {curve, m.positions.segments[v]};
  return m.curve_finder.common(m.positions.points.col(a), m.positions.points.col(b));
}

double relative_length(const WorkingMesh& m, int h) {
  const int a = m.halfedges.from(h), b = m.halfedges.to(h);
  return (m.positions.points.col(b) - m.positions.points.col(a)).norm() / target_length(m, a, b);
}

void count_curve_edges(WorkingMesh& m, double chord_error) {
  const HalfedgeMesh& t = m.halfedges;
  const size_t curves = m.constraints.curves.size();
  std::vector<double> lengths(curves, 0);  // sum of the target lengths of the edges, per curve
  m.curve_edges.present.assign(curves, 0);
  m.curve_edges.target.assign(curves, 0);
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.is_removed(h / 3) || !t.is_feature_edge(h) || t.twin(h) > h) continue;
    const int curve = curve_of(m, h).curve;
    if (curve < 0) continue;
    lengths[curve] += target_length(m, t.from(h), t.to(h));
    ++m.curve_edges.present[curve];
  }
  for (size_t c = 0; c < curves; ++c)
    if (m.curve_edges.present[c] > 0)
      m.curve_edges.target[c] =
          target_edge_count(m.constraints.curves[c], lengths[c] / m.curve_edges.present[c], chord_error);
}

SurfacePosition project_midpoint(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  const int a = t.from(h);
  const Vec3 half_way = .5 * (m.positions.points.col(t.to(h)) - m.positions.points.col(a));
  return m.retraction.moved_copy(m.positions, a, t.wedge(h), half_way);
}

int add_vertex(WorkingMesh& m, int h, const SurfacePosition* middle) {
  const HalfedgeMesh& t = m.halfedges;
  const int a = t.from(h), b = t.to(h), v = t.id_count(), twin = t.twin(h);
  const int other_wedge = t.is_crease(h) ? v + 1 : -1;
  const CurveFinder::Location on = t.is_feature_edge(h) ? curve_of(m, h) : CurveFinder::Location{};
  const int ids = std::max(v, other_wedge) + 1;
  reserve_ids(m, static_cast<size_t>(ids));
  resize_lists(m, ids);
  const size_t i = v;
  m.constraints.freedom[i] = on.curve >= 0 ? Freedom::curve : Freedom::surface;
  m.constraints.curve[i] = on.curve;
  m.constraints.segment[i] = on.segment;
  m.vertex_length[i] = target_length(m, a, b);

  SurfacePositions& p = m.positions;
  if (middle) {
    middle->write_to(p, v);
    return v;
  }
  SurfacePosition start(p, a);
  start.segment = on.segment;
  start.drift = 0;
  start.normal = p.normals.col(t.wedge(h));
  start.hint = p.hints[t.wedge(h)];
  start.other_wedge = other_wedge;
  if (other_wedge >= 0) {
    if (p.other_wedge.empty()) p.other_wedge.assign(p.drift.size(), -1);  // the first vertex with two wedges
    p.other_wedge[i] = other_wedge;
    const int wedge_across = t.wedge(HalfedgeMesh::next(twin));  // of the same end
    start.other_normal = p.normals.col(wedge_across);
    start.other_hint = p.hints[wedge_across];
  }
  start.write_to(p, v);
  const Vec3 half_way = .5 * (p.points.col(b) - p.points.col(a));
  m.retraction.moved(p, v, half_way).write_to(p, v);
  return v;
}

void remove_last_vertex(WorkingMesh& m) {
  resize_lists(m, m.halfedges.id_count());
}

void compact(WorkingMesh& m) {
  HalfedgeMesh& t = m.halfedges;
  const std::vector<int> kept = t.compact();
  std::vector<int> wedges = kept;
  m.constraints.creases.clear();
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.is_crease(h) && t.twin(h) < h) m.constraints.creases.push_back({t.from(h), t.to(h)});
  if (!m.constraints.creases.empty()) {
    Adjacency c = make_adjacency(static_cast<int>(kept.size()), t.faces());
    split_wedges(c, m.constraints.creases);
    wedges = wedges_before(c, t.wedges(), kept);
    t.set_wedges(c);
    m.constraints.extra_wedges = c.extra_wedges;
  }
  keep_only(m.constraints.freedom, kept);
  keep_only(m.constraints.curve, kept);
  keep_only(m.constraints.segment, kept);
  keep_only(m.vertex_length, kept);
  keep_only(m.corner_valences, wedges);
  keep_only(m.origins, kept);
  SurfacePositions& p = m.positions;
  p.points = p.points(Eigen::all, kept).eval();
  p.normals = p.normals(Eigen::all, wedges).eval();
  keep_only(p.hints, wedges);
  keep_only(p.segments, kept);
  keep_only(p.drift, kept);
  p.other_wedge = other_wedges(kept.size(), m.constraints.extra_wedges);
  m.retraction.resize(kept.size());
}

WorkspaceEdit::WorkspaceEdit(Workspace& work, double corner_angle)
    : work_(work),
      halfedges_(*work.adjacency),
      corner_valences_(
          corner_valences(work.positions.points, *work.adjacency, work.constraints, corner_angle)),
      origins_(work.vertex_length.size()),
      curve_finder_(work.constraints.curves),
      mesh_{halfedges_,       work.positions, *work.retraction, work.constraints, work.vertex_length,
            corner_valences_, origins_,       curve_finder_,    curve_edges_} {
  std::iota(origins_.begin(), origins_.end(), 0);
}

void WorkspaceEdit::replace_faces() {
  work_.replace_faces(halfedges_.faces());
}

void WorkspaceEdit::replace_mesh() {
  work_.replace_mesh(halfedges_.faces(), halfedges_.wedges(), origins_);
}

}  // namespace hooke
