#include "hooke/vertex_ring.h"

#include <numbers>

#include "hooke/fast_log.h"
#include "hooke/lanes.h"

namespace hooke {
namespace {

constexpr double altitude_ratio = std::numbers::sqrt3 / 2;  // of an equilateral triangle
constexpr double least_length = 1e-9;  // of the target: a zero edge has a force, not a NaN
constexpr double rounding = 1e-9;      // margin of tests that must not contradict the rules

/// Columns of what is gathered. A vector takes three.
enum Fixed : std::size_t {
  near = 0,          // the neighbour a
  far = 3,           // the next neighbour b
  face_normals = 6,  // sum of the surface normals at a and b
  edge_normal = 9,   // surface normal at a
  beyond = 12,       // doubled area vector of the face beyond a and b; zero without one
  edge_target = 15,
  face_target = 16,
  has_edge = 17,  // 1 or 0; columns are filled up to whole groups of lanes with a copy of the first spoke
  has_face = 18,
  fixed_columns = 19
};

/// Columns of a shape.
enum Moving : std::size_t {
  to_near = 0,  // from the vertex
  to_far = 3,
  area_vector = 6,      // doubled
  previous_vector = 9,  // that of the face before, across the edge to a; zero without one
  doubled_area = 12,
  previous_area = 13,
  near_length = 14,
  far_length = 15,
  moving_columns = 16
};

HOOKE_INLINE void put(const Vec3& x, double* columns, std::size_t stride) {
  columns[0] = x[0];
  columns[stride] = x[1];
  columns[2 * stride] = x[2];
}

Vec3 get(const double* columns, std::size_t stride) {
  return {columns[0], columns[stride], columns[2 * stride]};
}

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

/// Whether no absolute limit is broken and no face shrinks too far: the rules have nothing to say then.
HOOKE_SIMD bool within_limits(const double* fixed, const double* before, const double* after,
                              std::size_t stride, const Vec3& normal, const GuardOptions& o) {
  LaneMask broken = {};
  for (std::size_t i = 0; i < stride; i += lane_count) {
    LaneVec n, m;
    Lanes area, old_area, previous_area_, face, edge, target, length, c;
    load(after + area_vector * stride + i, stride, n);
    load(after + doubled_area * stride + i, area);
    load(before + doubled_area * stride + i, old_area);
    load(after + previous_area * stride + i, previous_area_);
    load(after + near_length * stride + i, length);
    load(fixed + has_face * stride + i, face);
    load(fixed + has_edge * stride + i, edge);
    load(fixed + edge_target * stride + i, target);

    load(fixed + face_normals * stride + i, stride, m);
    m = {m.x + normal[0], m.y + normal[1], m.z + normal[2]};
    Lanes along, size;
    dot(n, m, along);
    dot(m, m, size);
    const double least = o.alignment * o.alignment * (1 + rounding);
    const LaneMask aligned = (along > 0.) & (along * along >= least * (area * area) * size);
    const LaneMask shrinks = area < o.area_ratio * (1 + rounding) * old_area;
    broken |= (face > 0.) & (~aligned | shrinks);

    load(fixed + edge_normal * stride + i, stride, m);
    c = m.x * normal[0] + m.y * normal[1] + m.z * normal[2];
    c = c < 1. ? c : Lanes{} + 1.;
    c = c > -1. ? c : Lanes{} - 1.;
    Lanes s = .5 * (1. - c), t = .5 * (1. + c);  // sin^2 and cos^2 of half the angle
    take_sqrt(s);
    take_sqrt(t);
    broken |= (edge > 0.) & (.5 * length * s > o.sagitta * (1 - rounding) * target * (1. + t));

    LaneVec other;
    Lanes cosine, other_area;
    load(after + previous_vector * stride + i, stride, other);
    dot(n, other, cosine);
    broken |= (face > 0.) & (cosine < o.fold * (1 + rounding) * area * previous_area_);
    load(fixed + beyond * stride + i, stride, other);
    dot(n, other, cosine);
    dot(other, other, other_area);
    take_sqrt(other_area);
    broken |= (face > 0.) & (cosine < o.fold * (1 + rounding) * area * other_area);
  }
  return !any(broken);
}

/// Sums over the ring: the energy, and its derivatives along two directions.
struct Sums {
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
HOOKE_INLINE void add_square(const Lanes& weight, const LanePair& a, Sums& s) {
  s.huu += weight * a.u * a.u;
  s.huv += weight * a.u * a.v;
  s.hvv += weight * a.v * a.v;
}

/// Adds weight * (a b^T + b a^T).
HOOKE_INLINE void add_product(const Lanes& weight, const LanePair& a, const LanePair& b, Sums& s) {
  s.huu += 2. * weight * a.u * b.u;
  s.huv += weight * (a.u * b.v + a.v * b.u);
  s.hvv += 2. * weight * a.v * b.v;
}

/// Adds weight * the unit matrix in the two directions; a missing one has none.
HOOKE_INLINE void add_unit(const Lanes& weight, const Directions& d, Sums& s) {
  s.huu += weight;
  s.hvv += weight * d.v.squaredNorm();
}

/// What the terms share of four faces of the ring.
struct FaceLanes {
  LaneVec e, f, n;   // to the neighbours a and b; unit normal
  Lanes la, lb, lc;  // lengths of them and of the far edge c
  LaneVec c;         // from a to b
  Lanes area;        // doubled
  Lanes face, edge;  // 1 where there is one
  LanePair eu, fu, nu;
};

HOOKE_INLINE void load_face(const double* fixed, const double* shape, std::size_t stride, std::size_t i,
                            const Vec3& normal, FaceLanes& q) {
  Lanes target;
  load(shape + to_near * stride + i, stride, q.e);
  load(shape + to_far * stride + i, stride, q.f);
  load(shape + area_vector * stride + i, stride, q.n);
  load(shape + near_length * stride + i, q.la);
  load(shape + far_length * stride + i, q.lb);
  load(shape + doubled_area * stride + i, q.area);
  load(fixed + has_face * stride + i, q.face);
  load(fixed + has_edge * stride + i, q.edge);
  load(fixed + face_target * stride + i, target);
  const Lanes floor = least_length * target;
  q.la = q.la > floor ? q.la : floor;
  q.lb = q.lb > floor ? q.lb : floor;
  q.c = {q.f.x - q.e.x, q.f.y - q.e.y, q.f.z - q.e.z};
  dot(q.c, q.c, q.lc);
  take_sqrt(q.lc);
  q.lc = q.lc > floor ? q.lc : floor;

  const Lanes least_area = floor * target;
  const LaneMask flat = ~(q.area > least_area);
  if (any(flat)) {  // without an area: the surface's normal
    LaneVec m;
    Lanes size;
    load(fixed + face_normals * stride + i, stride, m);
    m = {m.x + normal[0], m.y + normal[1], m.z + normal[2]};
    dot(m, m, size);
    take_sqrt(size);
    q.n.x = flat ? m.x / size * least_area : q.n.x;
    q.n.y = flat ? m.y / size * least_area : q.n.y;
    q.n.z = flat ? m.z / size * least_area : q.n.z;
    q.area = flat ? least_area : q.area;
  }
  const Lanes one_over = 1. / q.area;
  q.n = {q.n.x * one_over, q.n.y * one_over, q.n.z * one_over};
}

/// U(l; L) / L^2 of the edges to a. [4]
template <bool second_order>
HOOKE_INLINE void add_strings(const FaceLanes& q, const Lanes& L, double weight, const Directions& d,
                              Sums& s) {
  const Lanes ratio = L / q.la;
  const LaneMask stretched = q.la >= L;
  Lanes log_ratio = ratio;
  take_log(log_ratio);
  const Lanes excess = q.la / L - 1.;
  const Lanes w = weight * q.edge;
  s.energy += w * (stretched ? .5 * excess * excess : log_ratio + excess);
  if constexpr (second_order) {
    // By the length over the length, and twice by the length, times L^2.
    const Lanes first = (stretched ? Lanes{} + 1. : ratio) * excess * ratio;
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
                                Sums& s) {
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
    const Lanes area_curve = q.lc * q.lc / q.area;  // of the area, along the normal
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
      const Lanes bend = q.area * i3;
      const LanePair gh = {g.u * i1 + bend * x.u, g.v * i1 + bend * x.v};
      add_square(curvature, gh, s);
      add_product(slope * i3, g, x, s);
      add_square(3. * slope * bend * i1 * i1, x, s);
      add_unit(-slope * bend, d, s);
      s.gu += slope * bend * x.u;
      s.gv += slope * bend * x.v;
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

/// An angle with its cosine and sine.
struct Threshold {
  double angle, cosine, sine;
};

/// Corner angles below the threshold t: U(theta; t) / t^2 = ln z - 1 + 1 / z, z = t / theta.
template <bool second_order>
HOOKE_INLINE void add_angles(const FaceLanes& q, const Threshold& threshold, double weight,
                             const Directions& d, Sums& s) {
  const double t = threshold.angle;
  const Lanes zero = {}, one = zero + 1.;
  Lanes at_x, at_a, at_b;
  dot(q.e, q.f, at_x);
  dot(q.e, q.c, at_a);
  at_a = -at_a;
  dot(q.f, q.c, at_b);
  const auto is_below = [&](const Lanes& cosine, LaneMask& on) {
    on = (q.face > 0.) & (cosine * threshold.sine > q.area * threshold.cosine);
  };
  LaneMask on_x, on_a, on_b;
  is_below(at_x, on_x);
  is_below(at_a, on_a);
  is_below(at_b, on_b);
  if (!any(on_x | on_a | on_b)) return;

  const auto angle_of = [&](const LaneMask& on, const Lanes& cosine, Lanes& angle) {
    Lanes r = cosine * cosine + q.area * q.area;
    take_sqrt(r);
    take_angle(cosine, q.area, r, angle);
    angle = angle > 1e-6 ? angle : zero + 1e-6;
    angle = on ? angle : zero + t;
  };
  Lanes x, a, b;
  angle_of(on_x, at_x, x);
  angle_of(on_a, at_a, a);
  angle_of(on_b, at_b, b);
  Lanes log_z = (t / x) * (t / a) * (t / b);
  take_log(log_z);
  s.energy += weight * (log_z + ((x + a + b) / t - 3.));
  if constexpr (second_order) {
    const auto terms_of = [&](const LaneMask& on, const Lanes& angle, Lanes& slope, Lanes& curvature) {
      slope = on ? weight * (1. / t - 1. / angle) : zero;
      curvature = on ? weight / (angle * angle) : zero;
    };
    Lanes slope_x, slope_a, slope_b, curvature_x, curvature_a, curvature_b;
    terms_of(on_x, x, slope_x, curvature_x);
    terms_of(on_a, a, slope_a, curvature_a);
    terms_of(on_b, b, slope_b, curvature_b);
    const Lanes ia = one / (q.la * q.la), ib = one / (q.lb * q.lb);
    LaneVec turned;
    LanePair ga, gb;  // gradients of the angles at a and b; that of the vertex's own is minus their sum
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
    // In polar coordinates about a the angle there curves by -(e_r e_t + e_t e_r) / r^2 + cot n n / r^2.
    const Lanes pull_a = (slope_a - slope_x) * ia, pull_b = (slope_b - slope_x) * ib;
    add_product(pull_a, q.eu, ga, s);
    add_product(pull_b, q.fu, gb, s);
    add_square((pull_a * at_a + pull_b * at_b) / q.area, q.nu, s);
  }
}

template <bool second_order>
HOOKE_INLINE void sum_ring(const double* fixed, const double* shape, std::size_t stride, const Vec3& normal,
                           const double* unfolded, const EnergyTerms& terms, const Directions& d, Sums& s) {
  const Threshold t{terms.angle_threshold, std::cos(terms.angle_threshold), std::sin(terms.angle_threshold)};
  for (std::size_t i = 0; i < stride; i += lane_count) {
    FaceLanes q;
    load_face(fixed, shape, stride, i, normal, q);
    if (unfolded) load(unfolded + i, q.face);
    if constexpr (second_order) {
      along(q.e, d, q.eu);
      along(q.f, d, q.fu);
      along(q.n, d, q.nu);
    }
    Lanes target;
    load(fixed + edge_target * stride + i, target);
    add_strings<second_order>(q, target, terms.string, d, s);
    if (terms.altitude > 0) {
      load(fixed + face_target * stride + i, target);
      add_altitudes<second_order>(q, altitude_ratio * target, terms.altitude, d, s);
    }
    if (terms.angle > 0) add_angles<second_order>(q, t, terms.angle, d, s);
  }
}

HOOKE_SIMD double ring_energy(const double* fixed, const double* shape, std::size_t stride,
                              const Vec3& normal, const double* unfolded, const EnergyTerms& terms) {
  Sums s;
  sum_ring<false>(fixed, shape, stride, normal, unfolded, terms, {Vec3::Zero(), Vec3::Zero()}, s);
  return sum_of(s.energy);
}

HOOKE_SIMD void ring_model(const double* fixed, const double* shape, std::size_t stride, const Vec3& normal,
                           const double* unfolded, const EnergyTerms& terms, const Directions& d,
                           RingModel& model) {
  Sums s;
  sum_ring<true>(fixed, shape, stride, normal, unfolded, terms, d, s);
  model.energy += sum_of(s.energy);
  model.gradient += Eigen::Vector2d(sum_of(s.gu), sum_of(s.gv));
  model.hessian(0, 0) += sum_of(s.huu);
  model.hessian(1, 1) += sum_of(s.hvv);
  model.hessian(0, 1) += sum_of(s.huv);
  model.hessian(1, 0) = model.hessian(0, 1);
}

}  // namespace

void VertexRing::gather(const Placement& at, int side) {
  side_ = side;
  const auto ring = spokes();
  const std::size_t count = ring.size();
  stride_ = padded_to_lanes(count);
  const std::size_t S = stride_;
  columns_.resize(fixed_columns * S);
  double* const data = columns_.data();
  const auto item = static_cast<std::size_t>(spokes_.first[static_cast<std::size_t>(side)]);
  const auto normal = [&](std::size_t i) {
    return at.normals.col(spokes_.sides.empty() ? ring[i].neighbour : spokes_.sides[item + i]);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Spoke& spoke = ring[i];
    const bool face = spoke.face >= 0;
    // The last edge of an open fan has no face: one across the edge before keeps the numbers finite.
    const std::size_t j = face ? (i + 1) % count : i - 1;
    const Spoke& next = ring[j];
    put(at.points.col(spoke.neighbour), data + near * S + i, S);
    put(at.points.col(next.neighbour), data + far * S + i, S);
    put(normal(i) + normal(j), data + face_normals * S + i, S);
    put(normal(i), data + edge_normal * S + i, S);
    Vec3 other = Vec3::Zero();
    if (spoke.across >= 0) {
      const Vec3 b = at.points.col(next.neighbour);
      other = (at.points.col(spoke.neighbour) - b).cross(at.points.col(spoke.across) - b);
    }
    put(other, data + beyond * S + i, S);
    data[edge_target * S + i] = targets_.edge[static_cast<std::size_t>(spoke.edge)];
    data[face_target * S + i] =
        face ? targets_.face[static_cast<std::size_t>(spoke.face)] : data[edge_target * S + i];
    data[has_edge * S + i] = spokes_.owned.empty() || spokes_.owned[item + i];
    data[has_face * S + i] = face;
  }
  for (std::size_t c = 0; c < fixed_columns; ++c)
    for (std::size_t i = count; i < S; ++i)
      data[c * S + i] = c == has_edge || c == has_face ? 0 : data[c * S];
}

void VertexRing::shape(const Vec3& point, const Vec3& normal, RingShape& shape) const {
  const std::size_t S = stride_, count = spokes().size();
  shape.point = point;
  shape.normal = normal;
  shape.columns.resize(moving_columns * S);
  double* const data = shape.columns.data();
  make_shape(columns_.data(), S, point, data);
  for (std::size_t i = 0; i < S; ++i) {
    const std::size_t before = i == 0 ? count - 1 : i - 1;
    const bool pair = i < count && spokes()[i].face >= 0 && spokes()[before].face >= 0;
    for (std::size_t k = 0; k < 3; ++k)
      data[(previous_vector + k) * S + i] = pair ? data[(area_vector + k) * S + before] : 0;
    data[previous_area * S + i] = pair ? data[doubled_area * S + before] : 0;
  }
}

double VertexRing::energy(const RingShape& shape, const EnergyTerms& terms) const {
  std::vector<double> unfolded;
  const double folded =
      terms.unfold > 0 ? unfold(shape, terms, Vec3::Zero(), Vec3::Zero(), unfolded).energy : 0;
  return folded + ring_energy(columns_.data(), shape.columns.data(), stride_, shape.normal,
                              unfolded.empty() ? nullptr : unfolded.data(), terms);
}

RingModel VertexRing::model(const RingShape& shape, const EnergyTerms& terms, const Vec3& u,
                            const Vec3& v) const {
  RingModel model;
  std::vector<double> unfolded;
  if (terms.unfold > 0) model = unfold(shape, terms, u, v, unfolded);
  ring_model(columns_.data(), shape.columns.data(), stride_, shape.normal,
             unfolded.empty() ? nullptr : unfolded.data(), terms, {u, v}, model);
  return model;
}

/// 3/2 ((d - s) / d)^2 of the folded faces, s = (2 A n) . r / (.866 L^2); tells which faces are left for the
/// other terms.
RingModel VertexRing::unfold(const RingShape& shape, const EnergyTerms& terms, const Vec3& u, const Vec3& v,
                             std::vector<double>& unfolded) const {
  const std::size_t S = stride_;
  RingModel model;
  unfolded.assign(columns_.begin() + static_cast<std::ptrdiff_t>(has_face * S),
                  columns_.begin() + static_cast<std::ptrdiff_t>((has_face + 1) * S));
  for (std::size_t i = 0; i < S; ++i) {
    if (unfolded[i] == 0) continue;
    const Vec3 n = get(shape.columns.data() + area_vector * S + i, S);
    const Vec3 r = get(columns_.data() + face_normals * S + i, S) + shape.normal;
    const double lengths = std::sqrt(n.squaredNorm() * r.squaredNorm());
    const double d = terms.unfold_below;
    if (lengths > 0 && n.dot(r) / lengths >= d) continue;
    unfolded[i] = 0;
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

RingMeasures VertexRing::measures(const RingShape& shape) const {
  const std::size_t S = stride_;
  const double* const data = shape.columns.data();
  const auto cosine = [](const Vec3& a, const Vec3& b) {
    const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
    return lengths > 0 ? a.dot(b) / lengths : 1;
  };
  RingMeasures m;
  for (std::size_t i = 0; i < spokes().size(); ++i) {
    const Vec3 n = get(data + area_vector * S + i, S);
    const Vec3 r = get(columns_.data() + face_normals * S + i, S) + shape.normal;
    const double c = std::clamp(get(columns_.data() + edge_normal * S + i, S).dot(shape.normal), -1., 1.);
    const double tan_quarter = std::sqrt(.5 * (1 - c)) / (1 + std::sqrt(.5 * (1 + c)));
    const bool face = spokes()[i].face >= 0;
    m.area.push_back(face ? .5 * data[doubled_area * S + i] : 0);
    m.alignment.push_back(!face ? 1 : n.isZero(0) || r.isZero(0) ? 0 : cosine(n, r));
    m.sagitta.push_back(.5 * data[near_length * S + i] * tan_quarter);
    m.fold.push_back(face ? cosine(n, get(data + previous_vector * S + i, S)) : 1);
    m.far_fold.push_back(face ? cosine(n, get(columns_.data() + beyond * S + i, S)) : 1);
  }
  return m;
}

bool VertexRing::obeys(const RingShape& before, const RingShape& after, const GuardOptions& o) const {
  if (within_limits(columns_.data(), before.columns.data(), after.columns.data(), stride_, after.normal, o))
    return true;
  const RingMeasures b = measures(before), a = measures(after);
  for (std::size_t i = 0; i < spokes().size(); ++i)
    if (face_breaks(o, b.area[i], a.area[i], b.alignment[i], a.alignment[i]) ||
        sagitta_breaks(o, columns_[edge_target * stride_ + i], b.sagitta[i], a.sagitta[i]) ||
        fold_breaks(o, b.fold[i], a.fold[i]) || fold_breaks(o, b.far_fold[i], a.far_fold[i]))
      return false;
  return true;
}

}  // namespace hooke
