#include "hooke/springs/energy.h"

#include <algorithm>
#include <numeric>

#include "hooke/core/parallel.h"
#include "hooke/core/simd.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/hooke_law.h"

namespace hooke {
namespace {

/// An edge, and the derivative of the energy by its length.
struct EdgeLanes {
  LaneVec vector;
  Lanes length, by_length;
};

HOOKE_INLINE void load_edges(const FaceSprings& f, EdgeLanes (&edges)[3]) {
  Lanes target;
  load(f.face_target, target);
  const Lanes floor = min_relative_length * target;
  for (std::size_t k = 0; k < 3; ++k) {
    LaneVec a, b;
    load(f.corners + 3 * lane_count * ((k + 1) % 3), lane_count, a);
    load(f.corners + 3 * lane_count * ((k + 2) % 3), lane_count, b);
    EdgeLanes& e = edges[k];
    e.vector = {b.x - a.x, b.y - a.y, b.z - a.z};
    dot(e.vector, e.vector, e.length);
    take_sqrt(e.length);
    e.length = e.length < floor ? floor : e.length;  // NaN stays
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

HOOKE_SIMD void evaluate_face_springs(const EnergyTerms& terms, FaceSprings& f) {
  EdgeLanes edges[3];
  load_edges(f, edges);
  LaneVec normal;
  Lanes area, target;  // doubled
  cross(edges[1].vector, edges[2].vector, normal);
  dot(normal, normal, area);
  take_sqrt(area);
  load(f.face_target, target);
  const Lanes floor = min_relative_length * target * target;
  const LaneMask is_flat = area <= floor;
  f.needs_normals = any(is_flat) && !f.has_normals;
  if (f.needs_normals) return;
  if (f.has_normals) {
    LaneVec up;
    load(f.surface_normal, lane_count, up);
    normal = {is_flat ? floor * up.x : normal.x, is_flat ? floor * up.y : normal.y,
              is_flat ? floor * up.z : normal.z};
    area = is_flat ? floor : area;
  }

  Lanes energy = {}, by_area = {};
  add_strings(f, terms.string, edges, energy);
  if (terms.altitude > 0) add_altitudes(f, terms.altitude, area, edges, by_area, energy);
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

}  // namespace

Energy::Energy(const Adjacency& adjacency, const TargetLengths& targets, const EnergyTerms& terms)
    : adjacency_(adjacency), targets_(targets), terms_(terms) {
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

/// Up to four faces from `face` on, evaluated together.
double Energy::energy_of_four(const Points& at, size_t face, double* corner_gradients) const {
  const size_t count = std::min(lane_count, adjacency_.faces.size() - face);
  FaceSprings four;
  gather_faces(at, face, count, four);
  evaluate_face_springs(terms_, four);
  if (four.needs_normals) {
    gather_normals(at.normals, face, count, four);
    evaluate_face_springs(terms_, four);
  }
  if (corner_gradients)
    for (size_t i = 0; i < count; ++i)
      for (size_t k = 0; k < 9; ++k) corner_gradients[9 * i + k] = four.gradient[k * lane_count + i];
  return four.energy;
}

/// The unit sums of the surface normals at the corners.
void Energy::gather_normals(const Mat3X& normals, size_t face, size_t count, FaceSprings& four) const {
  for (size_t i = 0; i < lane_count; ++i) {
    const Triangle& t = adjacency_.wedges_of_faces()[face + std::min(i, count - 1)];
    const Vec3 sum = (normals.col(t[0]) + normals.col(t[1]) + normals.col(t[2])).stableNormalized();
    for (size_t d = 0; d < 3; ++d)
      four.surface_normal[d * lane_count + i] = sum[static_cast<Eigen::Index>(d)];
  }
  four.has_normals = true;
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
