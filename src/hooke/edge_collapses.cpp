#include "hooke/edge_collapses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hooke/edge_queue.h"
#include "hooke/guards.h"
#include "hooke/least_angle.h"

namespace hooke {
namespace {

/// The worst of what the guards look at about an edge.
struct Worst {
  double cotangent = 0;  // of the least angle
  double alignment = 1, fold = 1, sagitta = 0, length = 0;
};

Worst limits_of(const CollapseOptions& o) {
  return {1 / std::tan(o.angle * std::numbers::pi / 180), o.alignment, o.fold, o.sagitta, o.longest};
}

Worst worse_of(const Worst& a, const Worst& b) {
  return {std::max(a.cotangent, b.cotangent), std::min(a.alignment, b.alignment), std::min(a.fold, b.fold),
          std::max(a.sagitta, b.sagitta), std::max(a.length, b.length)};
}

bool is_within(const Worst& w, const Worst& limits) {
  return w.cotangent <= limits.cotangent && w.alignment >= limits.alignment && w.fold >= limits.fold &&
         w.sagitta <= limits.sagitta && w.length <= limits.length;
}

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
    const int stays = staying_end(), goes = stays == a_ ? b_ : a_;
    collect_ring(stays);
    const VertexPlace here(m_.placement, stays);
    const Vec3 way = m_.placement.points.col(goes) - here.point;
    const Worst limits = limits_of(options_);
    std::optional<Worst> looser;
    for (double part : parts(stays, goes)) {
      const VertexPlace there = part > 0 ? m_.retraction.moved(m_.placement, stays, part * way) : here;
      there.write_to(m_.placement, stays);
      const Worst after = worst_after();
      if (!is_within(after, limits)) {
        here.write_to(m_.placement, stays);
        if (!looser) looser = loosened(limits);
        if (!is_within(after, *looser)) continue;
        there.write_to(m_.placement, stays);
      }
      t_.collapse(h_, stays);
      if (curve >= 0) --m_.curve_edges.present[static_cast<size_t>(curve)];
      return stays;
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
      const CornerValence apex = corner_valence(m_.flipping(), Triangulation::previous(side));
      if (apex.has <= apex.wanted) return false;
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

  /// A face, the sides of its corners, and its half-edge across from the first of them.
  struct Face {
    Triangle corners;
    Triangle sides;
    int across;
  };

  Face face_at(int spoke) const {
    const int next = Triangulation::next(spoke), previous = Triangulation::previous(spoke);
    return {{t_.from(spoke), t_.from(next), t_.from(previous)},
            {t_.side(spoke), t_.side(next), t_.side(previous)},
            next};
  }

  /// The faces that stay, as they will be about the vertex that stays.
  void collect_ring(int stays) {
    const int dying[] = {h_ / 3, t_.twin(h_) < 0 ? -1 : t_.twin(h_) / 3};
    for (int v : {a_, b_})
      for (int spoke : t_.outgoing(v)) {
        if (spoke / 3 == dying[0] || spoke / 3 == dying[1]) continue;
        Face f = face_at(spoke);
        f.corners[0] = stays;
        f.sides[0] = t_.side_after_collapse(h_, stays, spoke);
        ring_.push_back(f);
      }
  }

  void look_at_face(const Face& f, Worst& worst) const {
    worst.cotangent = std::max(worst.cotangent, greatest_cotangent(m_.placement.points, f.corners));
    worst.alignment = std::min(worst.alignment,
                               face_alignment(m_.placement.points, m_.placement.normals, f.corners, f.sides));
  }

  /// The edge from corner k to the next.
  void look_at_edge(const Face& f, size_t k, Worst& worst) const {
    const Mat3X& X = m_.placement.points;
    const Edge edge = {f.corners[k], f.corners[(k + 1) % 3]};
    const double target = .5 * (m_.vertex_length[static_cast<size_t>(edge[0])] +
                                m_.vertex_length[static_cast<size_t>(edge[1])]);
    const double sagitta = edge_sagitta(X, m_.placement.normals, edge, {f.sides[k], f.sides[(k + 1) % 3]});
    worst.length = std::max(worst.length, (X.col(edge[0]) - X.col(edge[1])).norm() / target);
    worst.sagitta = std::max(worst.sagitta, sagitta / target);
  }

  /// The fold across one side of a face. Creases are folds that shall be.
  void look_across(const Triangle& corners, int side, Worst& worst) const {
    const int twin = t_.twin(side);
    if (twin < 0 || t_.is_constrained(side)) return;
    const Triangle& across = t_.faces()[static_cast<size_t>(twin / 3)];
    worst.fold = std::min(worst.fold, cosine_between(m_.placement.points, corners, across));
  }

  Worst worst_before() const {
    Worst worst;
    for (int v : {a_, b_})
      for (int spoke : t_.outgoing(v)) {
        const Face f = face_at(spoke);
        look_at_face(f, worst);
        for (int side : {spoke, f.across, Triangulation::previous(spoke)})
          look_across(f.corners, side, worst);
        for (size_t k : {0, 1, 2}) look_at_edge(f, k, worst);
      }
    return worst;
  }

  /// What is worse than it should be may stay as it is, unless the options insist.
  Worst loosened(const Worst& limits) const {
    Worst loose = worse_of(limits, worst_before());
    if (options_.insist_on_alignment) loose.alignment = limits.alignment;
    return loose;
  }

  Worst worst_after() const {
    Worst worst;
    for (const Face& f : ring_) {
      look_at_face(f, worst);
      look_across(f.corners, f.across, worst);
      look_at_edge(f, 0, worst);
      look_at_edge(f, 2, worst);
      for (const Face& g : ring_) {
        const bool crease = t_.is_constrained(Triangulation::next(f.across)) ||
                            t_.is_constrained(Triangulation::previous(g.across));
        if (f.corners[2] == g.corners[1] && !crease)
          worst.fold = std::min(worst.fold, cosine_between(m_.placement.points, f.corners, g.corners));
      }
    }
    return worst;
  }

  AdaptingMesh& m_;
  Triangulation& t_;
  const CollapseOptions& options_;
  int h_, a_, b_;
  std::vector<Face> ring_;
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
    queue.push_about(v);
    ++collapses;
  }
  m.retraction.count();
  return collapses;
}

}  // namespace hooke
