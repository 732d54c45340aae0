#include "hooke/connectivity/lloyd_flow.h"

#include <algorithm>
#include <cmath>

#include "hooke/connectivity/corner_flips.h"
#include "hooke/connectivity/edge_flips.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/final_projection.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/wedges.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

/// Mass and first moment with respect to the vertex.
struct Moments {
  double mass = 0;
  Vec3 moment = Vec3::Zero();

  /// Adds the triangle (0, a, b) of signed area, with densities at its corners and linear between them.
  void add(double area, const Vec3& a, const Vec3& b, double at_0, double at_a, double at_b) {
    const double sum = at_0 + at_a + at_b;
    mass += area * sum / 3;
    moment += area / 12 * ((sum + at_a) * a + (sum + at_b) * b);
  }
};

/// The data of a face for Voronoi cells.
struct FaceCell {
  Vec3 circumcentre = Vec3::Zero();               // relative to the first corner
  Vec3 cotangent = Vec3::Constant(std::nan(""));  // of the angle opposite each edge, NaN without area
};

FaceCell cell_of(const Mat3X& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]), u = points.col(t[1]) - a, v = points.col(t[2]) - a, w = v - u;
  const double area = u.cross(v).norm();  // doubled
  if (!(area > 0)) return {};
  const double at_0 = u.dot(v), at_1 = -u.dot(w), at_2 = v.dot(w);
  // The barycentric weights of the circumcentre are proportional to a^2 (b^2 + c^2 - a^2), with a the edge
  // opposite the corner.
  const double scale = 1 / (2 * area * area);
  return {scale * (v.squaredNorm() * at_1 * u + u.squaredNorm() * at_2 * v), Vec3(at_2, at_0, at_1) / area};
}

/// Non-Delaunay edges, whose opposite angles sum to more than pi: Voronoi cells there do not consist of
/// kites. A feature edge, which bounds the cells, counts if an opposite angle is obtuse.
std::vector<char> non_delaunay_edges(const std::vector<FaceCell>& cells, const Adjacency& c) {
  constexpr double min_cotangent = -1e-9;
  std::vector<char> non_delaunay(c.edges.size());
  parallel_for(c.edges.size(), 2048, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      std::array<double, 2> cotangent = {0, 0};  // that of a right angle where there is no face
      for (size_t i = 0; i < 2; ++i) {
        if (c.edge_faces[e][i] < 0) continue;
        const size_t face = c.edge_faces[e][i];
        const Eigen::Index k = corner_of(c.face_edges[face], static_cast<int>(e));
        cotangent[i] = cells[face].cotangent[k];
      }
      const bool is_delaunay = c.is_feature_edge(static_cast<int>(e))
                                   ? std::min(cotangent[0], cotangent[1]) >= min_cotangent
                                   : cotangent[0] + cotangent[1] >= min_cotangent;
      non_delaunay[e] = !is_delaunay;
    }
  });
  return non_delaunay;
}

std::vector<FaceCell> cells_of(const Mat3X& points, const Adjacency& c) {
  std::vector<FaceCell> cells(c.faces.size());
  parallel_for(cells.size(), 2048, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) cells[f] = cell_of(points, c.faces[f]);
  });
  return cells;
}

class Lloyd {
 public:
  Lloyd(const SurfacePositions& at, const Adjacency& c, const std::vector<double>& length)
      : X_(at.points),
        c_(c),
        length_(length),
        even_(std::ranges::adjacent_find(length, std::ranges::not_equal_to()) == length.end()),
        cells_(cells_of(X_, c)),
        non_delaunay_(non_delaunay_edges(cells_, c)) {}

  Vec3 step(int v) const {
    if (c_.vertex_faces[v].empty()) return Vec3::Zero();
    const std::array<int, 2> neighbours = feature_neighbours(v);
    if (neighbours[1] >= 0) return boundary_step(v, neighbours[0], neighbours[1]);
    Moments cell = has_voronoi_cell(v) ? voronoi_cell(v) : Moments{};
    if (!(cell.mass > 0)) cell = faces_about(v);
    if (!(cell.mass > 0)) return Vec3::Zero();
    return lloyd_over_relaxation / cell.mass * cell.moment;
  }

 private:
  /// The two neighbours along feature edges; -1 for an inner vertex.
  std::array<int, 2> feature_neighbours(int v) const {
    std::array<int, 2> neighbours = {-1, -1};
    size_t count = 0;
    for (int e : c_.vertex_edges[v])
      if (count < 2 && c_.is_feature_edge(e)) neighbours[count++] = c_.other_end(e, v);
    return neighbours;
  }

  Vec3 boundary_step(int v, int a, int b) const {
    const double to_a = length(v) + length(a), to_b = length(v) + length(b);
    const Vec3 along = X_.col(b) - X_.col(a);
    const double squared = along.squaredNorm();
    if (!(squared > 0)) return Vec3::Zero();
    const double t = (X_.col(v) - X_.col(a)).dot(along) / squared;
    return lloyd_boundary_relaxation * (to_a / (to_a + to_b) - t) * along;
  }

  bool has_voronoi_cell(int v) const {
    for (int f : c_.vertex_faces[v])
      for (int e : c_.face_edges[f])
        if (non_delaunay_[e]) return false;
    return true;
  }

  /// The kite of a face has as corners the vertex, the midpoints of two edges and the circumcentre. The half
  /// of it at an edge of length l opposite an angle has the signed area l^2 / 8 cot(angle).
  Moments voronoi_cell(int v) const {
    Moments cell;
    for (int f : c_.vertex_faces[v]) {
      const size_t k = corner_of(c_.faces[f], v);
      const auto [p, q] = others(f, k);
      const FaceCell& face = cells_[f];
      const Vec3 a = X_.col(p) - X_.col(v), b = X_.col(q) - X_.col(v);
      const Vec3 o = X_.col(c_.faces[f][0]) - X_.col(v) + face.circumcentre;
      const double beside_a = .125 * a.squaredNorm() * face.cotangent[static_cast<Eigen::Index>(k)];
      const double beside_b = .125 * b.squaredNorm() * face.cotangent[static_cast<Eigen::Index>((k + 2) % 3)];
      const double at_v = density(length(v)), at_o = density((length(v) + length(p) + length(q)) / 3);
      cell.add(beside_a, .5 * a, o, at_v, density(.5 * (length(v) + length(p))), at_o);
      cell.add(beside_b, o, .5 * b, at_v, at_o, density(.5 * (length(v) + length(q))));
    }
    return cell;
  }

  Moments faces_about(int v) const {
    Moments faces;
    for (int f : c_.vertex_faces[v]) {
      const auto [p, q] = others(f, corner_of(c_.faces[f], v));
      const Vec3 a = X_.col(p) - X_.col(v), b = X_.col(q) - X_.col(v);
      faces.add(.5 * a.cross(b).norm(), a, b, density(length(v)), density(length(p)), density(length(q)));
    }
    return faces;
  }

  /// The vertices that follow corner k of the face.
  Edge others(int face, size_t k) const {
    const Triangle& t = c_.faces[face];
    return {t[(k + 1) % 3], t[(k + 2) % 3]};
  }

  double density(double length) const { return even_ ? 1 : 1 / (length * length * length * length); }

  double length(int v) const { return length_[v]; }

  const Mat3X& X_;
  const Adjacency& c_;
  const std::vector<double>& length_;
  bool even_;  // the same target length everywhere
  std::vector<FaceCell> cells_;
  std::vector<char> non_delaunay_;
};

}  // namespace

Mat3X lloyd_step(const SurfacePositions& positions, const Adjacency& adjacency,
                 const std::vector<double>& vertex_length) {
  const Lloyd lloyd(positions, adjacency, vertex_length);
  Mat3X step(3, positions.points.cols());
  parallel_for(step.cols(), 512, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      step.col(static_cast<Eigen::Index>(v)) = lloyd.step(static_cast<int>(v));
  });
  return step;
}

namespace {

/// Rounds between flips of corners, after the first quarter of the rounds.
constexpr int corner_every = 5;

/// One guarded Lloyd step. Returns the number of vertices limited by guards.
int move_vertices(WorkingMesh& m, const Adjacency& adjacency, const ShapeLimits& limits) {
  constexpr double max_move = .3;  // in target lengths
  const TargetLengths targets = spread_target_lengths(adjacency, m.vertices.vertex_length);
  Mat3X step = lloyd_step(m.vertices.positions, adjacency, m.vertices.vertex_length);
  m.retraction.constrain(m.vertices.positions, step);
  cap_displacement(m.vertices.vertex_length, max_move, step);
  const Guards guards(adjacency, targets, limits);
  SurfacePositions moved;
  const auto limited_steps = guards.step(m.retraction, m.vertices.positions, step, moved).size();
  m.vertices.positions = std::move(moved);
  return static_cast<int>(limited_steps);
}

}  // namespace

LloydFlowResult flow(WorkingMesh& m, int rounds, const ShapeLimits& limits, const Observer& observer) {
  LloydFlowResult result;
  result.interrupted = observer && !observer({.stage = "flow"});
  const auto connect = [&m] {
    Adjacency c = adjacency_of(m.halfedges, static_cast<int>(m.vertices.positions.points.cols()));
    split_wedges(c, m.vertices.constraints.creases);
    return c;
  };
  Adjacency adjacency = connect();
  while (result.rounds < rounds && !result.interrupted) {
    int flips = flip_to_delaunay(m);
    if (result.rounds >= rounds / 4 && result.rounds % corner_every == 0) flips += flip_corners_to_valence(m);
    if (flips > 0) adjacency = connect();
    result.limited_steps += move_vertices(m, adjacency, limits);
    if (m.after_move) m.after_move();
    result.flips += flips;
    ++result.rounds;
    result.interrupted = observer && !observer({.stage = "flow", .step = result.rounds});
  }
  const TargetLengths targets = spread_target_lengths(adjacency, m.vertices.vertex_length);
  project_drifted(Guards(adjacency, targets, limits), m.retraction, m.vertices.positions);
  result.flips += flip_to_delaunay(m);
  return result;
}

}  // namespace hooke
