#include "hooke/connectivity/corner_flips.h"

#include <cmath>
#include <numbers>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

constexpr double push = .1;  // in target lengths
constexpr int max_pushes = 8;

/// One corner and what can be done about its valence.
class Corner {
 public:
  Corner(FlippableMesh& mesh, const FlipGuardOptions& options, int vertex, int wedge)
      : m_(mesh), t_(mesh.halfedges), options_(options), vertex_(vertex), wedge_(wedge) {}

  int match_valence() {
    const int wanted = m_.corner_valences[static_cast<size_t>(wedge_)];
    while (valence() < wanted && flip_best(sides_across())) ++flips_;
    while (valence() > wanted) {
      if (!flip_best(inner_spokes()) && !free_inner_neighbour() && !push_inner_neighbour() && !pull_sides())
        break;
      ++flips_;
    }
    return flips_;
  }

 private:
  ShortList spokes() const {
    for (int h : t_.outgoing(vertex_))
      if (t_.wedge(h) == wedge_) return t_.sector(h);
    return {};
  }

  int valence() const { return static_cast<int>(spokes().size()) + 1; }

  ShortList inner_spokes() const {
    ShortList inner;
    for (int h : spokes())
      if (!t_.is_feature_edge(h)) inner.push_back(h);
    return inner;
  }

  ShortList sides_across() const {
    ShortList wedges;
    for (int h : spokes()) wedges.push_back(HalfedgeMesh::next(h));
    return wedges;
  }

  /// Flips the edge whose new faces have the largest least angle.
  bool flip_best(const ShortList& half_edges) {
    int best = -1;
    double best_angle = -1;
    for (int h : half_edges) {
      if (!may_flip(m_, h, options_)) continue;
      const int a = t_.from(h), b = t_.to(h), c = t_.opposite_vertex(h), d = t_.opposite_vertex(t_.twin(h));
      const double angle = min_angle(m_.positions.points, {{c, a, d}, {d, b, c}});
      if (angle <= best_angle) continue;
      best = h;
      best_angle = angle;
    }
    if (best >= 0) t_.flip(best);
    return best >= 0;
  }

  /// An inner neighbour with three edges cannot lose one: the edge across it goes to it first.
  bool free_inner_neighbour() {
    for (int h : inner_spokes()) {
      const int w = t_.to(h);
      if (t_.valence(w) != 3 || is_on_border(w)) continue;
      for (int wedge : t_.outgoing(w)) {
        const int across = HalfedgeMesh::next(wedge);
        if (t_.from(across) == vertex_ || t_.to(across) == vertex_) continue;
        if (!may_flip(m_, across, options_)) continue;
        t_.flip(across);
        ++flips_;
        if (flip_best(inner_spokes())) return true;
        break;
      }
    }
    return false;
  }

  bool push_inner_neighbour() {
    for (int h : inner_spokes()) {
      const int w = t_.to(h);
      if (!is_on_border(w) && shift({w}, push)) return true;
    }
    return false;
  }

  bool pull_sides() {
    const ShortList all = spokes();
    return shift({t_.to(all.front()), t_.opposite_vertex(all.back())}, -push);
  }

  bool is_on_border(int vertex) const { return t_.on_boundary(vertex) || t_.on_crease(vertex); }

  /// Moves the vertices along the lines from the corner, bit by bit, until a spoke can be flipped.
  bool shift(const std::vector<int>& vertices, double part) {
    std::vector<SurfacePosition> before;
    for (int v : vertices) before.emplace_back(m_.positions, v);
    for (int i = 0; i < max_pushes && shift_once(vertices, part); ++i)
      if (flip_best(inner_spokes())) return true;
    for (size_t i = 0; i < vertices.size(); ++i) before[i].write_to(m_.positions, vertices[i]);
    return false;
  }

  bool shift_once(const std::vector<int>& vertices, double part) {
    Mat3X& X = m_.positions.points;
    for (int v : vertices) {
      if (m_.constraints.freedom[static_cast<size_t>(v)] == Freedom::fixed) continue;
      const std::vector<double> before = alignments(v);
      const Vec3 away = (X.col(v) - X.col(vertex_)).normalized();
      const double length = part * m_.vertex_length[static_cast<size_t>(v)];
      m_.retraction.moved(m_.positions, v, length * away).write_to(m_.positions, v);
      const std::vector<double> after = alignments(v);
      for (size_t i = 0; i < before.size(); ++i)
        if (after[i] < std::min(options_.alignment, before[i])) return false;
    }
    return true;
  }

  std::vector<double> alignments(int v) const {
    std::vector<double> values;
    for (int h : t_.outgoing(v)) {
      const auto f = static_cast<size_t>(h / 3);
      values.push_back(
          face_alignment(m_.positions.points, m_.positions.normals, t_.faces()[f], t_.wedges()[f]));
    }
    return values;
  }

  FlippableMesh& m_;
  HalfedgeMesh& t_;
  const FlipGuardOptions& options_;
  int vertex_;
  int wedge_;
  int flips_ = 0;
};

}  // namespace

int flip_corners_to_valence(FlippableMesh& m, const FlipGuardOptions& options) {
  const int vertices = static_cast<int>(m.vertex_length.size());
  int flips = 0;
  for (size_t wedge = 0; wedge < m.corner_valences.size(); ++wedge) {
    const int i = static_cast<int>(wedge);
    const int v = i < vertices ? i : m.constraints.extra_wedges[static_cast<size_t>(i - vertices)];
    if (m.corner_valences[wedge] > 0 && m.halfedges.valence(v) > 0)
      flips += Corner(m, options, v, i).match_valence();
  }
  m.retraction.count();
  return flips;
}

}  // namespace hooke
