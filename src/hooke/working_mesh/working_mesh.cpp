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

void resize_rows(WorkingMesh& m, int ids) {
  const Mat3X& points = m.vertices.positions.points;
  const Eigen::Index columns = points.cols();
  m.vertices.resize(ids, ids);
  if (points.cols() > columns) m.retraction.resize(points.cols());
}

}  // namespace

WorkingMesh::WorkingMesh(const Adjacency& adjacency, VertexTable& v, Retraction& r)
    : halfedges(adjacency), vertices(v), retraction(r), curve_finder(v.constraints.curves) {
  vertices.previous_ids.resize(adjacency.vertex_count);
  std::iota(vertices.previous_ids.begin(), vertices.previous_ids.end(), 0);
}

WorkingMesh::WorkingMesh(Workspace& work) : WorkingMesh(*work.adjacency, work.vertices, *work.retraction) {
  halfedges.mark_junctions(work.vertices.constraints.junction);
}

CurveFinder::Location curve_of(const WorkingMesh& m, int h) {
  const int a = m.halfedges.from(h), b = m.halfedges.to(h);
  for (int v : {a, b})
    if (const int curve = m.vertices.constraints.curve[v]; curve >= 0)
      return {curve, m.vertices.positions.segments[v]};
  return m.curve_finder.common(m.vertices.positions.points.col(a), m.vertices.positions.points.col(b));
}

bool is_frozen_edge(const WorkingMesh& m, int h) {
  return m.vertices.constraints.is_frozen(m.halfedges.from(h), m.halfedges.to(h));
}

bool is_junction_edge(const WorkingMesh& m, int h) {
  const std::vector<int>& number = m.vertices.constraints.junction;
  if (number.empty() || !m.halfedges.is_feature_edge(h)) return false;
  const auto [low, high] = std::minmax(number[m.halfedges.from(h)], number[m.halfedges.to(h)]);
  return low >= 0 && std::ranges::binary_search(m.vertices.constraints.junction_edges, Edge{low, high}, {},
                                                &JunctionEdge::ends);
}

double relative_length(const WorkingMesh& m, int h) {
  const int a = m.halfedges.from(h), b = m.halfedges.to(h);
  return (m.vertices.positions.points.col(b) - m.vertices.positions.points.col(a)).norm() /
         target_length(m, a, b);
}

void count_curve_edges(WorkingMesh& m, double chord_error) {
  const HalfedgeMesh& t = m.halfedges;
  const size_t curves = m.vertices.constraints.curves.size();
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
      m.curve_edges.target[c] = target_edge_count(m.vertices.constraints.curves[c],
                                                  lengths[c] / m.curve_edges.present[c], chord_error);
}

SurfacePosition project_midpoint(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  const int a = t.from(h);
  const Vec3 half_way = .5 * (m.vertices.positions.points.col(t.to(h)) - m.vertices.positions.points.col(a));
  return m.retraction.moved_copy(m.vertices.positions, a, t.wedge(h), half_way);
}

namespace {

int add_vertex_on_surface(WorkingMesh& m, int h, const SurfacePosition* middle) {
  const HalfedgeMesh& t = m.halfedges;
  const int a = t.from(h), b = t.to(h), v = t.id_count(), twin = t.twin(h);
  const int other_wedge = t.is_crease(h) ? v + 1 : -1;
  const CurveFinder::Location on = t.is_feature_edge(h) ? curve_of(m, h) : CurveFinder::Location{};
  const int ids = std::max(v, other_wedge) + 1;
  resize_rows(m, ids);
  const size_t i = v;
  m.vertices.constraints.freedom[i] = on.curve >= 0 ? Freedom::curve : Freedom::surface;
  m.vertices.constraints.curve[i] = on.curve;
  m.vertices.vertex_length[i] = target_length(m, a, b);

  SurfacePositions& p = m.vertices.positions;
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

}  // namespace

int add_vertex(WorkingMesh& m, int h, const SurfacePosition* middle) {
  const int v = add_vertex_on_surface(m, h, middle);
  if (m.length_at) m.vertices.vertex_length[v] = m.length_at(v);
  return v;
}

void remove_last_vertex(WorkingMesh& m) {
  resize_rows(m, m.halfedges.id_count());
}

void compact(WorkingMesh& m) {
  HalfedgeMesh& t = m.halfedges;
  const std::vector<int> kept = t.compact();
  std::vector<int> wedges = kept, extra_wedges;
  m.vertices.constraints.creases.clear();
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.is_crease(h) && t.twin(h) < h) m.vertices.constraints.creases.push_back({t.from(h), t.to(h)});
  if (!m.vertices.constraints.creases.empty()) {
    Adjacency c = make_adjacency(static_cast<int>(kept.size()), t.faces());
    split_wedges(c, m.vertices.constraints.creases);
    wedges = wedges_before(c, t.wedges(), kept);
    t.set_wedges(c);
    extra_wedges = std::move(c.extra_wedges);
  }
  m.vertices.keep(kept, wedges, std::move(extra_wedges));
  m.retraction.resize(kept.size());
}
}  // namespace hooke
