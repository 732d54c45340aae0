#include "hooke/connectivity/corner_flips.h"

#include <cmath>
#include <numbers>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/local_shape.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

constexpr double push = .1;  // displacement per step, in target lengths
constexpr int max_pushes = 8;

/// Matches the valence of one corner to its target.
class Corner {
 public:
  Corner(WorkingMesh& mesh, int vertex, int wedge)
      : m_(mesh), t_(mesh.halfedges), vertex_(vertex), wedge_(wedge) {}

  int match_valence() {
    const int target = m_.vertices.corner_valences[wedge_];
    while (valence() < target && flip_best(opposite_edges())) ++flips_;
    while (valence() > target) {
      if (!flip_best(inner_edges()) && !free_inner_neighbour() && !push_inner_neighbour()) break;
      ++flips_;
    }
    return flips_;
  }

 private:
  SmallIntList corner_edges() const {
    for (int h : t_.outgoing(vertex_))
      if (t_.wedge(h) == wedge_) return t_.wedge_halfedges(h);
    return {};
  }

  int valence() const { return static_cast<int>(corner_edges().size()) + 1; }

  SmallIntList inner_edges() const {
    SmallIntList inner;
    for (int h : corner_edges())
      if (!t_.is_feature_edge(h)) inner.push_back(h);
    return inner;
  }

  SmallIntList opposite_edges() const {
    SmallIntList half_edges;
    for (int h : corner_edges()) half_edges.push_back(HalfedgeMesh::next(h));
    return half_edges;
  }

  /// Flips the edge whose new faces have the largest minimum angle.
  bool flip_best(const SmallIntList& half_edges) {
    int best = -1;
    double best_angle = -1;
    for (int h : half_edges) {
      if (!may_flip(m_, h)) continue;
      const int a = t_.from(h), b = t_.to(h), c = t_.opposite_vertex(h), d = t_.opposite_vertex(t_.twin(h));
      const double angle = min_angle(m_.vertices.positions.points, {{c, a, d}, {d, b, c}});
      if (angle <= best_angle) continue;
      best = h;
      best_angle = angle;
    }
    if (best >= 0) t_.flip(best);
    return best >= 0;
  }

  /// An inner neighbour of valence 3 cannot lose an edge: an opposite edge is first flipped to it.
  bool free_inner_neighbour() {
    for (int h : inner_edges()) {
      const int w = t_.to(h);
      if (t_.valence(w) != 3 || is_on_feature(w)) continue;
      for (int outgoing : t_.outgoing(w)) {
        const int across = HalfedgeMesh::next(outgoing);
        if (t_.from(across) == vertex_ || t_.to(across) == vertex_) continue;
        if (!may_flip(m_, across)) continue;
        t_.flip(across);
        ++flips_;
        if (flip_best(inner_edges())) return true;
        break;
      }
    }
    return false;
  }

  bool push_inner_neighbour() {
    for (int h : inner_edges()) {
      const int w = t_.to(h);
      if (!is_on_feature(w) && push_away(w)) return true;
    }
    return false;
  }

  bool is_on_feature(int vertex) const { return t_.on_boundary(vertex) || t_.on_crease(vertex); }

  /// Moves the vertex away from the corner, step by step, until an edge at the corner can be flipped; else
  /// moves it back.
  bool push_away(int v) {
    const SurfacePosition before(m_.vertices.positions, v);
    for (int i = 0; i < max_pushes && push_once(v); ++i)
      if (flip_best(inner_edges())) return true;
    before.write_to(m_.vertices.positions, v);
    return false;
  }

  bool push_once(int v) {
    const Mat3X& X = m_.vertices.positions.points;
    if (m_.vertices.constraints.freedom[v] == Freedom::fixed) return true;
    const std::vector<double> before = alignments(v);
    const Vec3 away = (X.col(v) - X.col(vertex_)).normalized();
    const double length = push * m_.vertices.vertex_length[v];
    m_.retraction.moved(m_.vertices.positions, v, length * away).write_to(m_.vertices.positions, v);
    const std::vector<double> after = alignments(v);
    for (size_t i = 0; i < before.size(); ++i)
      if (after[i] < std::min(ShapeLimits().alignment, before[i])) return false;
    return true;
  }

  std::vector<double> alignments(int v) const {
    std::vector<double> values;
    for (int h : t_.outgoing(v)) {
      const size_t f = h / 3;
      values.push_back(face_alignment(m_.vertices.positions.points, m_.vertices.positions.normals,
                                      t_.faces()[f], t_.wedges()[f]));
    }
    return values;
  }

  WorkingMesh& m_;
  HalfedgeMesh& t_;
  int vertex_;
  int wedge_;
  int flips_ = 0;
};

}  // namespace

int flip_corners_to_valence(WorkingMesh& m) {
  const int vertices = static_cast<int>(m.vertices.vertex_length.size());
  int flips = 0;
  for (size_t wedge = 0; wedge < m.vertices.corner_valences.size(); ++wedge) {
    const int i = static_cast<int>(wedge);
    const int v = i < vertices ? i : m.vertices.constraints.extra_wedges[i - vertices];
    if (m.vertices.corner_valences[wedge] > 0 && m.halfedges.valence(v) > 0)
      flips += Corner(m, v, i).match_valence();
  }
  m.retraction.count();
  return flips;
}

}  // namespace hooke
