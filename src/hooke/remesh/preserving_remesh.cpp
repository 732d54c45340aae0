#include "hooke/remesh/preserving_remesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "hooke/mesh/junctions.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/remesh/attempts.h"
#include "hooke/remesh/details.h"
#include "hooke/remesh/flaws.h"
#include "hooke/remesh/kept_faces.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/mending.h"
#include "hooke/remesh/mirrored_places.h"
#include "hooke/remesh/put_back.h"
#include "hooke/remesh/remesh.h"
#include "hooke/remesh/shell_attempts.h"
#include "hooke/remesh/shorter_lengths.h"
#include "hooke/springs/sizing.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {
namespace {

/// As `few_vertices`, in mode `adapt`: other surfaces and shorter edges, which take more runs, come after
/// that.
constexpr double very_few_vertices = .005;

/// Attempts and what mends them, until one keeps the input.
class PreservingRemesh {
 public:
  explicit PreservingRemesh(AttemptMaker& maker)
      : maker_(maker),
        input_(maker.input()),
        options_(maker.options),
        asked_(maker.lengths.of_vertices),
        shorter_(maker, asked_) {}

  /// For some shells of a mesh: `first` is the first attempt for these, `max_faces` the most faces that they
  /// may have with shorter lengths, and `keeps_first` whether faces are kept before anything else is tried.
  PreservingRemesh(AttemptMaker& maker, Attempt first, double max_faces, bool keeps_first)
      : PreservingRemesh(maker) {
    first_ = std::move(first);
    max_faces_of_part_ = max_faces;
    keeps_first_ = keeps_first;
  }

  Attempt best() {
    const RemeshOptions start = options_;
    Attempt best = best_with_lengths();
    if (may_take_lengths() && !best.is_interrupted() && (!is_done(best) || has_many_slivers(best)))
      take_lengths_of_input(start, best);
    if (!is_done(best)) leave_as_it_was(best);
    if (!is_of_part())
      resolve_details(
          maker_, shorter_, start, [this] { return attempt(); }, best);
    if (best.result.rescue == Rescue::put_back || best.result.rescue == Rescue::kept_faces)
      best.result.refused_distance = refused_distance_;
    if (!is_of_part()) keep_mirrors(maker_, asked_, start.constraints, best);
    if (!is_of_part()) note_lost_details(maker_, best);
    if (!maker_.adapts()) leave_what_hardly_moved(maker_, best);
    if (!best.lengths.shorter.empty()) best.result.shortened = shorter_.count_in(best);
    if (!maker_.adapts() && vertex_points(best.mesh) == maker_.as_written(vertex_points(maker_.mesh())))
      best.result.steps = MaskSteps::none;
    return best;
  }

 private:
  /// The best attempt with the lengths at hand. If it breaks promises still, it has the faces of the input.
  Attempt best_with_lengths() {
    Attempt unmended;
    Attempt best = attempt(maker_.adapts() && input_.shell_count() == 0 ? nullptr : &unmended);
    if (!best.result.measures) return best;  // not finite
    const FilterKind filter = options_.filter.kind;
    if (best.is_interrupted() && maker_.adapts()) mend(maker_, best);
    if (maker_.adapts()) remesh_wrong_shells(unmended, best);
    if (may_redo_flaws(best)) redo_flaws(best, best);
    if (!best.keeps_promises()) unmended = best;
    const bool keeps_rest =
        !best.is_interrupted() && !best.is_good() && may_keep_faces(maker_.adapts() ? best : unmended);
    if (keeps_rest) keep_faces(std::move(unmended), best);
    if (!is_settled(best) && !(keeps_rest && !maker_.adapts() && is_done(best))) project_to_faces(best);
    if (!best.is_interrupted() && !best.keeps_promises()) hold_junctions(filter, best);
    if (!best.is_interrupted() && !best.keeps_promises() && !maker_.smooths_mask()) {
      if (maker_.adapts()) keep_narrow_parts(filter, keeps_rest, best);
      if (is_of_part() && !best.is_interrupted() && !best.keeps_promises()) best = unchanged();
      if (options_.connectivity == ConnectivityMode::flip) keep_faces(best, best);
    }
    if (!is_valid(best) && !maker_.adapts()) put_back(best);
    if (!best.is_interrupted() && !maker_.smooths_mask()) take_back_slivers(maker_, best);
    return best;
  }

  /// Has it, in modes `fixed` and `flip`, so many slivers that other lengths may do better? Those with a
  /// vertex that moves freely count; none if they stay as they were.
  bool has_many_slivers(const Attempt& run) const {
    constexpr double many = .005, of_input = .5;  // of all faces, and of the slivers in the input
    if (maker_.adapts() || !run.result.measures || run.result.rescue == Rescue::put_back) return false;
    const Permutation& order = run.result.memory_order.order;
    const Mat3X points = order.gather(vertex_points(run.mesh));
    const auto moves_freely = [&](int v) {
      return run.result.vertex_limits[order.old_vertex[v]] == not_limited;
    };
    const auto is_curable = [&](const Triangle& t) {
      return min_angle(points, {t}) < sliver_angle && std::ranges::any_of(t, moves_freely);
    };
    const auto slivers = static_cast<double>(run.result.measures->quality.faces_below_20),
               before = static_cast<double>(maker_.input_quality().faces_below_20);
    const auto curable = std::ranges::count_if(run.result.memory_order.adjacency->faces, is_curable);
    return slivers > of_input * before &&
           static_cast<double>(curable) > many * static_cast<double>(run.mesh.n_faces());
  }

  /// Are they clearly fewer, the faces no worse on average, and the least angle not clearly smaller?
  static bool has_fewer_slivers(const Attempt& run, const Attempt& other) {
    constexpr double clearly_fewer = .95, kept_mean = .95, kept_least = .5;
    const Quality &now = run.result.measures->quality, &before = other.result.measures->quality;
    return static_cast<double>(now.faces_below_20) <
               clearly_fewer * static_cast<double>(before.faces_below_20) &&
           now.shape.mean >= before.shape.mean && now.min_angle.mean >= kept_mean * before.min_angle.mean &&
           run.angle >= kept_least * other.angle;
  }

  /// Is so little wrong that what surrounds it may stay as it is in the input, before all vertices leave the
  /// spline for the faces? In mode `adapt`, where shorter edges may do, it must be next to nothing.
  bool may_keep_faces(const Attempt& run) const {
    if (maker_.smooths_mask() || options_.filter.kind == FilterKind::closest || run.is_interrupted() ||
        run.keeps_promises() || has_worse_faces(run))
      return false;
    const std::vector<int> wrong = input_vertices_at_flaws(maker_, run);
    return !wrong.empty() &&
           (keeps_first_ || std::ssize(wrong) < (maker_.adapts() ? very_few_vertices : few_vertices) *
                                                    input_.adjacency.vertex_count);
  }

  /// Is so little wrong in mode `adapt` that it may be made anew by itself? Only with a maximum distance, as
  /// runs are not kept without.
  bool may_redo_flaws(const Attempt& run) const {
    return maker_.adapts() && maker_.has_tolerance() && !maker_.smooths_mask() && !run.is_interrupted() &&
           !run.keeps_promises() &&
           std::ssize(input_vertices_at_flaws(maker_, run)) < few_vertices * input_.adjacency.vertex_count;
  }

  /// Is so much wrong that no other attempt with these lengths is of use, in a mesh where it takes long? Not
  /// in mode `adapt`, where edges get shorter, nor where the steps of a mask go.
  bool is_beyond_help(const Attempt& run) const {
    constexpr double at_least = 200;
    return run.result.measures != nullptr && !maker_.adapts() && !maker_.smooths_mask() &&
           static_cast<double>(input_vertices_at_flaws(maker_, run).size()) >
               std::max(at_least, few_vertices * input_.adjacency.vertex_count);
  }

  /// Would its faces be no better on those of the input? In mode `adapt` they hardly ever are where all is
  /// kept.
  bool is_settled(const Attempt& run) const {
    return run.is_interrupted() || (maker_.adapts() ? run.keeps_promises() : run.is_good());
  }

  /// Is nothing left to do for it? In mode `adapt` the result may still break promises.
  bool is_done(const Attempt& run) const {
    constexpr double margin = .005;  // of shape: even edges of good faces may cost so much
    return !run.result.measures || maker_.adapts() ||
           (is_valid(run) && (maker_.smooths_mask() || !has_worse_faces(run, margin)));
  }

  /// Does it keep its promises and its polygons, or, if it is interrupted, all but its least angle?
  bool is_valid(const Attempt& run) const {
    return run.is_interrupted() ? run.flaws() == 0 && !maker_.has_worse_polygons(run) : maker_.keeps_all(run);
  }

  /// A run with the vertices moved to the input that must be; `unmended` receives it as it was before. If
  /// vertices of the input are lost in spite of that, or angles get small, but nothing else is wrong, there
  /// is a second run with these held; it is discarded if it is interrupted.
  Attempt attempt(Attempt* unmended = nullptr) {
    Attempt run = first_ ? *std::exchange(first_, std::nullopt) : maker_.run();
    maker_.judge(run);
    if (is_first_) note_distance(run);
    if (unmended != nullptr) *unmended = run;
    if (!run.result.measures || run.is_interrupted()) return run;
    const std::vector<FarVertex> lost = run.preservation().lost_vertices;
    mend(maker_, run);
    const bool only_lost = run.flaws() == run.preservation().lost_vertices.size();
    if (lost.empty() || run.is_good() || !only_lost) return run;
    hold(lost);
    Attempt next = maker_.run();
    if (next.is_interrupted()) {
      run.result.reason = StopReason::interrupted;
      return run;
    }
    maker_.judge(next);
    next.result.rescue = Rescue::tips;
    mend(maker_, next);
    return next.is_better_than(run) ? std::move(next) : std::move(run);
  }

  /// Notes how far the first attempt is from the input if hardly anything else is wrong with it. Not in mode
  /// `adapt`, where edges get shorter.
  void note_distance(const Attempt& run) {
    is_first_ = false;
    if (!run.result.measures || maker_.adapts() || maker_.has_tolerance()) return;
    const Preservation& p = run.preservation();
    if (p.far_vertices.empty() && p.lost_vertices.empty()) return;
    const Deviation& d = run.result.measures->deviation;
    const double distance = std::max({p.distance, d.to_reference.max, d.from_reference.max}),
                 few = few_vertices * input_.adjacency.vertex_count;
    const std::size_t others = maker_.flaws_within(distance, run);
    if (static_cast<double>(others) < few && 4 * others < p.flaws() && !has_worse_faces(run))
      refused_distance_ = distance;
  }

  /// Holds vertices of the input, as the tip of a cone, that a result has lost.
  void hold(std::vector<FarVertex> lost) {
    constexpr std::size_t max_tips = 100;
    std::ranges::stable_sort(lost, std::greater(), &FarVertex::distance);
    std::vector<int> held;
    for (const FarVertex& tip : lost) {
      const auto is_near = [&](int v) {
        return (input_.points.col(v) - input_.points.col(tip.vertex)).norm() < 2 * tip.distance;
      };
      if (held.size() < max_tips && std::ranges::none_of(held, is_near)) held.push_back(tip.vertex);
    }
    for (int v : held) options_.constraints.fixed_vertices.push_back(maker_.id_of(v));
  }

  /// Makes an attempt on the faces of the input, if that may help, and keeps it if it is better.
  void project_to_faces(Attempt& best) {
    if (options_.filter.kind == FilterKind::closest || is_beyond_help(best)) return;
    options_.filter.kind = FilterKind::closest;
    Attempt next = attempt();
    if (next.is_interrupted()) {
      best.result.reason = StopReason::interrupted;
      return;
    }
    next.result.rescue = Rescue::closest;
    if (next.is_better_than(best)) best = std::move(next);
  }

  /// May these vertices of the input have moved? In mode `adapt` others may stand in their places.
  bool may_have_moved(const std::vector<int>& ids, const Attempt& run) const {
    const auto now = vertex_points(run.mesh);
    const Mat3X before = maker_.as_written(vertex_points(maker_.mesh()));
    return maker_.adapts() || std::ranges::any_of(ids, [&](int id) { return now.col(id) != before.col(id); });
  }

  /// If vertices of junctions may have slid, makes attempts in which they stand still, and keeps the first
  /// that is better.
  void hold_junctions(FilterKind filter, Attempt& best) {
    const Junctions junctions = find_junctions(input_.adjacency, input_.joined);
    std::vector<int> ids;
    for (int v : junctions.vertices) ids.push_back(maker_.id_of(v));
    if (junctions.edges.empty() || !may_have_moved(ids, best)) return;
    std::vector<int>& fixed = options_.constraints.fixed_vertices;
    fixed.insert(fixed.end(), ids.begin(), ids.end());
    options_.filter.kind = filter;
    Attempt next = attempt();
    if (!is_settled(next)) project_to_faces(next);
    if (next.is_interrupted()) {
      best.result.reason = StopReason::interrupted;
      return;
    }
    if (next.result.rescue == Rescue::none) next.result.rescue = Rescue::junctions;
    if (next.is_better_than(best)) best = std::move(next);
  }

  void remesh_wrong_shells(const Attempt& unmended, Attempt& best) {
    if (is_of_part() || input_.shell_count() == 0 || best.is_interrupted() || best.keeps_promises() ||
        maker_.smooths_mask())
      return;
    const auto best_of_part = [keeps_first = may_keep_faces(best)](AttemptMaker& maker, Attempt first,
                                                                   double max_faces, bool leaves_it) {
      PreservingRemesh of_part(maker, std::move(first), max_faces, keeps_first);
      return leaves_it ? of_part.unchanged() : of_part.best();
    };
    remesh_shells(maker_, unmended, max_faces(best), best_of_part, best);
  }

  bool is_of_part() const { return max_faces_of_part_.has_value(); }

  /// The most faces that shorter lengths may take.
  double max_faces(const Attempt& run) const {
    const double faces = run.result.adaptation.target_faces;
    const double alone = std::max({std::clamp(25 * faces, 1e4, 5e4), 1.5 * faces, max_faces_for_tolerance()});
    return is_of_part() ? std::min(*max_faces_of_part_, alone) : alone;
  }

  /// In mode `adapt`, where long edges do not keep narrow parts: shortens lengths there, and keeps the faces
  /// of the input where that does not do, in the end all but some. They come first where next to nothing is
  /// wrong, unless that `was_tried` already.
  void keep_narrow_parts(FilterKind filter, bool was_tried, Attempt& best) {
    RemeshOptions start = options_;  // with the tips and junctions that are held
    start.filter.kind = filter;
    const auto keep = [&] {
      options_ = start;
      if (best.result.rescue == Rescue::closest) options_.filter.kind = FilterKind::closest;
      keep_faces(best, best);
    };
    const auto wrong = static_cast<double>(input_vertices_at_flaws(maker_, best).size());
    if (!was_tried && wrong <= very_few_vertices * input_.adjacency.vertex_count) {
      keep();
      if (best.is_interrupted() || best.keeps_promises()) return;
    }
    shorten_lengths(start, best);
    if (!best.is_interrupted() && !best.keeps_promises()) keep();
  }

  /// 0 if no limit of distances is asked for.
  double max_faces_for_tolerance() const {
    return maker_.has_tolerance() ? 12 * static_cast<double>(input_.adjacency.faces.size()) : 0;
  }

  /// The most faces that shorter lengths may take in these rounds.
  double max_faces_of_rounds(const Attempt& run) const {
    constexpr double for_tolerance = 5e4;
    return maker_.has_tolerance() ? std::max(for_tolerance, max_faces(run)) : max_faces(run);
  }

  /// Shortens the lengths asked for about what is wrong, and makes attempts with these.
  void shorten_lengths(const RemeshOptions& start, Attempt& best) {
    Attempt last = best;
    if (last.result.rescue == Rescue::kept_faces) last.run.reset();  // there lengths fit the kept faces
    maker_.lengths = last.run ? last.lengths : AskedLengths{asked_, {}};
    shorten_about_flaws(std::move(last), best, [&](const Attempt& before, Attempt& unmended) {
      options_ = start;
      const bool projects = before.result.rescue == Rescue::closest;
      if (projects) options_.filter.kind = FilterKind::closest;
      Attempt next = attempt(&unmended);
      if (projects) next.result.rescue = Rescue::closest;
      return next;
    });
  }

  /// Where little is wrong with a result, goes on from it with shorter lengths there. If that does not do,
  /// the next attempts have the lengths before.
  void redo_flaws(const Attempt& last, Attempt& best) {
    const AskedLengths before = maker_.lengths;
    shorten_about_flaws(last, best, nullptr);
    if (!best.keeps_promises()) maker_.lengths = before;
  }

  /// Makes another attempt than one before; `unmended` receives it as it was before it was mended.
  using MakeAnew = std::function<Attempt(const Attempt& before, Attempt& unmended)>;

  /// Shortens the target lengths about what is wrong, from the attempt `last` on, and makes attempts with
  /// these until nothing is, or until they made too many faces since one that halved what is wrong. Where
  /// much of the last one may stay, and it was not much worse than the one before, the next goes on from it;
  /// else it is made `anew`, or it ends there if that is null. What was mended in one that is made anew may
  /// not be in the next: lengths are shortened there too. Keeps the best lengths. Ends where it would take
  /// too many faces, or after some rounds.
  void shorten_about_flaws(Attempt last, Attempt& best, const MakeAnew& anew) {
    constexpr double least_cost = .25;  // of going on, as it takes a run that makes all faces
    constexpr std::size_t much_worse = 4;
    // Faces: several rounds of a small mesh, one of a large one.
    const double max_in_vain = maker_.has_tolerance() ? std::max(1e4, max_faces_for_tolerance()) : 5e3;
    const double faces_asked = shorter_.faces_of({asked_, {}}, std::numeric_limits<double>::infinity());
    const double max_rounds = std::clamp(2e5 / faces_asked, 3., 10.);
    AskedLengths best_lengths = maker_.lengths;
    double in_vain = 0, rounds = 0;
    std::size_t flaws_to_halve = last.flaws();
    std::vector<FlawPlace> flaws_before, before_mending;
    while (rounds < max_rounds && !last.keeps_promises()) {
      std::vector<FlawPlace> flaws = places_of_flaws(maker_, last);
      if (flaws == flaws_before) break;  // of what stands still
      shorter_.shorten_at(flaws, last, maker_.lengths);
      shorter_.shorten_at(std::exchange(before_mending, {}), last, maker_.lengths);
      flaws_before = std::move(flaws);
      const double most = max_faces_of_rounds(best);
      if (shorter_.faces_of(maker_.lengths, most) > most) break;
      std::optional<Attempt> next = maker_.go_on(last);
      const bool goes_on = next.has_value();
      Attempt unmended;
      if (!goes_on && anew) next = anew(last, unmended);
      if (!next) break;
      if (next->is_interrupted()) {
        best.result.reason = StopReason::interrupted;
        break;
      }
      if (goes_on) {
        maker_.judge(*next);
        mend(maker_, *next);
        next->result.rescue = last.result.rescue;
        if (anew && next->flaws() > much_worse * last.flaws()) next->run.reset();
      }
      if (!next->result.measures) break;  // not finite
      if (!goes_on) before_mending = places_of_flaws(maker_, unmended);
      if (next->is_better_than(best)) {
        best = *next;
        best_lengths = maker_.lengths;
      }
      const auto faces = static_cast<double>(next->mesh.n_faces());
      const double cost = std::max(least_cost * faces, next->made_faces);
      const bool halves = 2 * next->flaws() <= flaws_to_halve;
      rounds += cost / faces;
      in_vain = halves ? 0 : in_vain + cost;
      if (in_vain > max_in_vain) break;
      if (halves) flaws_to_halve = next->flaws();
      last = std::move(*next);
    }
    maker_.lengths = std::move(best_lengths);
  }

  /// Makes attempts in which vertices and faces of the input stay where something was wrong in the last one,
  /// and ever more around them, until nothing is wrong or they would be too much of the surface. In mode
  /// `fixed` putting vertices back there may be enough; in mode `adapt`, where nothing can be put back,
  /// lengths grow away from the edges that stay, nearly all may, and late rounds keep more rings at new
  /// places.
  void keep_faces(Attempt last, Attempt& best) {
    const double faces =
        maker_.adapts() ? best.result.adaptation.target_faces : static_cast<double>(best.mesh.n_faces());
    const int max_rounds = std::clamp(static_cast<int>(4e5 / faces), 3, 10);
    const double max_share = maker_.adapts() ? 1 : .9;      // of the surface
    const int patience = maker_.adapts() ? 3 : max_rounds;  // rounds, before new places get more rings
    KeptFaces kept(maker_);
    for (int round = 0; !last.keeps_promises(); ++round) {
      if (options_.connectivity == ConnectivityMode::fixed) {
        Attempt local = last;
        put_back_around_flaws(maker_, local, 8);
        if (is_done(local)) {
          if (local.is_better_than(best)) best = std::move(local);
          break;
        }
      }
      if (round == max_rounds) break;
      const bool keeps_more =
          kept.add_around(input_vertices_at_flaws(maker_, last), std::max(round - patience, 1));
      if (!keeps_more || kept.share_of_area() >= max_share) break;
      kept.hold();
      Attempt next = maker_.run();
      if (next.is_interrupted()) {
        best.result.reason = StopReason::interrupted;
        break;
      }
      maker_.judge(next);
      if (!next.result.measures) break;  // not finite
      mend(maker_, next);
      next.result.rescue =
          options_.connectivity == ConnectivityMode::fixed ? Rescue::put_back : Rescue::kept_faces;
      if (next.is_better_than(best)) best = next;
      if (may_redo_flaws(next)) redo_flaws(next, best);
      if (best.is_interrupted() || best.keeps_promises()) break;
      last = std::move(next);
    }
  }

  /// An attempt in which all faces of the input stay.
  Attempt unchanged() {
    std::vector<int>& frozen = options_.constraints.frozen_vertices;
    frozen.resize(input_.adjacency.vertex_count);
    std::iota(frozen.begin(), frozen.end(), 0);
    Attempt run = maker_.run();
    maker_.judge(run);
    run.result.rescue = Rescue::kept_faces;
    return run;
  }

  /// Keeps faces, then puts vertices back around what is still wrong; a result with other faces is replaced
  /// by one with those of the input first.
  void put_back(Attempt& best) {
    with_faces_of_input(best);
    if (!best.result.measures) return;  // not finite
    const bool is_worse = has_worse_faces(best);
    if (is_worse && may_take_lengths() && !best.is_interrupted()) return;  // these come first
    if (!is_worse && !best.is_interrupted() && !maker_.smooths_mask()) keep_faces(best, best);
    put_back_around_flaws(maker_, best, 16);
  }

  /// In mode `flip`, replaces the result by one with the faces of the input.
  void with_faces_of_input(Attempt& best) {
    if (options_.connectivity != ConnectivityMode::flip) return;
    options_.connectivity = ConnectivityMode::fixed;
    Attempt next = maker_.run();  // ends at once if the work is interrupted
    const bool interrupted = best.is_interrupted() || next.is_interrupted();
    maker_.judge(next);
    best = std::move(next);
    if (interrupted) best.result.reason = StopReason::interrupted;
    best.result.rescue = Rescue::put_back;
  }

  /// Puts all vertices back.
  void leave_as_it_was(Attempt& best) {
    with_faces_of_input(best);
    if (!best.result.measures) return;  // not finite
    put_all_back(maker_, best);
    if (maker_.smooths_mask()) best.result.creases.dropped = 0;
  }

  /// Where one length is asked for all edges of a part: are the faces worse on average than those of the
  /// input?
  bool has_worse_faces(const Attempt& run, double margin = 0) const {
    return maker_.has_even_lengths() && maker_.has_worse_faces(run, margin);
  }

  /// May attempts take the lengths of the input for those asked for?
  bool may_take_lengths() const {
    OpenMesh::EPropHandleT<double> of_edges;
    return maker_.has_even_lengths() && maker_.lengths.of_vertices == asked_ && !maker_.smooths_mask() &&
           !maker_.mesh().get_property_handle(of_edges, edge_length_property);
  }

  /// Tries it with the lengths of the input: by all means if the result at hand is not done, else by one
  /// attempt, which must have fewer slivers.
  void take_lengths_of_input(const RemeshOptions& start, Attempt& best) {
    constexpr int few_rings = 4;
    const bool was_done = is_done(best);
    const RemeshOptions of_best = std::exchange(options_, start);
    maker_.lengths = {lengths_of_input(), {}};
    Attempt next = was_done ? attempt() : best_with_lengths();
    if (was_done && next.result.measures && !next.is_interrupted()) {
      if (options_.connectivity == ConnectivityMode::fixed) put_back_around_flaws(maker_, next, few_rings);
      take_back_slivers(maker_, next);
    }
    if (next.is_interrupted() && !was_done) best.result.reason = StopReason::interrupted;
    if (next.result.measures && is_done(next) &&
        (!was_done || (!next.is_interrupted() && has_fewer_slivers(next, best)))) {
      best = std::move(next);
      best.result.has_lengths_of_input = true;
    } else {
      options_ = of_best;
      maker_.lengths = {asked_, {}};
    }
  }

  /// Lengths as in the input, scaled to those asked for.
  std::vector<double> lengths_of_input() const {
    const Mat3X& points = input_.points;
    const Adjacency& c = input_.adjacency;
    const double length = covering_length(points, c, spread_target_lengths(c, asked_)),
                 natural = resolve_length({}, points, c);
    const Sizing sizing{input_lengths(points, c), std::numeric_limits<double>::infinity()};
    return resolve_vertex_lengths({LengthSpec::Kind::times_natural, length / natural}, sizing, points, c);
  }

  AttemptMaker& maker_;
  const MeasuredSurface& input_;
  RemeshOptions& options_;           // of the attempts to come
  const std::vector<double> asked_;  // target lengths, by vertex of the input in memory order
  const ShorterLengths shorter_;
  std::optional<Attempt> first_;  // that is at hand
  bool is_first_ = true;          // is no attempt made yet?
  double refused_distance_ = 0;   // see RemeshResult
  std::optional<double> max_faces_of_part_;
  bool keeps_first_ = false;
};

}  // namespace

RemeshResult preserving_remesh(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                               const PreservationOptions& preservation, const KnownInput& known,
                               const Observer& observer, Stopwatch* stopwatch) {
  const auto best_attempt = [&](bool smooths_steps) {
    AttemptMaker maker(mesh, memory_order, options, preservation, known, observer, stopwatch, smooths_steps);
    return PreservingRemesh(maker).best();
  };
  Attempt best = best_attempt(true);
  if (best.result.steps == MaskSteps::smoothed && best.result.measures && !best.is_interrupted() &&
      !best.keeps_promises())
    best = best_attempt(false);
  if (!options.map) best.result.map.clear();
  mesh = std::move(best.mesh);
  if (vertex_points(mesh).allFinite())  // vertices may have been put back since
    set_residual_forces(mesh, best.result.memory_order, options.altitude);
  return std::move(best.result);
}

}  // namespace hooke
