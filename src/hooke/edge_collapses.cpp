#include "hooke/edge_collapses.h"

#include <algorithm>

#include "hooke/edge_queue.h"
#include "hooke/guards.h"
#include "hooke/least_angle.h"

namespace hooke {
namespace {

/// The worst of what the guards look at about an edge.
struct Worst {
  double angle = 180, alignment = 1, fold = 1, sagitta = 0, length = 0;
};

class Collapse {
 public:
  Collapse(AdaptingMesh& mesh, int half_edge, const CollapseOptions& options)
      : m_(mesh),
        t_(mesh.triangulation),
        options_(options),
        h_(half_edge),
        a_(t_.from(half_edge)),
        b_(t_.to(half_edge)) {}

  int run() {
    if (!may_vanish(a_) && !may_vanish(b_)) return -1;
    if (!is_welcome() || !t_.may_collapse(h_)) return -1;
    const int curve = is_rim(t_, h_) ? curve_of(m_, h_).curve : -1;
    collect_sides();
    measure_before();
    const int stays = staying_end(), goes = stays == a_ ? b_ : a_;
    const VertexPlace before(m_.placement, stays);
    const Vec3 way = m_.placement.points.col(goes) - before.point;
    for (double part : parts(stays, goes)) {
      if (part > 0) m_.retraction.moved(m_.placement, stays, part * way).write_to(m_.placement, stays);
      if (obeys(stays)) {
        if (stays != b_) copy_vertex(m_, stays, b_);
        t_.collapse(h_);
        if (curve >= 0) --m_.curve_edges.present[static_cast<size_t>(curve)];
        return b_;
      }
      before.write_to(m_.placement, stays);
    }
    return -1;
  }

 private:
  Freedom freedom(int v) const { return m_.constraints.freedom[static_cast<size_t>(v)]; }

  bool may_vanish(int v) const {
    if (freedom(v) == Freedom::fixed) return false;
    if (freedom(v) == Freedom::surface && !t_.on_boundary(v)) return true;
    return is_rim(t_, h_);
  }

  /// Does the valence stay fair, and do curve and corners keep what they want?
  bool is_welcome() const {
    const int twin = t_.twin(h_);
    if (t_.valence(a_) + t_.valence(b_) - (twin < 0 ? 3 : 4) > options_.valence) return false;
    for (int side : {h_, twin}) {
      if (side < 0) continue;
      const int apex = t_.apex(side);
      if (t_.valence(apex) <= m_.corner_valences[static_cast<size_t>(apex)]) return false;
    }
    if (!is_rim(t_, h_)) return true;
    const int curve = curve_of(m_, h_).curve;
    if (curve < 0) return true;
    const auto c = static_cast<size_t>(curve);
    return m_.curve_edges.present[c] > m_.curve_edges.wanted[c];
  }

  /// Which vertex is less free, or older.
  int staying_end() const {
    const auto rank = [&](int v) {
      const int origin = m_.origins[static_cast<size_t>(v)];
      return std::tuple(may_vanish(v), freedom(v) == Freedom::surface && !t_.on_boundary(v), origin < 0,
                        origin < 0 ? v : origin);
    };
    return rank(a_) < rank(b_) ? a_ : b_;
  }

  /// Where the vertex that stays may go, as parts of the way to the other.
  std::vector<double> parts(int stays, int goes) const {
    const bool alike =
        may_vanish(stays) && freedom(stays) == freedom(goes) && t_.on_boundary(stays) == t_.on_boundary(goes);
    return alike ? std::vector<double>{.5, 0, 1} : std::vector<double>{0};
  }

  /// The edges across from the vertex that stays, by the half-edges in the faces that stay.
  void collect_sides() {
    const int dying[] = {h_ / 3, t_.twin(h_) < 0 ? -1 : t_.twin(h_) / 3};
    for (int v : {a_, b_})
      for (int spoke : t_.outgoing(v)) {
        if (spoke / 3 == dying[0] || spoke / 3 == dying[1]) continue;
        sides_.push_back(Triangulation::next(spoke));
      }
  }

  const Triangle& face(int h) const { return t_.faces()[static_cast<size_t>(h / 3)]; }

  void look_at_face(const Triangle& f, Worst& worst) const {
    worst.angle = std::min(worst.angle, least_angle(m_.placement.points, {f}));
    worst.alignment = std::min(worst.alignment, face_alignment(m_.placement.points, m_.placement.normals, f));
  }

  void look_at_edge(int v, int w, Worst& worst) const {
    const Mat3X& X = m_.placement.points;
    const double target =
        .5 * (m_.vertex_length[static_cast<size_t>(v)] + m_.vertex_length[static_cast<size_t>(w)]);
    worst.length = std::max(worst.length, (X.col(v) - X.col(w)).norm() / target);
    worst.sagitta = std::max(worst.sagitta, edge_sagitta(X, m_.placement.normals, {v, w}) / target);
  }

  void look_across(const Triangle& f, int side, Worst& worst) const {
    if (const int twin = t_.twin(side); twin >= 0)
      worst.fold = std::min(worst.fold, cosine_between(m_.placement.points, f, face(twin)));
  }

  void measure_before() {
    for (int v : {a_, b_})
      for (int spoke : t_.outgoing(v)) {
        look_at_face(face(spoke), before_);
        for (int side : {spoke, Triangulation::next(spoke), Triangulation::previous(spoke)}) {
          look_across(face(spoke), side, before_);
          look_at_edge(t_.from(side), t_.to(side), before_);
        }
      }
  }

  bool obeys(int stays) const {
    Worst after;
    const auto about = [&](int side) { return Triangle{stays, t_.from(side), t_.to(side)}; };
    for (int side : sides_) {
      const Triangle f = about(side);
      look_at_face(f, after);
      look_across(f, side, after);
      look_at_edge(stays, f[1], after);
      look_at_edge(stays, f[2], after);
      for (int other : sides_)
        if (t_.to(side) == t_.from(other))
          after.fold = std::min(after.fold, cosine_between(m_.placement.points, f, about(other)));
    }
    return after.angle >= std::min(options_.angle, before_.angle) &&
           after.alignment >= std::min(options_.alignment, before_.alignment) &&
           after.fold >= std::min(options_.fold, before_.fold) &&
           after.length <= std::max(options_.longest, before_.length) &&
           after.sagitta <= std::max(options_.sagitta, before_.sagitta);
  }

  AdaptingMesh& m_;
  Triangulation& t_;
  const CollapseOptions& options_;
  int h_, a_, b_;
  std::vector<int> sides_;
  Worst before_;
};

}  // namespace

int collapse_edge(AdaptingMesh& m, int h, const CollapseOptions& options) {
  return Collapse(m, h, options).run();
}

int collapse_short_edges(AdaptingMesh& m, const CollapseOptions& options) {
  EdgeQueue queue(m.triangulation, [&](int h) { return options.shortest - relative_length(m, h); });
  int collapses = 0;
  for (int h = queue.pop(); h >= 0; h = queue.pop()) {
    const int v = collapse_edge(m, h, options);
    if (v < 0) continue;
    queue.push_spokes(v);
    ++collapses;
  }
  m.retraction.count();
  return collapses;
}

}  // namespace hooke
