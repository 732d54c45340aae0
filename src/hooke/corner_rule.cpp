#include "hooke/corner_rule.h"

#include <cmath>
#include <numbers>

#include "hooke/guards.h"
#include "hooke/polish.h"
#include "hooke/topology.h"

namespace hooke {
namespace {

constexpr double push = .1;  // in target lengths
constexpr int most_pushes = 8;

/// One corner and what can be done about its valence.
class Corner {
 public:
  Corner(FlippingMesh& mesh, const FlipGuardOptions& options, int vertex)
      : m_(mesh), t_(mesh.triangulation), options_(options), vertex_(vertex) {}

  int settle() {
    const int wanted = m_.corner_valences[static_cast<size_t>(vertex_)];
    while (t_.valence(vertex_) < wanted && flip_best(sides_across())) ++flips_;
    while (t_.valence(vertex_) > wanted) {
      if (!flip_best(inner_spokes()) && !free_inner_neighbour() && !push_inner_neighbour() && !pull_sides())
        break;
      ++flips_;
    }
    return flips_;
  }

 private:
  std::vector<int> inner_spokes() const {
    std::vector<int> spokes;
    for (int h : t_.outgoing(vertex_))
      if (t_.twin(h) >= 0) spokes.push_back(h);
    return spokes;
  }

  std::vector<int> sides_across() const {
    std::vector<int> sides;
    for (int h : t_.outgoing(vertex_)) sides.push_back(Triangulation::next(h));
    return sides;
  }

  /// Flips the edge whose new faces have the largest least angle.
  bool flip_best(const std::vector<int>& half_edges) {
    int best = -1;
    double best_angle = -1;
    for (int h : half_edges) {
      if (!may_flip(m_, h, options_)) continue;
      const int a = t_.from(h), b = t_.to(h), c = t_.apex(h), d = t_.apex(t_.twin(h));
      const double angle = least_angle(m_.placement.points, {{c, a, d}, {d, b, c}});
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
      if (t_.valence(w) != 3 || t_.on_boundary(w)) continue;
      for (int side : t_.outgoing(w)) {
        const int across = Triangulation::next(side);
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
      if (!t_.on_boundary(w) && shift({w}, push)) return true;
    }
    return false;
  }

  bool pull_sides() {
    const std::vector<int> spokes = t_.outgoing(vertex_);
    return shift({t_.to(spokes.front()), t_.apex(spokes.back())}, -push);
  }

  /// Moves the vertices along the lines from the corner, bit by bit, until a spoke can be flipped.
  bool shift(const std::vector<int>& vertices, double part) {
    std::vector<VertexPlace> before;
    for (int v : vertices) before.emplace_back(m_.placement, v);
    for (int i = 0; i < most_pushes && shift_once(vertices, part); ++i)
      if (flip_best(inner_spokes())) return true;
    for (size_t i = 0; i < vertices.size(); ++i) before[i].write_to(m_.placement, vertices[i]);
    return false;
  }

  bool shift_once(const std::vector<int>& vertices, double part) {
    Mat3X& X = m_.placement.points;
    for (int v : vertices) {
      if (m_.constraints.freedom[static_cast<size_t>(v)] == Freedom::fixed) continue;
      const std::vector<double> before = alignments(v);
      const Vec3 away = (X.col(v) - X.col(vertex_)).normalized();
      const double length = part * m_.vertex_length[static_cast<size_t>(v)];
      m_.retraction.moved(m_.placement, v, length * away).write_to(m_.placement, v);
      const std::vector<double> after = alignments(v);
      for (size_t i = 0; i < before.size(); ++i)
        if (after[i] < std::min(options_.alignment, before[i])) return false;
    }
    return true;
  }

  std::vector<double> alignments(int v) const {
    std::vector<double> values;
    for (int h : t_.outgoing(v))
      values.push_back(
          face_alignment(m_.placement.points, m_.placement.normals, t_.faces()[static_cast<size_t>(h / 3)]));
    return values;
  }

  FlippingMesh& m_;
  Triangulation& t_;
  const FlipGuardOptions& options_;
  int vertex_;
  int flips_ = 0;
};

}  // namespace

std::vector<int> corner_valences(const Mat3X& points, const Connectivity& c, const Constraints& constraints,
                                 double corner_angle) {
  const std::vector<char> boundary = boundary_vertices(c);
  std::vector<int> wanted(static_cast<size_t>(c.vertex_count), 0);
  for (int v = 0; v < c.vertex_count; ++v) {
    if (!boundary[static_cast<size_t>(v)]) continue;
    if (constraints.freedom[static_cast<size_t>(v)] != Freedom::fixed) continue;
    double angle = 0;
    for (int f : c.vertex_faces[v]) {
      const Triangle& t = c.faces[static_cast<size_t>(f)];
      const size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      const Vec3 a = points.col(t[(k + 1) % 3]) - points.col(v);
      const Vec3 b = points.col(t[(k + 2) % 3]) - points.col(v);
      angle += std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
    }
    if (std::abs(180 - angle) < corner_angle) continue;
    wanted[static_cast<size_t>(v)] = 1 + std::max(1, static_cast<int>(std::lround(angle / 60)));
  }
  return wanted;
}

int force_corners(FlippingMesh& m, const FlipGuardOptions& options) {
  int flips = 0;
  for (size_t v = 0; v < m.corner_valences.size(); ++v)
    if (m.corner_valences[v] > 0 && m.triangulation.valence(static_cast<int>(v)) > 0)
      flips += Corner(m, options, static_cast<int>(v)).settle();
  m.retraction.count();
  return flips;
}

}  // namespace hooke
