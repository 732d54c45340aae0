#include "hooke/springs/ring_energy.h"

#include <limits>
#include <numbers>

#include "hooke/core/simd.h"
#include "hooke/core/types.h"

namespace hooke {
namespace {

// Sums over a ring in lanes: the energy and its derivatives along two directions.

struct RingSums {
  Lanes energy = {}, gu = {}, gv = {}, huu = {}, huv = {}, hvv = {};
};

/// Components of a vector along the two directions.
struct LanePair {
  Lanes u, v;
};

struct Directions {
  Vec3 u, v;
};

HOOKE_INLINE void along(const LaneVec& x, const Directions& d, LanePair& p) {
  p.u = x.x * d.u[0] + x.y * d.u[1] + x.z * d.u[2];
  p.v = x.x * d.v[0] + x.y * d.v[1] + x.z * d.v[2];
}

/// Adds weight * a a^T to the second derivatives.
HOOKE_INLINE void add_square(const Lanes& weight, const LanePair& a, RingSums& s) {
  s.huu += weight * a.u * a.u;
  s.huv += weight * a.u * a.v;
  s.hvv += weight * a.v * a.v;
}

/// Adds weight * (a b^T + b a^T).
HOOKE_INLINE void add_product(const Lanes& weight, const LanePair& a, const LanePair& b, RingSums& s) {
  s.huu += 2. * weight * a.u * b.u;
  s.huv += weight * (a.u * b.v + a.v * b.u);
  s.hvv += 2. * weight * a.v * b.v;
}

/// Adds weight * the identity in the two directions; a zero direction contributes nothing.
HOOKE_INLINE void add_unit(const Lanes& weight, const Directions& d, RingSums& s) {
  s.huu += weight;
  s.hvv += weight * d.v.squaredNorm();
}

}  // namespace

using namespace ring;

namespace {

/// The quantities of four faces of the ring that several terms share.
struct FaceLanes {
  LaneVec e, f, n;   // to the neighbours a and b; unit normal
  Lanes la, lb, lc;  // of e, f and the far edge c
  LaneVec c;         // from a to b
  Lanes area;        // doubled
  Lanes face, edge;  // 1 if the entry has one, else 0
  LanePair eu, fu, nu;
};

HOOKE_INLINE void load_face(const RingView& r, std::size_t i, FaceLanes& q) {
  const double *const fixed = r.fixed + i, *const moving = r.moving + i;
  const std::size_t stride = r.stride;
  Lanes target;
  load(moving + to_near * stride, stride, q.e);
  load(moving + to_far * stride, stride, q.f);
  load(moving + area_vector * stride, stride, q.n);
  load(moving + near_length * stride, q.la);
  load(moving + far_length * stride, q.lb);
  load(moving + doubled_area * stride, q.area);
  load(fixed + has_face * stride, q.face);
  load(fixed + has_edge * stride, q.edge);
  load(fixed + face_target * stride, target);
  const Lanes floor = min_relative_length * target;
  q.la = q.la > floor ? q.la : floor;
  q.lb = q.lb > floor ? q.lb : floor;
  q.c = {q.f.x - q.e.x, q.f.y - q.e.y, q.f.z - q.e.z};
  dot(q.c, q.c, q.lc);
  take_sqrt(q.lc);
  q.lc = q.lc > floor ? q.lc : floor;

  const Lanes min_area = floor * target;
  const LaneMask flat = ~(q.area > min_area);
  if (any(flat)) {  // no area: uses the surface normal
    LaneVec m;
    Lanes size;
    load(fixed + normal_sums * stride, stride, m);
    m = {m.x + r.normal[0], m.y + r.normal[1], m.z + r.normal[2]};
    dot(m, m, size);
    take_sqrt(size);
    q.n.x = flat ? m.x / size * min_area : q.n.x;
    q.n.y = flat ? m.y / size * min_area : q.n.y;
    q.n.z = flat ? m.z / size * min_area : q.n.z;
    q.area = flat ? min_area : q.area;
  }
  const Lanes one_over = 1. / q.area;
  q.n = {q.n.x * one_over, q.n.y * one_over, q.n.z * one_over};
}

/// U(l; L) / L^2 of the edges to a. [4]
template <bool second_order>
HOOKE_INLINE void add_strings(const FaceLanes& q, const Lanes& L, double weight, const Directions& d,
                              RingSums& s) {
  const Lanes ratio = L / q.la;
  const LaneMask stretched = q.la >= L;
  Lanes log_ratio = ratio;
  take_log(log_ratio);
  const Lanes strain = q.la / L - 1.;
  const Lanes w = weight * q.edge;
  s.energy += w * (stretched ? .5 * strain * strain : log_ratio + strain);
  if constexpr (second_order) {
    // First derivative by the length, over the length, and second derivative, both times L^2.
    const Lanes first = (stretched ? Lanes{} + 1. : ratio) * strain * ratio;
    const Lanes second = stretched ? Lanes{} + 1. : ratio * ratio;
    const Lanes scale = w / (L * L);
    s.gu -= scale * first * q.eu.u;
    s.gv -= scale * first * q.eu.v;
    add_square(scale * (second - first) / (q.la * q.la), q.eu, s);
    add_unit(scale * first, d, s);
  }
}

/// U(h; h0) / h0^2 of the altitudes below h0 = (sqrt 3 / 2) L_f.
template <bool second_order>
HOOKE_INLINE void add_altitudes(const FaceLanes& q, const Lanes& h0, double weight, const Directions& d,
                                RingSums& s) {
  const Lanes zero = {}, one = zero + 1.;
  const Lanes w = weight * q.face;
  const Lanes zc = h0 * q.lc / q.area, za = h0 * q.lb / q.area, zb = h0 * q.la / q.area;  // h0 / h
  const LaneMask on_c = zc > 1., on_a = za > 1., on_b = zb > 1.;
  Lanes log_z = (on_c ? zc : one) * (on_a ? za : one) * (on_b ? zb : one);
  take_log(log_z);
  s.energy += w * (log_z + (on_c ? 1. / zc - 1. : zero) + (on_a ? 1. / za - 1. : zero) +
                   (on_b ? 1. / zb - 1. : zero));
  if constexpr (second_order) {
    LaneVec lift;
    cross(q.n, q.c, lift);
    LanePair g;  // gradient of the doubled area
    along(lift, d, g);
    const Lanes area_curve = q.lc * q.lc / q.area;  // second derivative of the doubled area along the normal
    // Derivatives of ln z - 1 + 1 / z by h.
    const Lanes over_h0 = 1. / h0;
    const auto terms_of = [&](const LaneMask& on, const Lanes& z, Lanes& slope, Lanes& curvature) {
      slope = on ? w * (1. - z) * over_h0 : zero;
      curvature = on ? w * (z * z) * (over_h0 * over_h0) : zero;
    };
    Lanes slope, curvature;
    terms_of(on_c, zc, slope, curvature);
    const Lanes ic = 1. / q.lc;
    Lanes by_area = slope * ic;
    add_square(curvature * ic * ic, g, s);

    const auto add_at_neighbour = [&](const LanePair& x, const Lanes& length) {  // h = area / |x|
      const Lanes i1 = 1. / length, i3 = i1 * i1 * i1;
      const Lanes altitude_slope = q.area * i3;
      const LanePair gh = {g.u * i1 + altitude_slope * x.u, g.v * i1 + altitude_slope * x.v};
      add_square(curvature, gh, s);
      add_product(slope * i3, g, x, s);
      add_square(3. * slope * altitude_slope * i1 * i1, x, s);
      add_unit(-slope * altitude_slope, d, s);
      s.gu += slope * altitude_slope * x.u;
      s.gv += slope * altitude_slope * x.v;
      by_area += slope * i1;
    };
    terms_of(on_a, za, slope, curvature);
    add_at_neighbour(q.fu, q.lb);
    terms_of(on_b, zb, slope, curvature);
    add_at_neighbour(q.eu, q.la);
    s.gu += by_area * g.u;
    s.gv += by_area * g.v;
    add_square(by_area * area_curve, q.nu, s);
  }
}

/// The angle up to which springs act, the angle up to which the model includes them, and an upper bound of
/// the latter's tangent: tan x < pi^2 x / (pi^2 - 4 x^2) (M. Becker, E. Stark, 1978).
struct Threshold {
  Threshold(double t, double fade_out_factor) : angle(t), fade_out(fade_out_factor * t) {
    constexpr double square = std::numbers::pi * std::numbers::pi;
    const double rest = square - 4 * fade_out * fade_out;
    tangent = rest > 0 ? square * fade_out / rest : std::numeric_limits<double>::infinity();
  }
  double angle, fade_out, tangent;
};

/// Corner angles below the threshold t: U(theta; t) / t^2 = ln z - 1 + 1 / z, z = t / theta. Their curvature
/// is discontinuous at t, where springs bring angles to, and Newton's steps would be too; the model lets it
/// fade out beyond t.
template <bool second_order>
HOOKE_INLINE void add_angles(const FaceLanes& q, const Threshold& threshold, double weight,
                             const Directions& d, RingSums& s) {
  const double t = threshold.angle;
  const Lanes zero = {}, one = zero + 1.;
  Lanes at_x, at_a, at_b;
  dot(q.e, q.f, at_x);
  dot(q.e, q.c, at_a);
  at_a = -at_a;
  dot(q.f, q.c, at_b);
  const auto may_be_below = [&](const Lanes& cosine, LaneMask& on) {
    on = (q.face > 0.) & (cosine * threshold.tangent > q.area);
  };
  LaneMask on_x, on_a, on_b;
  may_be_below(at_x, on_x);
  may_be_below(at_a, on_a);
  may_be_below(at_b, on_b);
  if (!any(on_x | on_a | on_b)) return;

  const auto angle_of = [&](const LaneMask& on, const Lanes& cosine, Lanes& angle, Lanes& part) {
    Lanes r = cosine * cosine + q.area * q.area;
    take_sqrt(r);
    take_angle(cosine, q.area, r, angle);
    angle = angle > 1e-6 ? angle : zero + 1e-6;
    part = on ? (threshold.fade_out - angle) / (threshold.fade_out - t) : zero;
    part = part < 1. ? part : one;
    part = part > 0. ? part : zero;
    angle = (on & (angle < t)) ? angle : zero + t;
  };
  Lanes x, a, b, part_x, part_a, part_b;  // the angles, and the weights of their curvature
  angle_of(on_x, at_x, x, part_x);
  angle_of(on_a, at_a, a, part_a);
  angle_of(on_b, at_b, b, part_b);
  Lanes log_z = (t / x) * (t / a) * (t / b);
  take_log(log_z);
  s.energy += weight * (log_z + ((x - t) + (a - t) + (b - t)) / t);
  if constexpr (second_order) {
    const auto terms_of = [&](const Lanes& part, const Lanes& angle, Lanes& slope, Lanes& curvature) {
      const Lanes over = 1. / angle;
      slope = weight * (1. / t - over);
      curvature = part * (weight * over * over);
    };
    Lanes slope_x, slope_a, slope_b, curvature_x, curvature_a, curvature_b;
    terms_of(part_x, x, slope_x, curvature_x);
    terms_of(part_a, a, slope_a, curvature_a);
    terms_of(part_b, b, slope_b, curvature_b);
    const Lanes ia = one / (q.la * q.la), ib = one / (q.lb * q.lb);
    LaneVec turned;
    LanePair ga, gb;  // gradients of the angles at a and b; that of the vertex's own angle is minus their sum
    cross(q.n, q.e, turned);
    along(turned, d, ga);
    ga = {-ga.u * ia, -ga.v * ia};
    cross(q.n, q.f, turned);
    along(turned, d, gb);
    gb = {gb.u * ib, gb.v * ib};
    const LanePair gx = {-(ga.u + gb.u), -(ga.v + gb.v)};
    s.gu += slope_x * gx.u + slope_a * ga.u + slope_b * gb.u;
    s.gv += slope_x * gx.v + slope_a * ga.v + slope_b * gb.v;
    add_square(curvature_x, gx, s);
    add_square(curvature_a, ga, s);
    add_square(curvature_b, gb, s);
    // In polar coordinates around a its angle has the Hessian -(e_r e_t + e_t e_r) / r^2 + cot n n / r^2.
    const Lanes pull_a = (slope_a - slope_x) * ia, pull_b = (slope_b - slope_x) * ib;
    add_product(pull_a, q.eu, ga, s);
    add_product(pull_b, q.fu, gb, s);
    add_square((pull_a * at_a + pull_b * at_b) / q.area, q.nu, s);
  }
}

template <bool second_order>
HOOKE_INLINE void sum_ring(const RingView& r, const double* face_mask, const RingTerms& terms,
                           const Directions& d, RingSums& s) {
  const Threshold t(terms.angle_threshold, second_order ? angle_fade_out : 1);
  for (std::size_t i = 0; i < r.stride; i += lane_count) {
    FaceLanes q;
    load_face(r, i, q);
    if (face_mask) load(face_mask + i, q.face);
    if constexpr (second_order) {
      along(q.e, d, q.eu);
      along(q.f, d, q.fu);
      along(q.n, d, q.nu);
    }
    Lanes target;
    load(r.fixed + edge_target * r.stride + i, target);
    add_strings<second_order>(q, target, terms.string, d, s);
    if (terms.altitude > 0) {
      load(r.fixed + face_target * r.stride + i, target);
      add_altitudes<second_order>(q, altitude_ratio * target, terms.altitude, d, s);
    }
    if (terms.angle > 0) add_angles<second_order>(q, t, terms.angle, d, s);
  }
}

}  // namespace

HOOKE_SIMD double ring_energy(const RingView& ring, const double* face_mask, const RingTerms& terms) {
  RingSums s;
  sum_ring<false>(ring, face_mask, terms, {Vec3::Zero(), Vec3::Zero()}, s);
  return sum_of(s.energy);
}

HOOKE_SIMD void add_ring_model(const RingView& ring, const double* face_mask, const RingTerms& terms,
                               const Vec3& u, const Vec3& v, RingModel& model) {
  RingSums s;
  sum_ring<true>(ring, face_mask, terms, {u, v}, s);
  model.energy += sum_of(s.energy);
  model.gradient += Eigen::Vector2d(sum_of(s.gu), sum_of(s.gv));
  model.hessian(0, 0) += sum_of(s.huu);
  model.hessian(1, 1) += sum_of(s.hvv);
  model.hessian(0, 1) += sum_of(s.huv);
  model.hessian(1, 0) = model.hessian(0, 1);
}

}  // namespace hooke
