#include "hooke/filter/retraction.h"

#include <algorithm>
#include <atomic>
#include <tuple>
#include <utility>

#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/constraints/junction_curves.h"
#include "hooke/core/parallel.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

constexpr size_t retraction_block = 256;

constexpr double max_tangent_drift = .1;  // maximal drift in the tangent plane, in mean target lengths

/// Copies the extra wedges: a step does not write those of fixed vertices.
void copy_extra_wedges(const SurfacePositions& from, SurfacePositions& to) {
  to.other_wedge = from.other_wedge;
  to.normals.resize(3, from.normals.cols());
  to.hints.resize(from.hints.size());
  for (size_t wedge = from.drift.size(); wedge < from.hints.size(); ++wedge) {
    to.normals.col(static_cast<Eigen::Index>(wedge)) = from.normals.col(static_cast<Eigen::Index>(wedge));
    to.hints[wedge] = from.hints[wedge];
  }
}

/// Few vertices share a set of counters, so that threads rarely contend for one.
constexpr size_t vertices_per_counter_set = 64;
constexpr size_t statuses = std::tuple_size_v<decltype(ProjectionCounts::by_status)>;
constexpr size_t counter_set_size = statuses + 1;  // the last one counts evaluations

size_t counters_for(size_t vertices) {
  return (vertices / vertices_per_counter_set + 1) * counter_set_size;
}

void add(int count, long long& counter) {
  std::atomic_ref(counter).fetch_add(count, std::memory_order_relaxed);
}

}  // namespace

Retraction::Retraction(Surface surface, const Constraints& constraints, const RetractionOptions& options)
    : surface_(std::move(surface)),
      constraints_(constraints),
      options_(options),
      uncounted_(counters_for(constraints.freedom.size()), 0) {}

SurfacePosition::SurfacePosition(const SurfacePositions& p, int vertex)
    : point(p.points.col(vertex)),
      normal(p.normals.col(vertex)),
      hint(p.hints[vertex]),
      segment(p.segments[vertex]),
      drift(p.drift[vertex]),
      other_wedge(p.other_wedge_of(vertex)) {
  if (other_wedge < 0) return;
  other_normal = p.normals.col(other_wedge);
  other_hint = p.hints[other_wedge];
}

void SurfacePosition::write_to(SurfacePositions& p, int vertex) const {
  p.points.col(vertex) = point;
  p.normals.col(vertex) = normal;
  p.hints[vertex] = hint;
  p.segments[vertex] = segment;
  p.drift[vertex] = drift;
  if (other_wedge < 0) return;
  p.normals.col(other_wedge) = other_normal;
  p.hints[other_wedge] = other_hint;
}

Vec3 Retraction::within_max_travel(const Vec3& point, int vertex) const {
  if (constraints_.max_travel.empty()) return point;
  const Vec3 rest = constraints_.rest_position.col(vertex), displacement = point - rest;
  const double length = displacement.norm(), max_travel = constraints_.max_travel[vertex];
  return length > max_travel ? Vec3(rest + displacement * (max_travel / length)) : point;
}

/// The curve along which the vertex slides, by itself or with its copies; null if it does not.
const Curve* Retraction::curve_of(int vertex) const {
  if (constraints_.freedom[vertex] == Freedom::curve) return &constraints_.curves[constraints_.curve[vertex]];
  if (!constraints_.slides_with_copies(vertex)) return nullptr;
  return &constraints_.junction_curves[constraints_.junction_vertex(vertex)->curve];
}

Vec3 Retraction::tangent(const SurfacePositions& at, int vertex) const {
  const Curve* const curve = curve_of(vertex);
  if (!curve) return Vec3::Zero();
  return project_to_curve(*curve, at.points.col(vertex), at.segments[vertex]).tangent;
}

SurfacePosition Retraction::on_curve(SurfacePosition position, int vertex) const {
  const CurveProjection projection = project_to_curve(*curve_of(vertex), position.point, position.segment);
  position.point = projection.point;
  position.segment = projection.segment;
  return position;
}

Projection Retraction::projection(const Vec3& point, int hint, int vertex) {
  Projection projection = surface_(point, hint, options_.tolerance);
  long long* const counters = &uncounted_[vertex / vertices_per_counter_set * counter_set_size];
  add(1, counters[static_cast<size_t>(projection.status)]);
  add(projection.evaluations, counters[statuses]);
  return projection;
}

SurfacePosition Retraction::on_surface(SurfacePosition position, int vertex, Freedom freedom) {
  const Projection on_wedge = projection(position.point, position.hint, vertex);
  if (position.other_wedge >= 0) {
    const Projection on_other_wedge = projection(position.point, position.other_hint, vertex);
    position.other_normal = on_other_wedge.normal;
    position.other_hint = on_other_wedge.hint;
  }
  // On a curve or at a corner the surface determines only the normal: the curve itself is the constraint.
  if (freedom == Freedom::surface) position.point = on_wedge.point;
  position.normal = on_wedge.normal;
  position.hint = on_wedge.hint;
  position.drift = 0;
  return position;
}

bool Retraction::stands_still(int vertex) const {
  return constraints_.freedom[vertex] == Freedom::fixed;
}

SurfacePosition Retraction::slid(const SurfacePositions& from, int copy, int first,
                                 const Vec3& displacement) {
  return moved(SurfacePosition(from, copy), first, Freedom::curve, displacement);
}

SurfacePosition Retraction::moved(const SurfacePositions& from, int vertex, const Vec3& displacement) {
  return moved(SurfacePosition(from, vertex), vertex, constraints_.freedom[vertex], displacement);
}

SurfacePosition Retraction::moved_copy(const SurfacePositions& from, int vertex, int wedge,
                                       const Vec3& displacement) {
  SurfacePosition position(from, vertex);
  position.normal = from.normals.col(wedge);
  position.hint = from.hints[wedge];
  position.drift = 0;
  position.other_wedge = -1;
  return moved(position, vertex, Freedom::surface, displacement);
}

SurfacePosition Retraction::moved(SurfacePosition position, int vertex, Freedom freedom,
                                  const Vec3& displacement) {
  const double length = displacement.norm();
  if (length == 0 || freedom == Freedom::fixed) return position;
  const Vec3 start = position.point;
  position.point = within_max_travel(start + displacement, vertex);
  position.drift += length;
  if (freedom == Freedom::curve) position = on_curve(position, vertex);
  const ShapeOperator shape_operator = surface_.shape_operator(position.hint);
  const double error =
      .5 * shape_operator.change * position.drift * position.drift;  // distance from the surface
  if (error < options_.lazy_error) {
    position = drifted(position, position.point - start, shape_operator, freedom);
    if (position.drift < options_.lazy) return position;
  } else if (position.drift < std::min(max_tangent_drift, options_.lazy)) {
    return position;  // in the tangent plane: the shape operator is inaccurate here
  }
  return on_surface(position, vertex, freedom);
}

/// Corrects a position that was reached by this displacement, in the tangent plane or along a chord, by the
/// shape operator.
SurfacePosition Retraction::drifted(SurfacePosition position, const Vec3& displacement,
                                    const ShapeOperator& shape_operator, Freedom freedom) const {
  const Vec3 turn = shape_operator.shape * displacement;
  if (freedom == Freedom::surface)
    position.point -= (displacement.dot(position.normal) + .5 * displacement.dot(turn)) * position.normal;
  position.normal = (position.normal + turn).normalized();
  if (position.other_wedge >= 0)
    position.other_normal =
        (position.other_normal + surface_.shape_operator(position.other_hint).shape * displacement)
            .normalized();
  return position;
}

SurfacePosition Retraction::projected(const SurfacePosition& position, int vertex) {
  const Freedom freedom = constraints_.freedom[vertex];
  return on_surface(freedom == Freedom::curve ? on_curve(position, vertex) : position, vertex, freedom);
}

SurfacePositions Retraction::project_all(const Mat3X& points, std::vector<int> hints,
                                         std::vector<int> segments) {
  SurfacePositions p;
  p.points = points;
  const auto& extra_wedges = constraints_.extra_wedges;
  p.normals = Mat3X::Zero(3, points.cols() + std::ssize(extra_wedges));
  p.hints = std::move(hints);
  p.segments = std::move(segments);
  p.drift.assign(points.cols(), 0);
  p.other_wedge = other_wedges(p.drift.size(), extra_wedges);
  parallel_for(points.cols(), retraction_block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int v = static_cast<int>(i);
      projected(SurfacePosition(p, v), v).write_to(p, v);
    }
  });
  for (size_t s = 0; s < extra_wedges.size(); ++s) {  // third and later wedges of corners
    const size_t wedge = p.drift.size() + s;
    const int v = extra_wedges[s];
    if (p.other_wedge_of(v) == static_cast<int>(wedge)) continue;
    const Projection on_wedge = projection(p.points.col(v), p.hints[wedge], v);
    p.normals.col(static_cast<Eigen::Index>(wedge)) = on_wedge.normal;
    p.hints[wedge] = on_wedge.hint;
  }
  count();
  return p;
}

/// `first`: see first_sliding_copies().
SurfacePosition Retraction::stepped(const SurfacePositions& from, const Mat3X& displacement, int vertex,
                                    const std::vector<int>& first) {
  if (first.empty() || !constraints_.slides_with_copies(vertex))
    return moved(from, vertex, displacement.col(vertex));
  return slid(from, vertex, first[vertex], displacement.col(first[vertex]));
}

void Retraction::step(const SurfacePositions& from, const Mat3X& displacement, std::span<const int> vertices,
                      SurfacePositions& to) {
  const std::vector<int> first = first_sliding_copies(constraints_);
  parallel_for(vertices.size(), retraction_block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      stepped(from, displacement, vertices[i], first).write_to(to, vertices[i]);
  });
  count();
}

void Retraction::step(const SurfacePositions& from, const Mat3X& displacement, SurfacePositions& to) {
  to.points.resize(3, from.points.cols());
  copy_extra_wedges(from, to);
  to.segments.resize(from.segments.size());
  to.drift.resize(from.drift.size());
  const std::vector<int> first = first_sliding_copies(constraints_);
  parallel_for(from.points.cols(), retraction_block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int v = static_cast<int>(i);
      stepped(from, displacement, v, first).write_to(to, v);
    }
  });
  count();
}

void Retraction::project_drifted(SurfacePositions& positions) {
  parallel_for(positions.drift.size(), retraction_block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int v = static_cast<int>(i);
      if (positions.drift[i] > 0)
        on_surface(SurfacePosition(positions, v), v, constraints_.freedom[i]).write_to(positions, v);
    }
  });
  count();
}

void Retraction::project_drifted(std::span<const int> vertices, SurfacePositions& positions) {
  parallel_for(vertices.size(), retraction_block, [&](size_t begin, size_t end) {
    for (int v : vertices.subspan(begin, end - begin))
      projected(SurfacePosition(positions, v), v).write_to(positions, v);
  });
  count();
}

void Retraction::constrain(const SurfacePositions& at, Mat3X& vectors) const {
  parallel_for(vectors.cols(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto v = static_cast<Eigen::Index>(i);
      auto u = vectors.col(v);
      switch (constraints_.freedom[i]) {
        case Freedom::surface:
          u -= at.normals.col(v) * at.normals.col(v).dot(u);
          break;
        case Freedom::fixed:
          if (!constraints_.slides_with_copies(static_cast<int>(i))) {
            u.setZero();
            break;
          }
          [[fallthrough]];
        case Freedom::curve: {
          const Vec3 along = tangent(at, static_cast<int>(i));
          u = (along * along.dot(u)).eval();
          break;
        }
      }
    }
  });
  for_each_sliding(constraints_, [&](std::span<const int> copies) {
    Vec3 sum = Vec3::Zero();
    for (const int v : copies) sum += vectors.col(v);
    for (const int v : copies) vectors.col(v) = sum / static_cast<double>(copies.size());
  });
}

void Retraction::resize(size_t vertices) {
  count();
  uncounted_.resize(counters_for(vertices), 0);
}

void Retraction::count() {
  for (size_t i = 0; i < uncounted_.size(); ++i) {
    const long long n = std::exchange(uncounted_[i], 0);
    const size_t counter = i % counter_set_size;
    if (counter == statuses) {
      counts_.evaluations += n;
    } else {
      counts_.by_status[counter] += n;
      counts_.calls += n;
    }
  }
}

}  // namespace hooke
