#include "hooke/remesh/details.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "hooke/constraints/rounded_edges.h"
#include "hooke/remesh/bends.h"
#include "hooke/remesh/shorter_lengths.h"
#include "hooke/remesh/walls.h"

namespace hooke {
namespace {

double greatest_distance(const Attempt& a) {
  const Deviation& d = a.result.measures->deviation;
  return std::max(d.to_reference.max, d.from_reference.max);
}

double mean_distance(const Attempt& a) {
  const Deviation& d = a.result.measures->deviation;
  return std::max(d.to_reference.rms, d.from_reference.rms);
}

double small_angles(const Quality& q, std::size_t faces) {
  return static_cast<double>(q.faces_below_20) / static_cast<double>(faces);
}

class DetailResolver {
 public:
  DetailResolver(AttemptMaker& maker, const ShorterLengths& shorter, const RemeshOptions& start,
                 const std::function<Attempt()>& attempt, Attempt& best)
      : maker_(maker), shorter_(shorter), start_(start), attempt_(attempt), best_(best) {}

  void run() {
    constexpr double growth = 3, growth_of_few = 10, few = 2000;  // of the number that the lengths ask for
    const double asked =
        shorter_.faces_of({maker_.lengths.of_vertices, {}}, std::numeric_limits<double>::infinity());
    shorten(&ShorterLengths::resolving_bends, growth * asked);
    keep_rounded_edges();
    shorten(&ShorterLengths::resolving_walls, std::max(growth * asked, std::min(growth_of_few * asked, few)));
  }

 private:
  void shorten(std::optional<AskedLengths> (ShorterLengths::*resolving)(const Attempt&, double) const,
               double max_faces) {
    if (!may_go_on()) return;
    if (std::optional<AskedLengths> lengths = (shorter_.*resolving)(best_, max_faces))
      try_with(start_, std::move(*lengths));
  }

  void keep_rounded_edges() {
    if (!may_go_on() || sharp_bends(maker_, best_).empty()) return;
    RemeshOptions with_edges = start_;
    with_edges.constraints.rounded_edges = rounded_edges();
    if (with_edges.constraints.rounded_edges.empty()) return;
    constexpr double clearly = .9;
    if (try_with(with_edges, best_.lengths, clearly)) start_ = with_edges;
  }

  /// Those of the input that are narrow for the lengths of the result, by the ids of the caller.
  std::vector<Edge> rounded_edges() const {
    const Adjacency& c = maker_.input().adjacency;
    std::vector<Edge> creases = maker_.input_creases(best_);
    for (Edge& e : creases) std::ranges::sort(e);
    std::ranges::sort(creases);
    std::vector<char> is_crease;
    for (const Edge& e : c.edges)
      is_crease.push_back(
          std::ranges::binary_search(creases, Edge{std::min(e[0], e[1]), std::max(e[0], e[1])}));
    std::vector<Edge> edges =
        middles_of_rounded_edges(maker_.input().points, c, shorter_.at_edges(best_.lengths),
                                 maker_.options.constraints.features.angle, is_crease);
    for (Edge& e : edges) e = {maker_.id_of(e[0]), maker_.id_of(e[1])};
    return edges;
  }

  bool may_go_on() const {
    return maker_.adapts() && maker_.has_facets() && !maker_.has_tolerance() && !maker_.smooths_mask() &&
           !best_.is_interrupted() && best_.keeps_promises() &&
           (best_.result.rescue == Rescue::none || best_.result.rescue == Rescue::tips ||
            best_.result.rescue == Rescue::closest);
  }

  /// Is the attempt, which replaces the best one then, closer to the input: on average, and by that share on
  /// average times at most?
  bool try_with(const RemeshOptions& options, AskedLengths lengths, double share = 1) {
    maker_.lengths = std::move(lengths);
    maker_.options = options;
    Attempt next = attempt_();
    if (next.is_interrupted()) {
      best_.result.reason = StopReason::interrupted;
      return false;
    }
    if (!next.keeps_promises() || !is_closer(next, share) || !is_better(next)) return false;
    best_ = std::move(next);
    return true;
  }

  bool is_closer(const Attempt& next, double share) const {
    const double mean = mean_distance(next) / mean_distance(best_);
    return mean < 1 && (share == 1 || mean * greatest_distance(next) < share * greatest_distance(best_));
  }

  /// Do no more faces lie against the surface, is the result nowhere clearly farther from the input, and are
  /// its angles hardly smaller? If it is closer by half they may be as small as in the input.
  bool is_better(const Attempt& next) const {
    constexpr double more_distance = 1.05, more_small_angles = .001;  // of all faces
    constexpr double good_angle = 25, kept_share = .8, far_closer = .5;
    const ResultMeasures &now = *next.result.measures, &before = *best_.result.measures;
    const double distance = greatest_distance(next) / greatest_distance(best_);
    if (now.deviation.opposing_faces.size() > before.deviation.opposing_faces.size()) return false;
    const double small = small_angles(now.quality, next.mesh.n_faces());
    const bool is_far_closer =
        distance < far_closer && mean_distance(next) < far_closer * mean_distance(best_);
    if (is_far_closer && next.angle >= maker_.input_quality().min_angle.min &&
        small <= small_angles(maker_.input_quality(), maker_.input().adjacency.faces.size()))
      return true;
    return distance <= more_distance &&
           small <= small_angles(before.quality, best_.mesh.n_faces()) + more_small_angles &&
           next.angle >= std::min(good_angle, kept_share * best_.angle);
  }

  AttemptMaker& maker_;
  const ShorterLengths& shorter_;
  RemeshOptions start_;
  const std::function<Attempt()>& attempt_;
  Attempt& best_;
};

}  // namespace

void resolve_details(AttemptMaker& maker, const ShorterLengths& shorter, const RemeshOptions& start,
                     const std::function<Attempt()>& attempt, Attempt& best) {
  DetailResolver(maker, shorter, start, attempt, best).run();
}

void note_lost_details(const AttemptMaker& maker, Attempt& attempt) {
  note_bends(maker, attempt);
  note_walls(maker, attempt);
}

}  // namespace hooke
