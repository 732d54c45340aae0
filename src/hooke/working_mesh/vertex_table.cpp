#include "hooke/working_mesh/vertex_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hooke/connectivity/corner_flips.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

std::array<double, 3> key_of(const Vec3& point) {
  return {point[0], point[1], point[2]};
}

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

/// Lengths along the curve up to each of its points, the first again at the end of a closed one.
std::vector<double> arc_lengths(const Curve& curve) {
  const Eigen::Index n = curve.points.cols();
  std::vector<double> lengths = {0};
  for (int s = 0; s < curve.segment_count(); ++s)
    lengths.push_back(lengths.back() + (curve.points.col((s + 1) % n) - curve.points.col(s)).norm());
  return lengths;
}

/// Greatest distance of the curve from `count` chords of equal arcs.
double chord_error_of(const Curve& curve, const std::vector<double>& arcs, int count) {
  const Eigen::Index n = curve.points.cols();
  const auto at = [&](double arc, size_t& s) -> Vec3 {
    while (s + 2 < arcs.size() && arcs[s + 1] < arc) ++s;
    const double length = arcs[s + 1] - arcs[s], t = length > 0 ? (arc - arcs[s]) / length : 0;
    return (1 - t) * curve.points.col(static_cast<Eigen::Index>(s)) +
           t * curve.points.col(static_cast<Eigen::Index>(s + 1) % n);
  };
  double worst = 0;
  size_t segment = 0;
  Vec3 a = at(0, segment);
  for (int i = 0; i < count; ++i) {
    const size_t first = segment + 1;
    const Vec3 b = at(arcs.back() * (i + 1) / count, segment);
    for (size_t s = first; s <= segment; ++s)
      worst = std::max(worst, distance_to_segment(curve.points.col(static_cast<Eigen::Index>(s) % n), a, b));
    a = b;
  }
  return worst;
}

int wanted_edges(const Curve& curve, double target, double chord_error) {
  const std::vector<double> arcs = arc_lengths(curve);
  const int most = std::max(curve.segment_count(), 3);
  int count = std::max(curve.closed ? 3 : 1, static_cast<int>(std::lround(arcs.back() / target)));
  while (count < most && chord_error_of(curve, arcs, count) > chord_error * target)
    count = std::min(most, count + std::max(1, count / 16));
  return count;
}

template <typename T>
void keep_only(std::vector<T>& values, const std::vector<int>& kept) {
  std::vector<T> left(kept.size());
  for (size_t i = 0; i < kept.size(); ++i) left[i] = values[static_cast<size_t>(kept[i])];
  values = std::move(left);
}

}  // namespace

CurveFinder::CurveFinder(const std::vector<Curve>& curves) : curves_(&curves) {
  for (size_t c = 0; c < curves.size(); ++c)
    for (Eigen::Index i = 0; i < curves[c].points.cols(); ++i)
      places_[key_of(curves[c].points.col(i))].push_back(
          {static_cast<int>(c), std::min(static_cast<int>(i), curves[c].segment_count() - 1)});
}

CurveFinder::Place CurveFinder::common(const Vec3& a, const Vec3& b) const {
  const auto at_a = places_.find(key_of(a)), at_b = places_.find(key_of(b));
  if (at_a == places_.end() || at_b == places_.end()) return {};
  const Vec3 middle = .5 * a + .5 * b;
  Place best;
  double least = std::numeric_limits<double>::infinity();
  for (const Place& p : at_a->second)
    for (const Place& q : at_b->second) {
      if (p.curve != q.curve) continue;
      const int halfway = (p.segment + q.segment) / 2;
      const CurveFoot foot = project_to_curve((*curves_)[static_cast<size_t>(p.curve)], middle, halfway);
      const double distance = (foot.point - middle).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      best = {p.curve, foot.segment};
    }
  return best;
}

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

}  // namespace hooke
