#include "hooke/integrator/ring_limits.h"

namespace hooke {

using namespace ring;

namespace {

constexpr double rounding = 1e-9;  // margin of tests that must not contradict the rules

}  // namespace

HOOKE_SIMD bool within_limits(const RingView& before, const RingView& after, const GuardOptions& o) {
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

    load(fixed + face_normals * stride, stride, m);
    m = {m.x + after.normal[0], m.y + after.normal[1], m.z + after.normal[2]};
    Lanes along, size;
    dot(n, m, along);
    dot(m, m, size);
    const double least = o.alignment * o.alignment * (1 + rounding);
    const LaneMask aligned = (along > 0.) & (along * along >= least * (area * area) * size);
    const LaneMask shrinks = area < o.area_ratio * (1 + rounding) * old_area;
    broken |= (face > 0.) & (~aligned | shrinks);

    LaneVec e, f;
    Lanes opposite;  // squared length of the face's far edge
    load(moving + to_near * stride, stride, e);
    load(moving + to_far * stride, stride, f);
    f = {f.x - e.x, f.y - e.y, f.z - e.z};
    dot(f, f, opposite);
    const Lanes a = length * length, b = far * far;
    Lanes least_side = a < b ? a : b;
    least_side = least_side < opposite ? least_side : opposite;
    const Lanes cosine_at_least = .5 * (a + b + opposite) - least_side;  // times the sides there
    broken |= (face > 0.) & (cosine_at_least > o.cotangent * (1 - rounding) * area);

    load(fixed + edge_normal * stride, stride, m);
    Lanes c = m.x * after.normal[0] + m.y * after.normal[1] + m.z * after.normal[2];
    c = c < 1. ? c : Lanes{} + 1.;
    c = c > -1. ? c : Lanes{} - 1.;
    Lanes s = .5 * (1. - c), t = .5 * (1. + c);  // sin^2 and cos^2 of half the angle
    take_sqrt(s);
    take_sqrt(t);
    broken |= (edge > 0.) & (.5 * length * s > o.sagitta * (1 - rounding) * target * (1. + t));

    LaneVec other;
    Lanes cosine, other_area;
    load(moving + previous_vector * stride, stride, other);
    dot(n, other, cosine);
    broken |= (face > 0.) & (cosine < o.fold * (1 + rounding) * area * area_of_previous);
    load(fixed + beyond * stride, stride, other);
    dot(n, other, cosine);
    dot(other, other, other_area);
    take_sqrt(other_area);
    broken |= (face > 0.) & (cosine < o.fold * (1 + rounding) * area * other_area);
  }
  return !any(broken);
}

}  // namespace hooke
