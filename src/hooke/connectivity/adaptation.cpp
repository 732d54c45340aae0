#include "hooke/connectivity/adaptation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "hooke/connectivity/corner_flips.h"
#include "hooke/connectivity/edge_flips.h"
#include "hooke/connectivity/edge_splits.h"
#include "hooke/connectivity/lloyd_flow.h"
#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/mesh/wedges.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/working_mesh.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {
namespace {

/// All leave a mesh of the same topology, with its boundary loops, creases, corners and fixed vertices. Keeps
/// references to what it is given. After finish() nothing more may be called.
class AdaptationSteps {
 public:
  /// `corner_angle`: degrees, see corner_rule.h. The observer is asked as by the steps that take one.
  AdaptationSteps(Workspace& work, const StepOptions& options, const FlipGuardOptions& flip_guard,
                  const EnergyTerms& terms, const GuardOptions& guards, double corner_angle,
                  Observer observer);

  /// Vertices at bends may move and go where a curve is to have other edges.
  void release_bends();

  /// Doubles the target lengths so many times; below zero they are halved.
  void coarsen(int levels);

  /// How often they may be doubled.
  int bearable_levels(double wanted_faces, const CoarseLimits& limits) const;

  /// Splits and collapses edges that are too long or too short, and gives curves as many as they want.
  void change_lengths();

  /// Brings the number of faces closer to what is wanted; false if nothing changes it.
  bool change_count(double wanted_faces);

  /// Flow, after which the mesh is Delaunay and its vertices lie on the surface, as far as guards let them.
  void lloyd_flow(int rounds);

  /// Passes of springs and flips about irregular vertices, until one flips nothing.
  void flip_irregular();

  /// Every face becomes four.
  void subdivide();

  /// Gives the work the mesh as it is now.
  void finish() { adapting_.replace_mesh(); }

  double face_count() const { return static_cast<double>(m_.halfedges.faces().size()); }
  const StepCounts& counts() const { return counts_; }
  bool interrupted() const { return interrupted_; }

 private:
  void give_up_unused_ids();
  void relax_springs();
  int pass_over_irregular(std::vector<char>& lately_changed);
  void resample_lengths();
  void add(const CountChanges& changes);

  Workspace& work_;
  const StepOptions& options_;
  const FlipGuardOptions& flip_guard_;
  const EnergyTerms& terms_;
  const GuardOptions& guards_;
  const Observer observer_;
  WorkspaceEdit adapting_;
  WorkingMesh& m_ = adapting_.mesh();
  const bool graded_;
  int level_ = 0;  // the target lengths are doubled so many times
  StepCounts counts_;
  bool interrupted_ = false;
};

/// How far the surface turns along an arc of the target length, radians, and how much of it is like that.
struct Turn {
  double angle, weight;
};

/// Per half-edge; without weight where the edge has had its turn.
std::vector<Turn> turns(const WorkingMesh& m) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& N = m.positions.normals;
  std::vector<Turn> turns(static_cast<size_t>(t.half_edge_count()), Turn{0, 0});
  parallel_for(turns.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int h = static_cast<int>(i);
      if (t.twin(h) > h) continue;
      const Vec3 a = N.col(t.wedge(h)), b = N.col(t.wedge(HalfedgeMesh::next(h)));
      const double length = relative_length(m, h);
      if (length > 0) turns[i] = {std::atan2(a.cross(b).norm(), a.dot(b)) / length, length * length};
    }
  });
  return turns;
}

/// The angle that no more than this part of the weights exceeds; 0 without any.
double exceeded_by(double share, std::vector<Turn> turns) {
  double left = 0;
  for (const Turn& turn : turns) left += share * turn.weight;
  std::ranges::make_heap(turns, {}, &Turn::angle);
  for (; !turns.empty(); turns.pop_back()) {
    if ((left -= turns.front().weight) < 0) return turns.front().angle;
    std::ranges::pop_heap(turns, {}, &Turn::angle);
  }
  return 0;
}

/// How many of the ids [0, count) are such; asked several at once.
double count_of(int count, const auto& is_such) {
  return parallel_sum(static_cast<size_t>(count), 4096, [&](size_t begin, size_t end) {
    double number = 0;
    for (size_t i = begin; i < end; ++i) number += is_such(static_cast<int>(i));
    return number;
  });
}

bool is_regular(const WorkingMesh& m, const CoarseLimits& limits) {
  const HalfedgeMesh& t = m.halfedges;
  const auto is_inner = [&](int v) { return t.valence(v) > 0 && !t.on_boundary(v); };
  const auto is_edge = [&](int h) { return t.twin(h) <= h; };
  const auto is_misfit = [&](int h) {
    const double length = relative_length(m, h);
    return length < limits.shortest || length > limits.longest;
  };
  const int ids = t.id_count(), half_edges = t.half_edge_count();
  return count_of(ids, [&](int v) { return is_inner(v) && t.valence(v) != 6; }) <=
             limits.irregular_share * count_of(ids, is_inner) &&
         count_of(half_edges, [&](int h) { return is_edge(h) && is_misfit(h); }) <=
             limits.misfit_share * count_of(half_edges, is_edge);
}

/// Of the chord of a circular arc that turns by so much, over the chord's length.
double relative_sagitta(double turn) {
  return turn < std::numbers::pi ? .5 * std::tan(turn / 4) : .5;
}

}  // namespace

int coarse_levels(const WorkingMesh& m, double wanted_faces, const CoarseLimits& limits) {
  if (!m.constraints.creases.empty() || is_regular(m, limits)) return 0;
  const double turn = exceeded_by(limits.bent_share, turns(m));
  const auto still = static_cast<double>(std::ranges::count(m.constraints.freedom, Freedom::fixed));
  const std::vector<int>& wanted = m.curve_edges.wanted;
  const double on_curves = std::accumulate(wanted.begin(), wanted.end(), 0.);
  const auto bears = [&](int level) {
    const double scale = std::pow(2, level), faces = wanted_faces / (scale * scale), vertices = .5 * faces;
    return faces >= limits.min_faces && relative_sagitta(scale * turn) <= limits.sagitta &&
           still + on_curves / scale <= limits.rim_share * vertices;
  };
  int level = 0;
  while (level < limits.levels && bears(level + 1)) ++level;
  return level;
}

AdaptationSteps::AdaptationSteps(Workspace& work, const StepOptions& options,
                                 const FlipGuardOptions& flip_guard, const EnergyTerms& terms,
                                 const GuardOptions& guards, double corner_angle, Observer observer)
    : work_(work),
      options_(options),
      flip_guard_(flip_guard),
      terms_(terms),
      guards_(guards),
      observer_(std::move(observer)),
      adapting_(work, corner_angle),
      graded_(work.graded()) {}

void AdaptationSteps::release_bends() {
  count_curve_edges(m_, options_.chord_error);
  Constraints& constraints = work_.constraints;
  for (size_t v = 0; v < constraints.freedom.size(); ++v) {
    if (!constraints.at_bend(static_cast<int>(v))) continue;
    const auto curve = static_cast<size_t>(constraints.curve[v]);
    const double wanted = m_.curve_edges.wanted[curve], ratio = wanted / m_.curve_edges.present[curve];
    if (std::max(ratio, 1 / ratio) > options_.keep_bends) constraints.freedom[v] = Freedom::curve;
  }
}

void AdaptationSteps::coarsen(int levels) {
  level_ += levels;
  for (double& length : work_.vertex_length) length = std::ldexp(length, levels);
}

int AdaptationSteps::bearable_levels(double wanted_faces, const CoarseLimits& limits) const {
  return coarse_levels(adapting_.mesh(), wanted_faces, limits);
}

void AdaptationSteps::change_lengths() {
  count_curve_edges(m_, options_.chord_error);
  // Splits leave flat faces, which collapses would keep. Where there are none, flips before the collapses
  // gain nothing: most of their edges go.
  if (const int splits =
          timed(work_.stopwatch, "splits", [&] { return split_long_edges(m_, options_.split); })) {
    counts_.splits += splits;
    FlippableMesh flipping = m_.flipping();
    counts_.flips += flip_to_delaunay(flipping, flip_guard_);
  }
  {
    const Stage stage(work_.stopwatch, "collapses");
    counts_.collapses += collapse_short_edges(m_, options_.collapse);
    counts_.collapses += collapse_folded_faces(m_, options_.folded);
  }
  add(match_curve_edges(m_, options_.count));
  give_up_unused_ids();
}

bool AdaptationSteps::change_count(double wanted_faces) {
  count_curve_edges(m_, options_.chord_error);
  add(match_curve_edges(m_, options_.count));
  const CountChanges inner = approach_count(m_, wanted_faces, options_.count);
  give_up_unused_ids();
  add(inner);
  return inner.splits + inner.collapses > 0;
}

void AdaptationSteps::lloyd_flow(int rounds) {
  const Stage stage(work_.stopwatch, "flow");
  FlippableMesh flipping = m_.flipping();
  counts_.flips += flip_to_delaunay(flipping, flip_guard_) + flip_corners_to_valence(flipping, flip_guard_);
  LloydFlowOptions options;
  options.rounds = rounds;
  const LloydFlowResult flowed = flow(flipping, options, flip_guard_, guards_, observer_);
  counts_.flips += flowed.flips;
  interrupted_ = flowed.interrupted;
  resample_lengths();
}

void AdaptationSteps::flip_irregular() {
  std::vector<char> lately_changed;
  for (int pass = 0; pass < options_.irregular.passes && !interrupted_; ++pass) {
    relax_springs();
    if (interrupted_ || pass_over_irregular(lately_changed) == 0) return;
  }
}

int AdaptationSteps::pass_over_irregular(std::vector<char>& lately_changed) {
  const Stage stage(work_.stopwatch, "irregular");
  const Observer watch = [this](const Progress& p) {
    interrupted_ = observer_ && !observer_(p);
    return !interrupted_;
  };
  FlippableMesh flipping = m_.flipping();
  const int flips =
      flip_irregular_edges(flipping, terms_, options_.irregular, flip_guard_, guards_, lately_changed, watch);
  resample_lengths();
  counts_.flips += flips;
  return flips;
}

void AdaptationSteps::subdivide() {
  const Stage stage(work_.stopwatch, "quadruple");
  count_curve_edges(m_, options_.chord_error);
  counts_.splits += hooke::subdivide(m_, options_.split, flip_guard_);
  give_up_unused_ids();
  coarsen(-1);
}

void AdaptationSteps::give_up_unused_ids() {
  const Stage stage(work_.stopwatch, "compact");
  compact(m_);
}

void AdaptationSteps::relax_springs() {
  const Stage stage(work_.stopwatch, "springs");
  Adjacency c = connectivity_of(m_.halfedges, static_cast<int>(m_.positions.points.cols()));
  split_wedges(c, m_.constraints.creases);
  const VertexColoring coloring = color_vertices(c);
  const TargetLengths targets = spread_target_lengths(c, m_.vertex_length);
  Energy energy(c, targets, terms_);
  Guards guards(c, targets, guards_);
  Relaxation r{c, coloring, m_.vertex_length, energy, m_.retraction, guards, m_.positions, work_.stopwatch};
  IntegrationOptions integration;
  integration.max_steps = options_.spring_steps;
  LbfgsOptions lbfgs;
  lbfgs.sweeps = 0;  // flow has left no slivers for them
  lbfgs.projects_at_end = false;
  interrupted_ = relax_lbfgs(r, integration, lbfgs, observer_).reason == StopReason::interrupted;
  resample_lengths();
}

void AdaptationSteps::resample_lengths() {
  if (!graded_) return;
  work_.vertex_length = work_.input_lengths();
  coarsen(std::exchange(level_, 0));
}

void AdaptationSteps::add(const CountChanges& changes) {
  counts_.splits += changes.splits;
  counts_.collapses += changes.collapses;
}

namespace {

class Adaptation {
 public:
  Adaptation(Workspace& work, const AdaptOptions& options, const FlipGuardOptions& flip_guard,
             const GuardOptions& guards, const EnergyTerms& terms, double corner_angle,
             const Observer& observer)
      : options_(options),
        observer_(observer),
        steps_(work, options.steps, flip_guard, terms, guards, corner_angle, watch()) {
    result_.wanted_faces =
        wanted_face_count(work.positions.points, work.adjacency->faces, work.vertex_length);
  }

  /// `folded`: are there faces that lie against the surface? Flow would carry them along where splits and
  /// collapses take them out.
  AdaptResult run(bool folded) {
    steps_.release_bends();
    result_.levels = steps_.bearable_levels(result_.wanted_faces, options_.coarse);
    if (result_.levels > 0)
      refine_coarse_mesh();
    else
      adapt_at_once(folded);
    steps_.finish();
    result_.splits = steps_.counts().splits;
    result_.collapses = steps_.counts().collapses;
    result_.flips = steps_.counts().flips;
    result_.interrupted = steps_.interrupted();
    return result_;
  }

 private:
  /// Without a coarser mesh first.
  void adapt_at_once(bool folded) {
    if (!folded) steps_.lloyd_flow(options_.first_flow);
    change_lengths(options_.rounds, options_.flow_rounds);
    approach(result_.wanted_faces, options_.count_slack);
  }

  void refine_coarse_mesh() {
    steps_.coarsen(result_.levels);
    change_lengths(options_.rounds, options_.coarse_flow);
    approach(result_.wanted_faces / std::pow(4, result_.levels), options_.count_slack);
    for (int level = result_.levels; level > 0; --level) {
      if (level < result_.levels) lloyd_flow(options_.coarse_flow);
      if (!steps_.interrupted()) steps_.flip_irregular();
      steps_.subdivide();  // interrupted or not: the target lengths are to be those that were asked for
    }
    change_lengths(options_.fine_rounds, options_.fine_flow);
    approach(result_.wanted_faces, options_.fine_count_slack * result_.wanted_faces);
  }

  void change_lengths(int rounds, int flow_rounds) {
    for (int i = 0; i < rounds && !steps_.interrupted(); ++i) {
      steps_.change_lengths();
      ++result_.rounds;
      lloyd_flow(flow_rounds);
    }
  }

  void approach(double wanted_faces, double slack) {
    for (int i = 0; i < options_.count_rounds && !steps_.interrupted(); ++i) {
      if (std::abs(steps_.face_count() - wanted_faces) <= slack) return;
      if (!steps_.change_count(wanted_faces)) return;
      ++result_.count_rounds;
      lloyd_flow(options_.count_flow);
    }
  }

  void lloyd_flow(int rounds) {
    if (!steps_.interrupted()) steps_.lloyd_flow(rounds);
  }

  Observer watch() const {
    if (!observer_) return nullptr;
    return [this](Progress p) {
      p.stage = "adapt";
      p.outer = result_.rounds + result_.count_rounds;
      return observer_(p);
    };
  }

  const AdaptOptions& options_;
  const Observer& observer_;
  AdaptationSteps steps_;
  AdaptResult result_;
};

UntangleResult unfold(Workspace& work, const EnergyTerms& terms, const GuardOptions& guard_options,
                      const Observer& observer) {
  Energy energy(*work.adjacency, work.targets, terms);
  Guards guards(*work.adjacency, work.targets, guard_options);
  Relaxation r{*work.adjacency,  work.coloring, work.vertex_length, energy,
               *work.retraction, guards,        work.positions};
  return untangle(r, UntangleOptions{}, observer);
}

}  // namespace

AdaptOptions adapt_options(Effort effort) {
  AdaptOptions options;
  switch (effort) {
    case Effort::fast:
      options.rounds = 2;
      options.first_flow = 4;
      options.count_flow = 0;
      options.coarse.levels = 3;
      options.coarse_flow = 3;
      options.fine_flow = 1;
      options.steps.spring_steps = 8;
      options.steps.irregular = {.passes = 1};
      options.last_flow = options.last_passes = 0;
      options.last_outer = 1;
      options.last_steps = 1;  // a sweep
      break;
    case Effort::standard:
      break;
    case Effort::thorough:
      options.rounds = 7;
      options.flow_rounds = 8;
      options.coarse_flow = options.fine_flow = 20;
      options.steps.irregular.passes = 8;
      options.steps.irregular.sweeps = 6;
      options.steps.irregular.max_energy_rise = .6;
      options.steps.irregular.max_rise_after_relaxation = .2;
      options.last_flow = 20;
      options.last_passes = 8;
      break;
  }
  return options;
}

FlipOptions flips_after(const AdaptResult& adapted, const AdaptOptions& options, FlipOptions flips) {
  if (adapted.levels == 0) return flips;
  flips.flow.rounds = std::min(flips.flow.rounds, options.last_flow);
  flips.passes.passes = std::min(flips.passes.passes, options.last_passes);
  return flips;
}

AdaptResult adapt(Workspace& work, const AdaptOptions& options, const FlipGuardOptions& flip_guard,
                  const EnergyTerms& terms, const GuardOptions& guards, double corner_angle,
                  const Observer& observer) {
  const UntangleResult unfolded = unfold(work, terms, guards, observer);
  AdaptResult result;
  if (unfolded.interrupted)
    result.interrupted = true;
  else
    result = Adaptation(work, options, flip_guard, guards, terms, corner_angle, observer)
                 .run(!unfolded.folded.empty());
  result.untangle = unfolded;
  return result;
}

}  // namespace hooke
