#include "hooke/adaptation.h"

#include <algorithm>
#include <cmath>

#include "hooke/adapting_work.h"

namespace hooke {
namespace {

class Adaptation {
 public:
  Adaptation(Workspace& work, const AdaptOptions& options, const FlipGuardOptions& flip_guard,
             const GuardOptions& guards, double corner_angle, const Observer& observer)
      : work_(work),
        options_(options),
        flip_guard_(flip_guard),
        guards_(guards),
        observer_(observer),
        adapting_(work, corner_angle),
        graded_(work.graded()) {
    result_.wanted_faces =
        wanted_face_count(work.placement.points, work.connectivity->faces, work.vertex_length);
  }

  /// `folded`: are there faces that lie against the surface? Flow would carry them along where splits and
  /// collapses take them out.
  AdaptResult run(bool folded) {
    release_bends();
    if (!folded) settle(options_.first_flow);
    for (int i = 0; i < options_.rounds && !result_.interrupted; ++i) change_lengths();
    for (int i = 0; i < options_.count_rounds && !result_.interrupted; ++i)
      if (!change_count()) break;
    adapting_.replace_mesh();
    return result_;
  }

 private:
  /// Vertices at bends may move and go where a curve is to have other edges.
  void release_bends() {
    count_curve_edges(m_, options_.chord_error);
    Constraints& constraints = work_.constraints;
    for (size_t v = 0; v < constraints.freedom.size(); ++v) {
      if (!constraints.at_bend(static_cast<int>(v))) continue;
      const auto curve = static_cast<size_t>(constraints.curve[v]);
      const double wanted = m_.curve_edges.wanted[curve], ratio = wanted / m_.curve_edges.present[curve];
      if (std::max(ratio, 1 / ratio) > options_.keep_bends) constraints.freedom[v] = Freedom::curve;
    }
  }

  void change_lengths() {
    count_curve_edges(m_, options_.chord_error);
    split();
    flip();
    collapse();
    add(settle_curves(m_, options_.count));
    give_up_unused_ids();
    ++result_.rounds;
    settle(options_.flow_rounds);
  }

  bool change_count() {
    const auto faces = static_cast<double>(m_.triangulation.faces().size());
    if (std::abs(faces - result_.wanted_faces) <= options_.count_slack) return false;
    count_curve_edges(m_, options_.chord_error);
    const CountChanges curves = settle_curves(m_, options_.count);
    const CountChanges inner = approach_count(m_, result_.wanted_faces, options_.count);
    give_up_unused_ids();
    add(curves);
    add(inner);
    if (inner.splits + inner.collapses == 0) return false;
    ++result_.count_rounds;
    settle(options_.count_flow);
    return true;
  }

  void split() {
    const Stage stage(work_.stopwatch, "splits");
    result_.splits += split_long_edges(m_, options_.split);
  }

  void collapse() {
    const Stage stage(work_.stopwatch, "collapses");
    result_.collapses += collapse_short_edges(m_, options_.collapse);
    result_.collapses += collapse_folded_faces(m_, options_.folded);
  }

  void give_up_unused_ids() {
    const Stage stage(work_.stopwatch, "compact");
    compact(m_);
  }

  void flip() {
    FlippingMesh flipping = m_.flipping();
    result_.flips += flip_to_delaunay(flipping, flip_guard_);
  }

  /// Flow, after which the mesh is Delaunay and its vertices lie on the surface, as far as guards let them.
  void settle(int rounds) {
    const Stage stage(work_.stopwatch, "flow");
    FlippingMesh flipping = m_.flipping();
    result_.flips += flip_to_delaunay(flipping, flip_guard_) + force_corners(flipping, flip_guard_);
    FlowOptions options;
    options.rounds = rounds;
    const FlowResult flowed = flow(flipping, options, flip_guard_, guards_, watch());
    result_.flips += flowed.flips;
    result_.interrupted = flowed.interrupted;
    if (graded_) work_.vertex_length = work_.input_lengths();
  }

  void add(const CountChanges& changes) {
    result_.splits += changes.splits;
    result_.collapses += changes.collapses;
  }

  Observer watch() const {
    if (!observer_) return nullptr;
    return [this](Progress p) {
      p.stage = "adapt";
      p.outer = result_.rounds + result_.count_rounds;
      return observer_(p);
    };
  }

  Workspace& work_;
  const AdaptOptions& options_;
  const FlipGuardOptions& flip_guard_;
  const GuardOptions& guards_;
  const Observer& observer_;
  AdaptingWork adapting_;
  AdaptingMesh& m_ = adapting_.mesh();
  const bool graded_;
  AdaptResult result_;
};

UntangleResult unfold(Workspace& work, const EnergyTerms& terms, const GuardOptions& guard_options,
                      const Observer& observer) {
  Energy energy(*work.connectivity, work.targets, terms);
  Guards guards(*work.connectivity, work.targets, guard_options);
  Relaxation r{*work.connectivity, work.sweeps, work.vertex_length, energy,
               *work.retraction,   guards,      work.placement};
  return untangle(r, UntangleOptions{}, observer);
}

}  // namespace

AdaptOptions adapt_options(Effort effort) {
  AdaptOptions options;
  switch (effort) {
    case Effort::fast:
      options.rounds = 1;
      options.first_flow = 4;
      options.count_flow = 0;
      break;
    case Effort::standard:
      break;
    case Effort::thorough:
      options.rounds = 7;
      options.flow_rounds = 8;
      break;
  }
  return options;
}

AdaptResult adapt(Workspace& work, const AdaptOptions& options, const FlipGuardOptions& flip_guard,
                  const EnergyTerms& terms, const GuardOptions& guards, double corner_angle,
                  const Observer& observer) {
  const UntangleResult unfolded = unfold(work, terms, guards, observer);
  AdaptResult result;
  if (unfolded.interrupted)
    result.interrupted = true;
  else
    result =
        Adaptation(work, options, flip_guard, guards, corner_angle, observer).run(!unfolded.folded.empty());
  result.untangle = unfolded;
  return result;
}

}  // namespace hooke
