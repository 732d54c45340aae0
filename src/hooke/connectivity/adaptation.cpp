#include "hooke/connectivity/adaptation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "hooke/connectivity/corner_flips.h"
#include "hooke/connectivity/edge_collapses.h"
#include "hooke/connectivity/edge_flips.h"
#include "hooke/connectivity/edge_splits.h"
#include "hooke/connectivity/face_count.h"
#include "hooke/connectivity/junction_edges.h"
#include "hooke/connectivity/lloyd_flow.h"
#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/integrator/untangle.h"
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

/// Maximum distance of a feature curve from its edges, in target lengths.
constexpr double max_chord_error = .1;

struct StepCounts {
  long long splits = 0, collapses = 0, flips = 0;
};

/// The steps of the adaptation. All preserve the topology, boundary loops, creases, corners and fixed
/// vertices. Keeps references to its arguments. finish() must be the last call.
class AdaptationSteps {
 public:
  AdaptationSteps(Workspace& work, const AdaptOptions& options, const EnergyTerms& terms,
                  const ShapeLimits& limits, Observer observer);

  /// Lets vertices at bends move and collapse on curves whose number of edges is to change.
  void release_bends();

  /// Splits and collapses edges of junctions, see match_junction_edges().
  void match_junctions();

  /// Multiplies the target lengths by 2^levels.
  void coarsen(int levels);

  /// See hooke::coarse_levels().
  int coarse_levels(double target_faces, const CoarseLimits& limits) const;

  /// Splits and collapses edges that are too long or too short, and matches the edge counts of the curves.
  void split_and_collapse();

  /// Brings the number of faces closer to the target; false if hardly an inner edge could be changed, as
  /// where narrow parts need them.
  bool change_count(double target_faces);

  /// Lloyd flow, after which the mesh is Delaunay and its vertices lie on the surface, within the guards.
  void lloyd_flow(int rounds);

  /// Passes of springs and flips near irregular vertices, until one flips nothing.
  void flip_irregular();

  /// Lets target lengths be as short as this in narrow regions, see Workspace.
  void shorten_in_narrow_regions(double shortest, double gradation);
  bool has_placed_lengths() const { return work_.has_placed_lengths(); }

  /// 1-to-4 subdivision; also halves the target lengths.
  void subdivide();

  /// Writes the mesh to the workspace.
  void finish() { work_.replace_mesh(m_.halfedges.faces(), m_.halfedges.wedges()); }

  /// Number of faces of the target length that the surface takes. No face may be removed.
  double wanted_faces() const { return target_face_count(m_.vertices, m_.halfedges.faces()); }

  double face_count() const { return static_cast<double>(m_.halfedges.faces().size()); }
  const StepCounts& counts() const { return counts_; }
  bool interrupted() const { return interrupted_; }

 private:
  void compact_ids();
  void relax_springs();
  int pass_over_irregular(std::vector<char>& lately_changed);
  void sample_lengths_at_vertices();
  void resample_lengths();
  void add(const CountChanges& changes);

  Workspace& work_;
  const AdaptOptions& options_;
  const EnergyTerms& terms_;
  const ShapeLimits& limits_;
  const Observer observer_;
  WorkingMesh m_;
  int level_ = 0;  // the target lengths are multiplied by 2^level_
  StepCounts counts_;
  bool interrupted_ = false;
};

/// Turn of the surface normal along an arc of the target length, radians, with a weight for its share.
struct Turn {
  double angle, weight;
};

/// Per half-edge; the weight is 0 for one of the two half-edges of each edge.
std::vector<Turn> turns(const WorkingMesh& m) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& N = m.vertices.positions.normals;
  std::vector<Turn> turns(t.half_edge_count(), Turn{0, 0});
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

/// The angle that is exceeded by no more than this share of the total weight; 0 if there is no weight.
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

/// About the number of vertices that splits put on the edges of fans: at vertices with very many edges.
double splits_of_fans(const WorkingMesh& m) {
  constexpr int very_many = 50;
  const HalfedgeMesh& t = m.halfedges;
  double number = 0;
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (!t.is_removed(h / 3) && t.twin(h) < h &&
        std::max(t.valence(t.from(h)), t.valence(t.to(h))) > very_many)
      number += std::max(0., relative_length(m, h) - 1);
  return number;
}

/// Number of ids in [0, count) that satisfy the predicate, which is called from several threads.
double count_of(int count, const auto& is_such) {
  return parallel_sum(count, 4096, [&](size_t begin, size_t end) {
    double number = 0;
    for (size_t i = begin; i < end; ++i) number += is_such(static_cast<int>(i));
    return number;
  });
}

bool is_regular(const WorkingMesh& m, const CoarseLimits& limits) {
  const HalfedgeMesh& t = m.halfedges;
  const auto is_inner = [&](int v) { return t.valence(v) > 0 && !t.on_boundary(v); };
  const auto is_edge = [&](int h) { return t.twin(h) <= h; };
  constexpr double misfit_share = .01;               // of the edges
  constexpr double shortest = .8, longest = 4. / 3;  // of those that fit, over the target lengths
  const auto is_misfit = [&](int h) {
    const double length = relative_length(m, h);
    return length < shortest || length > longest;
  };
  const int ids = t.id_count(), half_edges = t.half_edge_count();
  return count_of(ids, [&](int v) { return is_inner(v) && t.valence(v) != 6; }) <=
             limits.irregular_share * count_of(ids, is_inner) &&
         count_of(half_edges, [&](int h) { return is_edge(h) && is_misfit(h); }) <=
             misfit_share * count_of(half_edges, is_edge);
}

/// Sagitta over chord length of a circular arc that turns by this angle, radians; at most 1/2.
double relative_sagitta(double turn) {
  return turn < std::numbers::pi ? .5 * std::tan(turn / 4) : .5;
}

}  // namespace

int coarse_levels(const WorkingMesh& m, double target_faces, const CoarseLimits& limits) {
  if (!m.vertices.constraints.creases.empty() || is_regular(m, limits)) return 0;
  const double turn = exceeded_by(limits.bent_share, turns(m));
  const auto still = static_cast<double>(std::ranges::count(m.vertices.constraints.freedom, Freedom::fixed));
  const std::vector<int>& target = m.curve_edges.target;
  const double on_curves = std::accumulate(target.begin(), target.end(), 0.);
  const auto bears = [&](int level) {
    const double scale = std::pow(2, level), faces = target_faces / (scale * scale), vertices = .5 * faces;
    return faces >= limits.min_faces && relative_sagitta(scale * turn) <= limits.sagitta &&
           still + on_curves / scale <= limits.constrained_share * vertices;
  };
  int level = 0;
  while (level < limits.levels && bears(level + 1)) ++level;
  return level;
}

AdaptationSteps::AdaptationSteps(Workspace& work, const AdaptOptions& options, const EnergyTerms& terms,
                                 const ShapeLimits& limits, Observer observer)
    : work_(work),
      options_(options),
      terms_(terms),
      limits_(limits),
      observer_(std::move(observer)),
      m_(work) {
  work.set_corner_valences();
  if (work.has_placed_lengths()) sample_lengths_at_vertices();
}

void AdaptationSteps::release_bends() {
  count_curve_edges(m_, max_chord_error);
  const auto is_to_change = [&](const CurveEdges& edges, int curve) {
    const double target = edges.target[curve], ratio = target / edges.present[curve];
    // A curve keeps its bends about the target count, and where it is split between them.
    constexpr double about = 1.3, resolved = 1.5;
    return ratio < resolved && std::max(ratio, 1 / ratio) > about;
  };
  Constraints& constraints = work_.vertices.constraints;
  for (size_t v = 0; v < constraints.freedom.size(); ++v)
    if (constraints.at_bend(static_cast<int>(v)) && is_to_change(m_.curve_edges, constraints.curve[v]))
      constraints.freedom[v] = Freedom::curve;
  const CurveEdges of_junctions = count_junction_edges(m_, max_chord_error);
  for (JunctionVertex& v : constraints.junction_vertices)
    if (v.curve >= 0 && !v.slides) v.slides = is_to_change(of_junctions, v.curve);
}

void AdaptationSteps::match_junctions() {
  const CountChanges changes = match_junction_edges(m_, max_chord_error);
  if (changes.splits + changes.collapses == 0) return;
  add(changes);
  counts_.flips += flip_to_delaunay(m_);
  compact_ids();
}

void AdaptationSteps::coarsen(int levels) {
  level_ += levels;
  for (double& length : work_.vertices.vertex_length) length = std::ldexp(length, levels);
}

int AdaptationSteps::coarse_levels(double target_faces, const CoarseLimits& limits) const {
  return hooke::coarse_levels(m_, target_faces, limits);
}

void AdaptationSteps::split_and_collapse() {
  count_curve_edges(m_, max_chord_error);
  // Splits would cut needles, as of extruded bodies, into many times the faces that are wanted, so they come
  // a share at a time, and after collapses where needles form fans, as in the caps of these bodies.
  const double wanted = wanted_faces();  // before any collapse: removed faces have no vertices
  if (constexpr double far_more = 4; splits_of_fans(m_) > far_more * wanted) {
    const Stage stage(work_.stopwatch, "collapses");
    counts_.collapses += collapse_short_edges(m_);
  }
  constexpr double max_at_once = 1e9;
  constexpr int max_passes = 100;
  const auto at_once = static_cast<int>(std::min(max_at_once, 2 * wanted + 1000));
  for (int pass = 0, splits = at_once; pass < max_passes && splits == at_once && !interrupted_; ++pass) {
    splits = timed(work_.stopwatch, "splits", [&] { return split_long_edges(m_, at_once); });
    counts_.splits += splits;
    // Splits leave flat faces, which prevent collapses, so flips come first. Without splits, flips before the
    // collapses gain nothing: most of the flipped edges collapse.
    if (splits > 0) counts_.flips += flip_to_delaunay(m_);
    const Stage stage(work_.stopwatch, "collapses");
    counts_.collapses += collapse_short_edges(m_);
    interrupted_ = observer_ && !observer_({.step = pass});
  }
  counts_.collapses += timed(work_.stopwatch, "collapses", [&] { return collapse_folded_faces(m_); });
  add(match_curve_edges(m_));
  compact_ids();
  if (level_ == 0) match_junctions();
}

bool AdaptationSteps::change_count(double target_faces) {
  constexpr double hardly_any = .05;  // of the edges that a round changes where nothing holds them
  const int planned = changes_towards(target_faces, face_count());
  count_curve_edges(m_, max_chord_error);
  add(match_curve_edges(m_));
  const CountChanges inner = approach_face_count(m_, target_faces);
  compact_ids();
  add(inner);
  return inner.splits + inner.collapses > hardly_any * planned;
}

void AdaptationSteps::lloyd_flow(int rounds) {
  const Stage stage(work_.stopwatch, "flow");
  counts_.flips += flip_to_delaunay(m_) + flip_corners_to_valence(m_);
  const LloydFlowResult flowed = flow(m_, rounds, limits_, observer_);
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
  const int flips = flip_irregular_edges(m_, terms_, options_.irregular, limits_, lately_changed, watch);
  resample_lengths();
  counts_.flips += flips;
  return flips;
}

void AdaptationSteps::subdivide() {
  const Stage stage(work_.stopwatch, "quadruple");
  count_curve_edges(m_, max_chord_error);
  counts_.splits += hooke::subdivide(m_);
  compact_ids();
  coarsen(-1);
}

void AdaptationSteps::compact_ids() {
  const Stage stage(work_.stopwatch, "compact");
  compact(m_);
}

void AdaptationSteps::relax_springs() {
  const Stage stage(work_.stopwatch, "springs");
  Adjacency c = adjacency_of(m_.halfedges, static_cast<int>(m_.vertices.positions.points.cols()));
  split_wedges(c, m_.vertices.constraints.creases);
  const VertexColoring coloring = color_vertices(c);
  const TargetLengths targets = spread_target_lengths(c, m_.vertices.vertex_length);
  Relaxation r(c, coloring, targets, m_.vertices, m_.retraction, terms_, limits_, work_.stopwatch);
  IntegrationOptions integration;
  integration.max_steps = options_.spring_steps;
  LbfgsOptions lbfgs;
  lbfgs.sweeps = 0;  // no slivers are left after the Lloyd flow
  lbfgs.projects_at_end = false;
  interrupted_ = relax_lbfgs(r, integration, lbfgs, observer_).reason == StopReason::interrupted;
  resample_lengths();
}

void AdaptationSteps::shorten_in_narrow_regions(double shortest, double gradation) {
  if (!work_.shorten_in_narrow_regions(shortest, gradation)) return;
  sample_lengths_at_vertices();
  resample_lengths();
}

void AdaptationSteps::sample_lengths_at_vertices() {
  m_.length_at = [this](int v) { return std::ldexp(work_.input_length(v), level_); };
}

void AdaptationSteps::resample_lengths() {
  if (!work_.has_varying_lengths()) return;
  work_.vertices.vertex_length = work_.input_lengths();
  coarsen(std::exchange(level_, 0));
}

void AdaptationSteps::add(const CountChanges& changes) {
  counts_.splits += changes.splits;
  counts_.collapses += changes.collapses;
}

namespace {

class Adaptation {
 public:
  Adaptation(Workspace& work, const AdaptOptions& options, const EnergyTerms& terms,
             const ShapeLimits& limits, const Observer& observer)
      : options_(options),
        observer_(observer),
        goes_on_(work.has_held_vertices()),
        steps_(work, options, terms, limits, watch()) {
    result_.target_faces = target_face_count(work.vertices, work.adjacency->faces);
  }

  /// `folded`: are there folded faces? Splits and collapses remove them, whereas Lloyd flow would keep them.
  AdaptResult run(bool folded) {
    if (!goes_on_) start_from_input();
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
  void start_from_input() {
    steps_.release_bends();
    steps_.match_junctions();
    // After the bends and junctions of the input: long edges do not show lengths that vary along them.
    if (options_.min_length > 0) steps_.shorten_in_narrow_regions(options_.min_length, options_.gradation);
    if (!steps_.has_placed_lengths())
      result_.levels = steps_.coarse_levels(result_.target_faces, options_.coarse);
  }

  /// Without a coarser mesh.
  void adapt_at_once(bool folded) {
    if (!folded) steps_.lloyd_flow(options_.first_flow);
    adapt_lengths(options_.rounds, options_.flow_rounds);
    if (steps_.has_placed_lengths()) result_.target_faces = steps_.wanted_faces();
    approach(result_.target_faces, count_slack);
  }

  void refine_coarse_mesh() {
    steps_.coarsen(result_.levels);
    adapt_lengths(options_.rounds, options_.coarse_flow);
    approach(result_.target_faces / std::pow(4, result_.levels), count_slack);
    for (int level = result_.levels; level > 0; --level) {
      if (level < result_.levels) lloyd_flow(options_.coarse_flow);
      if (!steps_.interrupted()) steps_.flip_irregular();
      steps_.subdivide();  // even if interrupted, to restore the requested target lengths
    }
    adapt_lengths(1, options_.fine_flow);
    constexpr double fine_count_slack = .01;  // share of the target face count
    approach(result_.target_faces, fine_count_slack * result_.target_faces);
  }

  void adapt_lengths(int rounds, int flow_rounds) {
    for (int i = 0; i < rounds && !steps_.interrupted(); ++i) {
      steps_.split_and_collapse();
      ++result_.rounds;
      lloyd_flow(flow_rounds);
    }
  }

  void approach(double target_faces, double slack) {
    constexpr int max_rounds = 30;
    for (int i = 0; i < max_rounds && !steps_.interrupted(); ++i) {
      if (std::abs(steps_.face_count() - target_faces) <= slack) return;
      if (!steps_.change_count(target_faces)) return;
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

  static constexpr double count_slack = 2;  // faces by which the count may miss the target

  const AdaptOptions& options_;
  const Observer& observer_;
  const bool goes_on_;
  AdaptationSteps steps_;
  AdaptResult result_;
};

}  // namespace

FlipOptions flips_after(const AdaptResult& adapted, const AdaptOptions& options, FlipOptions flips) {
  if (adapted.levels == 0) return flips;
  flips.flow_rounds = std::min(flips.flow_rounds, options.last_flow);
  flips.passes.passes = std::min(flips.passes.passes, options.last_passes);
  return flips;
}

AdaptResult adapt(Workspace& work, const AdaptOptions& options, const EnergyTerms& terms,
                  const ShapeLimits& limits, const Observer& observer) {
  const UntangleResult unfolded = [&] {
    Relaxation relaxation(work, terms, limits);
    return untangle(relaxation, observer);
  }();
  AdaptResult result;
  if (unfolded.interrupted)
    result.interrupted = true;
  else
    result = Adaptation(work, options, terms, limits, observer).run(!unfolded.folded.empty());
  result.folded_before = unfolded.folded_before;
  return result;
}

}  // namespace hooke
