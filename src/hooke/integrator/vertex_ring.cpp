#include "hooke/integrator/vertex_ring.h"

#include "hooke/filter/retraction.h"
#include "hooke/integrator/guards.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/ring_energy.h"

namespace hooke {
namespace {

// The absolute limits of the guards on a ring, four faces at a time.

/// True if no absolute limit is broken and no face shrinks too far, so that the exact rules need no
/// evaluation. The two views differ in the vertex position only.
bool within_limits(const RingView& before, const RingView& after, const ShapeLimits& limits);

using namespace ring;

constexpr double rounding = 1e-9;  // margin of the tests, so that they never contradict the exact rules

HOOKE_SIMD bool within_limits(const RingView& before, const RingView& after, const ShapeLimits& limits) {
  const std::size_t stride = after.stride;
  LaneMask broken = {};
  for (std::size_t i = 0; i < stride; i += lane_count) {
    const double *const fixed = after.fixed + i, *const moving = after.moving + i;
    LaneVec n, m;
    Lanes area, old_area, area_of_previous, face, edge, target, length, far;
    load(moving + area_vector * stride, stride, n);
    load(moving + doubled_area * stride, area);
    load(before.moving + i + doubled_area * stride, old_area);
    load(moving + previous_area * stride, area_of_previous);
    load(moving + near_length * stride, length);
    load(moving + far_length * stride, far);
    load(fixed + has_face * stride, face);
    load(fixed + has_edge * stride, edge);
    load(fixed + edge_target * stride, target);

    load(fixed + normal_sums * stride, stride, m);
    m = {m.x + after.normal[0], m.y + after.normal[1], m.z + after.normal[2]};
    Lanes along, size;
    dot(n, m, along);
    dot(m, m, size);
    const double min_square_cosine = limits.alignment * limits.alignment * (1 + rounding);
    const LaneMask aligned = (along > 0.) & (along * along >= min_square_cosine * (area * area) * size);
    const LaneMask shrinks = area < limits.area * (1 + rounding) * old_area;
    broken |= (face > 0.) & (~aligned | shrinks);

    LaneVec e, f;
    Lanes opposite;  // squared length of the face's far edge
    load(moving + to_near * stride, stride, e);
    load(moving + to_far * stride, stride, f);
    f = {f.x - e.x, f.y - e.y, f.z - e.z};
    dot(f, f, opposite);
    const Lanes a = length * length, b = far * far;
    Lanes min_edge = a < b ? a : b;
    min_edge = min_edge < opposite ? min_edge : opposite;
    const Lanes cosine_at_min_angle = .5 * (a + b + opposite) - min_edge;  // times the lengths of its edges
    broken |= (face > 0.) & (cosine_at_min_angle > limits.cotangent * (1 - rounding) * area);

    load(fixed + edge_normal * stride, stride, m);
    Lanes c = m.x * after.normal[0] + m.y * after.normal[1] + m.z * after.normal[2];
    c = c < 1. ? c : Lanes{} + 1.;
    c = c > -1. ? c : Lanes{} - 1.;
    Lanes s = .5 * (1. - c), t = .5 * (1. + c);  // sin^2 and cos^2 of half the angle
    take_sqrt(s);
    take_sqrt(t);
    broken |= (edge > 0.) & (.5 * length * s > limits.sagitta * (1 - rounding) * target * (1. + t));

    LaneVec other;
    Lanes cosine, other_area;
    load(moving + previous_vector * stride, stride, other);
    dot(n, other, cosine);
    broken |= (face > 0.) & (cosine < limits.fold * (1 + rounding) * area * area_of_previous);
    load(fixed + beyond * stride, stride, other);
    dot(n, other, cosine);
    dot(other, other, other_area);
    take_sqrt(other_area);
    broken |= (face > 0.) & (cosine < limits.fold * (1 + rounding) * area * other_area);
  }
  return !any(broken);
}

}  // namespace

using namespace ring;

namespace {

HOOKE_SIMD void make_shape(const double* fixed, std::size_t stride, const Vec3& x, double* shape) {
  for (std::size_t i = 0; i < stride; i += lane_count) {
    LaneVec a, b, n;
    Lanes la, lb, area;
    load(fixed + near * stride + i, stride, a);
    load(fixed + far * stride + i, stride, b);
    const LaneVec e = {a.x - x[0], a.y - x[1], a.z - x[2]}, f = {b.x - x[0], b.y - x[1], b.z - x[2]};
    cross(e, f, n);
    dot(e, e, la);
    dot(f, f, lb);
    dot(n, n, area);
    take_sqrt(la);
    take_sqrt(lb);
    take_sqrt(area);
    store(e, shape + to_near * stride + i, stride);
    store(f, shape + to_far * stride + i, stride);
    store(n, shape + area_vector * stride + i, stride);
    store(la, shape + near_length * stride + i);
    store(lb, shape + far_length * stride + i);
    store(area, shape + doubled_area * stride + i);
  }
}

double cotangent_of_min_angle(const double* moving, std::size_t stride) {
  const Vec3 e = get(moving + to_near * stride, stride), f = get(moving + to_far * stride, stride);
  const double a = e.squaredNorm(), b = f.squaredNorm(), c = (f - e).squaredNorm();
  const double area = moving[doubled_area * stride];
  if (!(area > 0)) return std::numeric_limits<double>::infinity();
  return (.5 * (a + b + c) - std::min({a, b, c})) / area;
}

}  // namespace

void VertexRing::gather(const SurfacePositions& at, int wedge) {
  wedge_ = wedge;
  const auto ring = entries();
  const std::size_t count = ring.size();
  stride_ = padded_to_lanes(count);
  const std::size_t S = stride_;
  columns_.resize(fixed_columns * S);
  double* const data = columns_.data();
  const std::size_t item = rings_.first[wedge];
  if (begins_at_crease()) crease_opposite_ = at.points.col(rings_.crease_opposite[wedge]);
  const auto normal = [&](std::size_t i) {
    return at.normals.col(rings_.wedges.empty() ? ring[i].neighbour : rings_.wedges[item + i]);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const RingEntry& entry = ring[i];
    const bool face = entry.face >= 0;
    // The last edge of an open fan has no face: the face of the previous edge keeps the numbers finite.
    const std::size_t j = face ? (i + 1) % count : i - 1;
    const RingEntry& next = ring[j];
    put(at.points.col(entry.neighbour), data + near * S + i, S);
    put(at.points.col(next.neighbour), data + far * S + i, S);
    put(normal(i) + normal(j), data + normal_sums * S + i, S);
    put(normal(i), data + edge_normal * S + i, S);
    Vec3 other = Vec3::Zero();
    if (entry.across >= 0) {
      const Vec3 b = at.points.col(next.neighbour);
      other = (at.points.col(entry.neighbour) - b).cross(at.points.col(entry.across) - b);
    }
    put(other, data + beyond * S + i, S);
    data[edge_target * S + i] = targets_.edge[entry.edge];
    data[face_target * S + i] = face ? targets_.face[entry.face] : data[edge_target * S + i];
    data[has_edge * S + i] = rings_.owned.empty() || rings_.owned[item + i];
    data[has_face * S + i] = face;
  }
  for (std::size_t c = 0; c < fixed_columns; ++c)
    for (std::size_t i = count; i < S; ++i)
      data[c * S + i] = c == has_edge || c == has_face ? 0 : data[c * S];
}

void VertexRing::shape(const Vec3& point, const Vec3& normal, RingShape& shape) const {
  const std::size_t S = stride_, count = entries().size();
  shape.point = point;
  shape.normal = normal;
  shape.columns.resize(moving_columns * S);
  double* const data = shape.columns.data();
  make_shape(columns_.data(), S, point, data);
  for (std::size_t i = 0; i < S; ++i) {
    const std::size_t before = i == 0 ? count - 1 : i - 1;
    const bool pair = i < count && entries()[i].face >= 0 && entries()[before].face >= 0;
    for (std::size_t k = 0; k < 3; ++k)
      data[(previous_vector + k) * S + i] = pair ? data[(area_vector + k) * S + before] : 0;
    data[previous_area * S + i] = pair ? data[doubled_area * S + before] : 0;
  }
  if (!begins_at_crease()) return;
  const Vec3 beyond_crease = (crease_opposite_ - point).cross(get(data + to_near * S, S));
  put(beyond_crease, data + previous_vector * S, S);
  data[previous_area * S] = beyond_crease.norm();
}

double VertexRing::energy(const RingShape& shape, const RingTerms& terms) const {
  std::vector<double> face_mask;
  const double folded =
      terms.unfold > 0 ? unfold(shape, terms, Vec3::Zero(), Vec3::Zero(), face_mask).energy : 0;
  return folded + ring_energy(view(shape), face_mask.empty() ? nullptr : face_mask.data(), terms);
}

RingModel VertexRing::model(const RingShape& shape, const RingTerms& terms, const Vec3& u,
                            const Vec3& v) const {
  RingModel model;
  std::vector<double> face_mask;
  if (terms.unfold > 0) model = unfold(shape, terms, u, v, face_mask);
  add_ring_model(view(shape), face_mask.empty() ? nullptr : face_mask.data(), terms, u, v, model);
  return model;
}

/// 3/2 ((d - s) / d)^2 of the folded faces, s = (2 A n) . r / (.866 L^2); `face_mask` marks the faces to
/// which the other terms apply.
RingModel VertexRing::unfold(const RingShape& shape, const RingTerms& terms, const Vec3& u, const Vec3& v,
                             std::vector<double>& face_mask) const {
  const std::size_t S = stride_;
  RingModel model;
  face_mask.assign(columns_.begin() + static_cast<std::ptrdiff_t>(has_face * S),
                   columns_.begin() + static_cast<std::ptrdiff_t>((has_face + 1) * S));
  for (std::size_t i = 0; i < S; ++i) {
    if (face_mask[i] == 0) continue;
    const Vec3 n = get(shape.columns.data() + area_vector * S + i, S);
    const Vec3 r = get(columns_.data() + normal_sums * S + i, S) + shape.normal;
    const double lengths = std::sqrt(n.squaredNorm() * r.squaredNorm());
    const double d = terms.unfold_below;
    if (lengths > 0 && n.dot(r) / lengths >= d) continue;
    face_mask[i] = 0;
    const double target = columns_[face_target * S + i];
    const double unit = altitude_ratio * target * target;
    const Vec3 up = r.stableNormalized();
    const double s = n.dot(up) / unit;
    if (s >= d) continue;
    const Vec3 c = get(columns_.data() + far * S + i, S) - get(columns_.data() + near * S + i, S);
    const Vec3 lift = up.cross(c) / unit;  // gradient of s
    const Eigen::Vector2d g(lift.dot(u), lift.dot(v));
    const double weight = 3 * terms.unfold / (d * d);
    model.energy += .5 * weight * (d - s) * (d - s);
    model.gradient -= weight * (d - s) * g;
    model.hessian += weight * g * g.transpose();
  }
  return model;
}

/// Of the face of this entry with the surface; 1 if there is none, 0 if it has no area.
double VertexRing::alignment(const RingShape& shape, std::size_t i) const {
  if (entries()[i].face < 0) return 1;
  const Vec3 n = get(shape.columns.data() + area_vector * stride_ + i, stride_);
  const Vec3 r = get(columns_.data() + normal_sums * stride_ + i, stride_) + shape.normal;
  return n.isZero(0) || r.isZero(0) ? 0 : cosine_between(n, r);
}

RingMeasures VertexRing::measures(const RingShape& shape, std::size_t i) const {
  const std::size_t S = stride_;
  const double* const moving = shape.columns.data() + i;
  const double* const fixed = columns_.data() + i;
  const double c = std::clamp(get(fixed + edge_normal * S, S).dot(shape.normal), -1., 1.);
  const double tan_quarter = std::sqrt(.5 * (1 - c)) / (1 + std::sqrt(.5 * (1 + c)));
  RingMeasures m{.sagitta = .5 * moving[near_length * S] * tan_quarter};
  if (entries()[i].face < 0) return m;
  const Vec3 n = get(moving + area_vector * S, S);
  m.area = .5 * moving[doubled_area * S];
  m.alignment = alignment(shape, i);
  m.cotangent = cotangent_of_min_angle(moving, S);
  m.fold = cosine_between(n, get(moving + previous_vector * S, S));
  m.far_fold = cosine_between(n, get(fixed + beyond * S, S));
  return m;
}

double VertexRing::max_cotangent(const RingShape& shape) const {
  double largest = 0;
  for (std::size_t i = 0; i < entries().size(); ++i)
    if (entries()[i].face >= 0)
      largest = std::max(largest, cotangent_of_min_angle(shape.columns.data() + i, stride_));
  return largest;
}

int VertexRing::folded_faces(const RingShape& shape, double limit) const {
  int count = 0;
  for (std::size_t i = 0; i < entries().size(); ++i) count += alignment(shape, i) < limit;
  return count;
}

bool VertexRing::fold_breaks(const ShapeLimits& limits, std::size_t i, const RingMeasures& b,
                             const RingMeasures& a) const {
  const auto breaks = [&](bool crease, double before, double after) {
    return crease ? crease_fold_breaks(limits, before, after) : hooke::fold_breaks(limits, before, after);
  };
  const std::size_t item = rings_.first[wedge_] + i;
  const bool far_crease = !rings_.far_crease.empty() && rings_.far_crease[item];
  return breaks(i == 0 && begins_at_crease(), b.fold, a.fold) || breaks(far_crease, b.far_fold, a.far_fold);
}

bool VertexRing::obeys(const RingShape& before, const RingShape& after, const ShapeLimits& limits) const {
  if (within_limits(view(before), view(after), limits)) return true;
  for (std::size_t i = 0; i < entries().size(); ++i) {
    const RingMeasures b = measures(before, i), a = measures(after, i);
    if (face_breaks(limits, b.area, a.area, b.alignment, a.alignment) ||
        angle_breaks(limits, b.alignment, b.cotangent, a.cotangent) ||
        sagitta_breaks(limits, columns_[edge_target * stride_ + i], b.sagitta, a.sagitta) ||
        fold_breaks(limits, i, b, a))
      return false;
  }
  return true;
}

}  // namespace hooke
