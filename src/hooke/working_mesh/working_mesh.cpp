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

/// Room for so many ids, with room to spare: columns cost a copy of the matrix.
void make_room(AdaptingMesh& m, size_t ids) {
  Placement& p = m.placement;
  if (p.drift.size() >= ids) return;
  const size_t room = std::max<size_t>(16, 2 * p.anchors.size());
  for (Mat3X* matrix : {&p.points, &p.normals})
    matrix->conservativeResize(3, static_cast<Eigen::Index>(room));
  p.anchors.resize(room, 0);
  p.segments.resize(room, 0);
  p.drift.resize(room, 0);
  if (!p.other_side.empty()) p.other_side.resize(room, -1);
  m.retraction.resize(room);
}

/// Gives the lists an entry for each of so many ids, or takes the last ones away.
void resize_lists(AdaptingMesh& m, int ids) {
  const auto n = static_cast<size_t>(ids);
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
  for (size_t i = 0; i < kept.size(); ++i) left[i] = values[static_cast<size_t>(kept[i])];
  values = std::move(left);
}

}  // namespace

CurveFinder::Place curve_of(const AdaptingMesh& m, int h) {
  const int a = m.triangulation.from(h), b = m.triangulation.to(h);
  for (int v : {a, b})
    if (const int curve = m.constraints.curve[static_cast<size_t>(v)]; curve >= 0)
      return {curve, m.placement.segments[static_cast<size_t>(v)]};
  return m.curve_finder.common(m.placement.points.col(a), m.placement.points.col(b));
}

double relative_length(const AdaptingMesh& m, int h) {
  const int a = m.triangulation.from(h), b = m.triangulation.to(h);
  return (m.placement.points.col(b) - m.placement.points.col(a)).norm() / target_length(m, a, b);
}

void count_curve_edges(AdaptingMesh& m, double chord_error) {
  const Triangulation& t = m.triangulation;
  const size_t curves = m.constraints.curves.size();
  std::vector<double> lengths(curves, 0);  // sum of the target lengths of its edges
  m.curve_edges.present.assign(curves, 0);
  m.curve_edges.wanted.assign(curves, 0);
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.is_gone(h / 3) || !is_rim(t, h) || t.twin(h) > h) continue;
    const int curve = curve_of(m, h).curve;
    if (curve < 0) continue;
    lengths[static_cast<size_t>(curve)] += target_length(m, t.from(h), t.to(h));
    ++m.curve_edges.present[static_cast<size_t>(curve)];
  }
  for (size_t c = 0; c < curves; ++c)
    if (m.curve_edges.present[c] > 0)
      m.curve_edges.wanted[c] =
          wanted_edges(m.constraints.curves[c], lengths[c] / m.curve_edges.present[c], chord_error);
}

VertexPlace middle_of(const AdaptingMesh& m, int h) {
  const Triangulation& t = m.triangulation;
  const int a = t.from(h), anchor = m.placement.anchors[static_cast<size_t>(t.side(h))];
  const Vec3 half_way = .5 * (m.placement.points.col(t.to(h)) - m.placement.points.col(a));
  return m.retraction.moved_copy(m.placement, a, anchor, half_way);
}

int add_vertex(AdaptingMesh& m, int h, const VertexPlace* middle) {
  const Triangulation& t = m.triangulation;
  const int a = t.from(h), b = t.to(h), v = t.id_count(), twin = t.twin(h);
  const int other_side = t.is_constrained(h) ? v + 1 : -1;
  const CurveFinder::Place on = is_rim(t, h) ? curve_of(m, h) : CurveFinder::Place{};
  const int ids = std::max(v, other_side) + 1;
  make_room(m, static_cast<size_t>(ids));
  resize_lists(m, ids);
  const auto i = static_cast<size_t>(v);
  m.constraints.freedom[i] = on.curve >= 0 ? Freedom::curve : Freedom::surface;
  m.constraints.curve[i] = on.curve;
  m.constraints.segment[i] = on.segment;
  m.vertex_length[i] = target_length(m, a, b);

  Placement& p = m.placement;
  if (middle) {
    middle->write_to(p, v);
    return v;
  }
  VertexPlace start(p, a);
  start.segment = on.segment;
  start.drift = 0;
  start.anchor = p.anchors[static_cast<size_t>(t.side(h))];
  start.other_side = other_side;
  if (other_side >= 0) {
    p.other_side[i] = other_side;
    start.other_anchor = p.anchors[static_cast<size_t>(t.side(Triangulation::next(twin)))];
  }
  start.write_to(p, v);
  const Vec3 half_way = .5 * (p.points.col(b) - p.points.col(a));
  m.retraction.moved(p, v, half_way).write_to(p, v);
  return v;
}

void drop_vertex(AdaptingMesh& m) {
  resize_lists(m, m.triangulation.id_count());
}

void compact(AdaptingMesh& m) {
  Triangulation& t = m.triangulation;
  const std::vector<int> kept = t.compact();
  std::vector<int> sides = kept;
  m.constraints.creases.clear();
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.is_constrained(h) && t.twin(h) < h) m.constraints.creases.push_back({t.from(h), t.to(h)});
  if (!m.constraints.creases.empty()) {
    Connectivity c = make_connectivity(static_cast<int>(kept.size()), t.faces());
    part_at_creases(c, m.constraints.creases);
    sides = sides_before(c, t.sides(), kept);
    t.set_sides(c);
    m.constraints.further_sides = c.further_sides;
  }
  keep_only(m.constraints.freedom, kept);
  keep_only(m.constraints.curve, kept);
  keep_only(m.constraints.segment, kept);
  keep_only(m.vertex_length, kept);
  keep_only(m.corner_valences, sides);
  keep_only(m.origins, kept);
  Placement& p = m.placement;
  p.points = p.points(Eigen::all, kept).eval();
  p.normals = p.normals(Eigen::all, sides).eval();
  keep_only(p.anchors, sides);
  keep_only(p.segments, kept);
  keep_only(p.drift, kept);
  p.other_side = other_sides(kept.size(), m.constraints.further_sides);
  m.retraction.resize(kept.size());
}

AdaptingWork::AdaptingWork(Workspace& work, double corner_angle)
    : work_(work),
      triangulation_(*work.connectivity),
      corner_valences_(
          corner_valences(work.placement.points, *work.connectivity, work.constraints, corner_angle)),
      origins_(work.vertex_length.size()),
      curve_finder_(work.constraints.curves),
      mesh_{triangulation_,   work.placement, *work.retraction, work.constraints, work.vertex_length,
            corner_valences_, origins_,       curve_finder_,    curve_edges_} {
  std::iota(origins_.begin(), origins_.end(), 0);
}

void AdaptingWork::replace_faces() {
  work_.replace_faces(triangulation_.faces());
}

void AdaptingWork::replace_mesh() {
  work_.replace_mesh(triangulation_.faces(), triangulation_.sides(), origins_);
}

}  // namespace hooke
