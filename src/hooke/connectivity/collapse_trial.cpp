#include "hooke/connectivity/collapse_trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

#include "hooke/connectivity/merged_ring.h"

namespace hooke {
namespace {

WorstShape limits_of(const CollapseOptions& o) {
  return {1 / std::tan(o.angle * std::numbers::pi / 180), o.alignment, o.fold, o.sagitta};
}

class Trial {
 public:
  Trial(const AdaptingMesh& mesh, int half_edge, const CollapseOptions& options)
      : m_(mesh),
        t_(mesh.triangulation),
        options_(options),
        h_(half_edge),
        a_(t_.from(half_edge)),
        b_(t_.to(half_edge)) {}

  std::optional<Collapse> run() const {
    if (!may_vanish(a_) && !may_vanish(b_)) return std::nullopt;
    if (!is_welcome() || !t_.may_collapse(h_)) return std::nullopt;
    const Rings rings = {t_.neighbours(a_), t_.neighbours(b_)};
    const int stays = staying_end(), goes = stays == a_ ? b_ : a_;
    const VertexPlace here(m_.placement, stays);
    const Vec3 way = m_.placement.points.col(goes) - here.point;
    std::optional<MergedRing> ring;
    std::optional<WorstShape> looser;
    for (double part : parts(stays, goes)) {
      if (leaves_long_edges(rings, stays, here.point + part * way)) continue;
      if (!ring) ring.emplace(m_, h_, stays);
      const VertexPlace there = part > 0 ? m_.retraction.moved(m_.placement, stays, part * way) : here;
      const WorstShape after = ring->worst(there), limits = limits_of(options_);
      if (is_within(after, limits)) return Collapse{h_, stays, there};
      if (!looser) looser = loosened(limits);
      if (is_within(after, *looser)) return Collapse{h_, stays, there};
    }
    return std::nullopt;
  }

 private:
  struct Rings {
    ShortList a, b;  // the neighbours of the ends
  };

  Freedom freedom(int v) const { return m_.constraints.freedom[static_cast<size_t>(v)]; }

  bool may_vanish(int v) const {
    if (freedom(v) == Freedom::fixed) return false;
    if (freedom(v) == Freedom::surface && !t_.on_boundary(v)) return true;
    return is_rim(t_, h_);
  }

  /// Does the valence stay fair, and do curve and corners keep what they want?
  bool is_welcome() const {
    if (valence_after(m_, h_) > options_.valence) return false;
    for (int side : {h_, t_.twin(h_)}) {
      if (side < 0) continue;
      const CornerValence apex = corner_valence(m_.flipping(), Triangulation::previous(side));
      if (apex.has <= apex.wanted) return false;
    }
    return curve_may_lose(m_, h_);
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
  std::span<const double> parts(int stays, int goes) const {
    static constexpr double anywhere[] = {.5, 0, 1}, nowhere[] = {0};
    const bool alike =
        may_vanish(stays) && freedom(stays) == freedom(goes) && t_.on_boundary(stays) == t_.on_boundary(goes);
    return alike ? std::span<const double>(anywhere) : std::span<const double>(nowhere);
  }

  /// The longest edge over its target length, if the vertex that stays were at the point.
  double longest_edge(const Rings& rings, int stays, const Vec3& point) const {
    double longest = 0;
    for (const ShortList* ring : {&rings.a, &rings.b})
      for (int v : *ring)
        if (v != a_ && v != b_) longest = std::max(longest, length(point, v) / target_length(m_, stays, v));
    return longest;
  }

  double length(const Vec3& point, int v) const { return (m_.placement.points.col(v) - point).norm(); }

  /// Would an edge come to be longer than allowed, and than every edge at the ends is now?
  bool leaves_long_edges(const Rings& rings, int stays, const Vec3& point) const {
    const double longest = longest_edge(rings, stays, point);
    if (longest <= options_.longest) return false;
    const auto has_as_long = [&](int end, const ShortList& ring) {
      return std::ranges::any_of(ring, [&](int v) {
        return length(m_.placement.points.col(end), v) / target_length(m_, end, v) >= longest;
      });
    };
    return !has_as_long(a_, rings.a) && !has_as_long(b_, rings.b);
  }

  /// What is worse than it should be may stay as it is, unless the options insist.
  WorstShape loosened(const WorstShape& limits) const {
    WorstShape loose = worse_of(limits, worst_about(m_, h_));
    if (options_.insist_on_alignment) loose.alignment = limits.alignment;
    return loose;
  }

  const AdaptingMesh& m_;
  const Triangulation& t_;
  const CollapseOptions& options_;
  int h_, a_, b_;
};

}  // namespace

int valence_after(const AdaptingMesh& m, int half_edge) {
  const Triangulation& t = m.triangulation;
  return t.valence(t.from(half_edge)) + t.valence(t.to(half_edge)) - (t.twin(half_edge) < 0 ? 3 : 4);
}

std::optional<Collapse> try_collapse(const AdaptingMesh& m, int half_edge, const CollapseOptions& options) {
  return Trial(m, half_edge, options).run();
}

void make_collapse(AdaptingMesh& m, const Collapse& c) {
  const int curve = is_rim(m.triangulation, c.half_edge) ? curve_of(m, c.half_edge).curve : -1;
  if (curve >= 0) --m.curve_edges.present[static_cast<size_t>(curve)];
  m.triangulation.collapse(c.half_edge, c.stays);
  c.place.write_to(m.placement, c.stays);
}

int collapse_edge(AdaptingMesh& m, int half_edge, const CollapseOptions& options) {
  const std::optional<Collapse> trial = try_collapse(m, half_edge, options);
  if (!trial) return -1;
  make_collapse(m, *trial);
  return trial->stays;
}

bool curve_may_lose(const AdaptingMesh& m, int half_edge) {
  if (!is_rim(m.triangulation, half_edge)) return true;
  const int curve = curve_of(m, half_edge).curve;
  if (curve < 0) return true;
  const auto c = static_cast<size_t>(curve);
  return m.curve_edges.present[c] > m.curve_edges.wanted[c];
}

}  // namespace hooke
