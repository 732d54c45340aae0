#include "hooke/springs/energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hooke/core/parallel.h"
#include "hooke/core/simd.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/hooke_law.h"

namespace hooke {
namespace {

constexpr double altitude_ratio = std::numbers::sqrt3 / 2;  // of an equilateral triangle

/// An edge, and the derivative of the energy by its length.
struct EdgeLanes {
  LaneVec vector;
  Lanes length, by_length;
};

HOOKE_INLINE void load_edges(const FaceSprings& f, EdgeLanes (&edges)[3]) {
  Lanes target;
  load(f.face_target, target);
  const Lanes floor = FaceSprings::min_length * target;
  for (std::size_t k = 0; k < 3; ++k) {
    LaneVec a, b;
    load(f.corners + 3 * lane_count * ((k + 1) % 3), lane_count, a);
    load(f.corners + 3 * lane_count * ((k + 2) % 3), lane_count, b);
    EdgeLanes& e = edges[k];
    e.vector = {b.x - a.x, b.y - a.y, b.z - a.z};
    dot(e.vector, e.vector, e.length);
    take_sqrt(e.length);
    e.length = e.length > floor ? e.length : floor;
  }
}

/// U(l; L) / L^2. [4]
HOOKE_INLINE void add_strings(const FaceSprings& f, double weight, EdgeLanes (&edges)[3], Lanes& energy) {
  const Lanes one = Lanes{} + 1.;
  Lanes ratios = one, sum = {};
  for (std::size_t k = 0; k < 3; ++k) {
    Lanes L, has;
    load(f.edge_target + lane_count * k, L);
    load(f.has_edge + lane_count * k, has);
    EdgeLanes& e = edges[k];
    const LaneMask stretched = e.length >= L, counts = has > 0.;
    const Lanes strain = e.length / L - 1.;
    sum += has * (stretched ? .5 * strain * strain : strain);
    ratios *= counts & ~stretched ? L / e.length : one;
    e.by_length = weight * has * strain / (stretched ? L : e.length);
  }
  take_log(ratios);
  energy += weight * (sum + ratios);
}

/// U(h; h0) / h0^2 of the altitudes below h0.
HOOKE_INLINE void add_altitudes(const FaceSprings& f, double weight, const Lanes& area, EdgeLanes (&edges)[3],
                                Lanes& by_area, Lanes& energy) {
  const Lanes zero = {}, one = zero + 1.;
  Lanes h0, has;
  load(f.face_target, h0);
  load(f.has_face, has);
  h0 *= altitude_ratio;
  const Lanes w = weight * has;
  Lanes ratios = one, sum = zero;
  for (EdgeLanes& e : edges) {
    const Lanes z = h0 * e.length / area;  // h0 / h
    const LaneMask below = z > 1.;
    ratios *= below ? z : one;
    sum += below ? 1. / z - 1. : zero;
    const Lanes slope = below ? w * (1. - z) / h0 : zero;
    const Lanes over_length = slope / e.length;
    by_area += over_length;
    e.by_length -= over_length * area / e.length;
  }
  take_log(ratios);
  energy += w * (sum + ratios);
}

HOOKE_INLINE void add_to_corner(FaceSprings& f, std::size_t corner, const Lanes& factor, const LaneVec& v) {
  LaneVec g;
  load(f.gradient + 3 * lane_count * corner, lane_count, g);
  g = {g.x + factor * v.x, g.y + factor * v.y, g.z + factor * v.z};
  store(g, f.gradient + 3 * lane_count * corner, lane_count);
}

}  // namespace

HOOKE_SIMD void evaluate_face_springs(double string, double altitude, FaceSprings& f) {
  EdgeLanes edges[3];
  load_edges(f, edges);
  LaneVec normal;
  Lanes area, target;  // doubled
  cross(edges[1].vector, edges[2].vector, normal);
  dot(normal, normal, area);
  take_sqrt(area);
  load(f.face_target, target);
  f.flat = any(~(area > FaceSprings::min_length * target * target));
  if (f.flat) return;

  Lanes energy = {}, by_area = {};
  add_strings(f, string, edges, energy);
  if (altitude > 0) add_altitudes(f, altitude, area, edges, by_area, energy);
  f.energy = sum_of(energy);

  by_area /= area;
  const Lanes zero = {};
  std::fill(std::begin(f.gradient), std::end(f.gradient), 0.);
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgeLanes& e = edges[k];
    const Lanes pull = e.by_length / e.length;
    LaneVec lift;
    cross(normal, e.vector, lift);
    add_to_corner(f, k, by_area, lift);
    add_to_corner(f, (k + 2) % 3, pull, e.vector);
    add_to_corner(f, (k + 1) % 3, zero - pull, e.vector);
  }
}

namespace {

constexpr size_t energy_block = 1024;  // faces, a multiple of the lanes
// Parts are large enough for several threads, and numerous enough for the memory of one part to be small.
constexpr size_t max_parts = 16, min_part = 32 * energy_block;

/// The quantities of one face that several terms share.
struct FaceFrame {
  std::array<Vec3, 3> opposite;  // edge vector opposite corner k, from corner k + 1 to corner k + 2
  std::array<double, 3> length;  // of it
  Vec3 normal;                   // unit; the surface normal if the face has no area
  double doubled_area;
};

/// Sum of the surface normals at the corners, unit.
Vec3 surface_normal(const Mat3X& normals, const Triangle& wedges) {
  return (normals.col(wedges[0]) + normals.col(wedges[1]) + normals.col(wedges[2])).stableNormalized();
}

FaceFrame frame_of(const Mat3X& points, const Mat3X& normals, const Triangle& t, const Triangle& wedges,
                   double target) {
  const std::array<Vec3, 3> p = {points.col(t[0]), points.col(t[1]), points.col(t[2])};
  FaceFrame f;
  for (size_t k = 0; k < 3; ++k) {
    f.opposite[k] = p[(k + 2) % 3] - p[(k + 1) % 3];
    f.length[k] = std::max(f.opposite[k].norm(), FaceSprings::min_length * target);
  }
  f.normal = f.opposite[2].cross(-f.opposite[1]);
  f.doubled_area = f.normal.norm();
  const double floor = FaceSprings::min_length * target * target;
  if (f.doubled_area > floor) {
    f.normal /= f.doubled_area;
  } else {
    f.normal = surface_normal(normals, wedges);
    f.doubled_area = floor;
  }
  return f;
}

/// Corner angles below the threshold: U(theta; t) / t^2 = ln z - 1 + 1 / z, z = t / theta.
double angle_energy(const FaceFrame& f, double weight, double threshold, std::array<Vec3, 3>& gradient) {
  double energy = 0;
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Vec3 a = f.opposite[j];   // from corner k to corner i
    const Vec3 b = -f.opposite[i];  // from corner k to corner j
    const double theta = std::max(std::atan2(f.doubled_area, a.dot(b)), 1e-6);
    if (theta >= threshold) continue;
    const Potential u = spring_potential(theta, threshold);
    energy += weight * u.value / (threshold * threshold);
    const double slope = weight * u.slope / (threshold * threshold);
    const Vec3 by_i = -f.normal.cross(a) / (f.length[j] * f.length[j]);
    const Vec3 by_j = f.normal.cross(b) / (f.length[i] * f.length[i]);
    gradient[i] += slope * by_i;
    gradient[j] += slope * by_j;
    gradient[k] -= slope * (by_i + by_j);
  }
  return energy;
}

/// Altitudes below h0: U(h; h0) / h0^2. Adds to the derivatives by the doubled area and by the edge lengths.
double altitude_energy(const FaceFrame& f, double weight, double h0, double& by_area,
                       std::array<double, 3>& by_length) {
  double energy = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double h = f.doubled_area / f.length[k];
    if (h >= h0) continue;
    const Potential u = spring_potential(h, h0);
    energy += weight * u.value / (h0 * h0);
    const double slope = weight * u.slope / (h0 * h0);
    by_area += slope / f.length[k];
    by_length[k] -= slope * h / f.length[k];
  }
  return energy;
}

/// 3/2 ((d - s) / d)^2 with the signed area s = (2 A n) . r / (.866 L^2), r the surface normal. Unlike
/// springs on unsigned altitudes it turns a folded face the right way round.
double unfold_energy(const Vec3& r, const FaceFrame& f, const EnergyTerms& terms, double target,
                     std::array<Vec3, 3>& gradient) {
  const double d = terms.unfold_below;
  const double unit = altitude_ratio * target * target;
  const double s = f.opposite[2].cross(-f.opposite[1]).dot(r) / unit;
  if (s >= d) return 0;
  const double slope = -3 * terms.unfold * (d - s) / (d * d) / unit;
  for (size_t k = 0; k < 3; ++k) gradient[k] += slope * r.cross(f.opposite[k]);
  return 1.5 * terms.unfold * (d - s) * (d - s) / (d * d);
}

}  // namespace

Energy::Energy(const Adjacency& adjacency, const TargetLengths& targets, const EnergyTerms& energy_terms)
    : terms(energy_terms), adjacency_(adjacency), targets_(targets) {
  const auto& faces = adjacency.faces;
  const size_t size = std::max(min_part, (faces.size() / max_parts / energy_block + 1) * energy_block);
  for (size_t begin = 0; begin < faces.size(); begin += size) {
    Part part{begin, std::min(begin + size, faces.size()), adjacency.vertex_count, 0};
    for (size_t f = part.begin; f < part.end; ++f) {
      part.first_vertex = std::min(part.first_vertex, std::ranges::min(faces[f]));
      part.last_vertex = std::max(part.last_vertex, std::ranges::max(faces[f]));
    }
    parts_.push_back(part);
  }
  corner_gradients_.resize(9 * std::min(size, faces.size()));
}

double Energy::face_energy(const Points& at, size_t face, double* corner_gradients) const {
  const Triangle& t = adjacency_.faces[face];
  const double target = targets_.face[face];
  const Triangle& wedges = adjacency_.wedges_of_faces()[face];
  const FaceFrame f = frame_of(at.points, at.normals, t, wedges, target);
  double energy = 0;
  double by_area = 0;
  std::array<double, 3> by_length{};
  std::array<Vec3, 3> gradient = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

  for (size_t k = 0; k < 3; ++k) {  // an edge belongs to its first face
    const size_t e = adjacency_.face_edges[face][(k + 1) % 3];
    if (adjacency_.edge_faces[e][0] != static_cast<int>(face)) continue;
    const double L = targets_.edge[e];
    const Potential u = spring_potential(f.length[k], L);
    energy += terms.string * u.value / (L * L);
    by_length[k] += terms.string * u.slope / (L * L);
  }
  if (terms.unfold > 0 && face_alignment(at.points, at.normals, t, wedges) < terms.unfold_below) {
    energy += unfold_energy(surface_normal(at.normals, wedges), f, terms, target, gradient);
  } else {
    if (terms.altitude > 0)
      energy += altitude_energy(f, terms.altitude, altitude_ratio * target, by_area, by_length);
    if (terms.angle > 0) energy += angle_energy(f, terms.angle, terms.angle_threshold, gradient);
  }
  if (!corner_gradients) return energy;

  for (size_t k = 0; k < 3; ++k) {
    const Vec3 by_edge = by_length[k] / f.length[k] * f.opposite[k];
    gradient[k] += by_area * f.normal.cross(f.opposite[k]);
    gradient[(k + 2) % 3] += by_edge;
    gradient[(k + 1) % 3] -= by_edge;
  }
  for (size_t k = 0; k < 3; ++k) Eigen::Map<Vec3>(corner_gradients + 3 * k) = gradient[k];
  return energy;
}

/// Up to four faces from `face` on, evaluated together where only strings and altitude springs act.
double Energy::energy_of_four(const Points& at, size_t face, double* corner_gradients) const {
  const size_t count = std::min(lane_count, adjacency_.faces.size() - face);
  if (terms.unfold <= 0 && terms.angle <= 0) {
    FaceSprings four;
    gather_faces(at, face, count, four);
    evaluate_face_springs(terms.string, terms.altitude, four);
    if (!four.flat) {
      if (corner_gradients)
        for (size_t i = 0; i < count; ++i)
          for (size_t k = 0; k < 9; ++k) corner_gradients[9 * i + k] = four.gradient[k * lane_count + i];
      return four.energy;
    }
  }
  double energy = 0;
  for (size_t i = 0; i < count; ++i)
    energy += face_energy(at, face + i, corner_gradients ? corner_gradients + 9 * i : nullptr);
  return energy;
}

void Energy::gather_faces(const Points& at, size_t face, size_t count, FaceSprings& four) const {
  for (size_t i = 0; i < lane_count; ++i) {
    const size_t f = face + std::min(i, count - 1);
    const Triangle& t = adjacency_.faces[f];
    for (size_t k = 0; k < 3; ++k) {
      const size_t e = adjacency_.face_edges[f][(k + 1) % 3];
      for (size_t d = 0; d < 3; ++d)
        four.corners[(3 * k + d) * lane_count + i] = at.points(static_cast<Eigen::Index>(d), t[k]);
      four.edge_target[k * lane_count + i] = targets_.edge[e];
      // An edge belongs to its first face.
      four.has_edge[k * lane_count + i] = i < count && adjacency_.edge_faces[e][0] == static_cast<int>(f);
    }
    four.face_target[i] = targets_.face[f];
    four.has_face[i] = i < count;
  }
}

/// Adds the gradients of the part's faces to those of the vertices, in the order of each vertex's fan.
void Energy::add_corner_gradients(const Part& part, Mat3X& gradient) const {
  const size_t first = part.first_vertex;
  parallel_for(static_cast<size_t>(part.last_vertex) + 1 - first, 2048, [&](size_t begin, size_t end) {
    for (size_t v = first + begin; v < first + end; ++v) {
      Vec3 sum = gradient.col(static_cast<Eigen::Index>(v));
      for (int face : adjacency_.vertex_faces[static_cast<int>(v)]) {
        const size_t f = face;
        if (f < part.begin || f >= part.end) continue;
        const size_t k = corner_of(adjacency_.faces[f], static_cast<int>(v));
        sum += Eigen::Map<const Vec3>(corner_gradients_.data() + 9 * (f - part.begin) + 3 * k);
      }
      gradient.col(static_cast<Eigen::Index>(v)) = sum;
    }
  });
}

double Energy::operator()(const Mat3X& points, const Mat3X& normals, Mat3X* gradient) {
  if (gradient) gradient->setZero(3, adjacency_.vertex_count);
  std::vector<double> energies((adjacency_.faces.size() + energy_block - 1) / energy_block);
  for (const Part& part : parts_) {
    const size_t blocks = (part.end - part.begin + energy_block - 1) / energy_block;
    parallel_for(blocks, 1, [&](size_t begin, size_t end) {
      for (size_t b = begin; b < end; ++b)
        for (size_t f = b * energy_block; f < std::min((b + 1) * energy_block, part.end - part.begin);
             f += lane_count)
          energies[part.begin / energy_block + b] += energy_of_four(
              {points, normals}, part.begin + f, gradient ? corner_gradients_.data() + 9 * f : nullptr);
    });
    if (gradient) add_corner_gradients(part, *gradient);
  }
  return std::accumulate(energies.begin(), energies.end(), 0.);
}

}  // namespace hooke
