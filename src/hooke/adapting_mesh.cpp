#include "hooke/adapting_mesh.h"

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

std::array<double, 3> key_of(const Vec3& point) {
  return {point[0], point[1], point[2]};
}

/// Room for one more vertex, with room to spare: columns cost a copy of the matrix.
void make_room(AdaptingMesh& m, size_t vertices) {
  Placement& p = m.placement;
  if (p.anchors.size() >= vertices) return;
  const size_t room = std::max<size_t>(16, 2 * p.anchors.size());
  for (Mat3X* matrix : {&p.points, &p.normals, &p.tangents})
    matrix->conservativeResize(3, static_cast<Eigen::Index>(room));
  p.anchors.resize(room, 0);
  p.segments.resize(room, 0);
  p.drift.resize(room, 0);
  m.retraction.resize(room);
}

/// Lengths along the curve up to each of its points, the first again at the end of a closed one.
std::vector<double> arc_lengths(const Curve& curve) {
  const Eigen::Index n = curve.points.cols();
  std::vector<double> lengths = {0};
  for (int s = 0; s < curve.segment_count(); ++s)
    lengths.push_back(lengths.back() + (curve.points.col((s + 1) % n) - curve.points.col(s)).norm());
  return lengths;
}

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double squared = ab.squaredNorm();
  const double t = squared > 0 ? std::clamp((x - a).dot(ab) / squared, 0., 1.) : 0;
  return (x - a - t * ab).norm();
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
  for (size_t i = 0; i < kept.size(); ++i) values[i] = values[static_cast<size_t>(kept[i])];
  values.resize(kept.size());
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
  const double target =
      .5 * (m.vertex_length[static_cast<size_t>(a)] + m.vertex_length[static_cast<size_t>(b)]);
  return (m.placement.points.col(b) - m.placement.points.col(a)).norm() / target;
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
    const auto a = static_cast<size_t>(t.from(h)), b = static_cast<size_t>(t.to(h));
    lengths[static_cast<size_t>(curve)] += .5 * (m.vertex_length[a] + m.vertex_length[b]);
    ++m.curve_edges.present[static_cast<size_t>(curve)];
  }
  for (size_t c = 0; c < curves; ++c)
    if (m.curve_edges.present[c] > 0)
      m.curve_edges.wanted[c] =
          wanted_edges(m.constraints.curves[c], lengths[c] / m.curve_edges.present[c], chord_error);
}

int add_vertex(AdaptingMesh& m, int h) {
  const Triangulation& t = m.triangulation;
  const int a = t.from(h), b = t.to(h), v = t.vertex_count();
  const CurveFinder::Place on = is_rim(t, h) ? curve_of(m, h) : CurveFinder::Place{};
  make_room(m, static_cast<size_t>(v) + 1);
  m.constraints.freedom.push_back(on.curve >= 0 ? Freedom::curve : Freedom::surface);
  m.constraints.curve.push_back(on.curve);
  m.constraints.segment.push_back(on.segment);
  m.vertex_length.push_back(
      .5 * (m.vertex_length[static_cast<size_t>(a)] + m.vertex_length[static_cast<size_t>(b)]));
  m.corner_valences.push_back(0);
  m.origins.push_back(-1);

  VertexPlace start(m.placement, a);
  start.segment = on.segment;
  start.tangent.setZero();
  start.drift = 0;
  start.write_to(m.placement, v);
  const Vec3 half_way = .5 * (m.placement.points.col(b) - m.placement.points.col(a));
  m.retraction.moved(m.placement, v, half_way).write_to(m.placement, v);
  return v;
}

void drop_vertex(AdaptingMesh& m) {
  m.constraints.freedom.pop_back();
  m.constraints.curve.pop_back();
  m.constraints.segment.pop_back();
  m.vertex_length.pop_back();
  m.corner_valences.pop_back();
  m.origins.pop_back();
}

void copy_vertex(AdaptingMesh& m, int from, int to) {
  const auto f = static_cast<size_t>(from), t = static_cast<size_t>(to);
  VertexPlace(m.placement, from).write_to(m.placement, to);
  m.constraints.freedom[t] = m.constraints.freedom[f];
  m.constraints.curve[t] = m.constraints.curve[f];
  m.constraints.segment[t] = m.constraints.segment[f];
  m.vertex_length[t] = m.vertex_length[f];
  m.corner_valences[t] = m.corner_valences[f];
  m.origins[t] = m.origins[f];
}

void compact(AdaptingMesh& m) {
  const std::vector<int> kept = m.triangulation.compact();
  keep_only(m.constraints.freedom, kept);
  keep_only(m.constraints.curve, kept);
  keep_only(m.constraints.segment, kept);
  keep_only(m.vertex_length, kept);
  keep_only(m.corner_valences, kept);
  keep_only(m.origins, kept);
  Placement& p = m.placement;
  for (Mat3X* matrix : {&p.points, &p.normals, &p.tangents}) *matrix = (*matrix)(Eigen::all, kept).eval();
  keep_only(p.anchors, kept);
  keep_only(p.segments, kept);
  keep_only(p.drift, kept);
  m.retraction.resize(kept.size());

  const Triangulation& t = m.triangulation;
  m.constraints.creases.clear();
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.is_constrained(h) && t.twin(h) < h) m.constraints.creases.push_back({t.from(h), t.to(h)});
}

}  // namespace hooke
