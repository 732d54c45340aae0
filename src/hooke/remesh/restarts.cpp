#include "hooke/remesh/restarts.h"

#include "hooke/remesh/remesh.h"

#include <cstdio>
#include <cstdlib>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "hooke/core/stopwatch.h"
#include "hooke/geometry/self_intersection.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/sagitta.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {
namespace {

Quality measure(const MeasuredSurface& surface, const TriMesh& mesh, const Permutation& order,
                Stopwatch* stopwatch) {
  const std::vector<double> lengths = order.gather(vertex_values(mesh, target_length_property));
  return measure_quality(surface, spread_target_lengths(surface.adjacency, lengths).edge, {}, stopwatch);
}

/// The edges by the indices of their vertices in the order, from their ids.
std::vector<Edge> in_order(const Permutation& order, const std::vector<Edge>& edges) {
  std::vector<int> ends;
  for (const Edge& e : edges) ends.insert(ends.end(), e.begin(), e.end());
  ends = order.new_vertices(ends);
  std::vector<Edge> ordered(edges.size());
  for (size_t e = 0; e < edges.size(); ++e) ordered[e] = {ends[2 * e], ends[2 * e + 1]};
  return ordered;
}

struct Run {
  TriMesh mesh;
  RemeshResult result;
  double angle = 0;   // minimum angle, degrees
  double bound = 60;  // upper bound of the minimum angle of that face, degrees

  bool is_interrupted() const { return result.reason == StopReason::interrupted; }

  const Preservation& preservation() const { return result.measures->preservation; }

  std::size_t flaws() const { return result.measures ? preservation().flaws() : std::size_t(-1); }

  std::size_t face_count() const { return result.memory_order.adjacency->faces.size(); }

  bool is_better_than(const Run& other) const {
    return std::pair(flaws(), -angle) < std::pair(other.flaws(), -other.angle);
  }
};

class Restarts {
 public:
  Restarts(const TriMesh& mesh, const MemoryOrder& memory_order, const RemeshOptions& options,
           const RestartOptions& restarts, const KnownInput& known, const Observer& observer,
           Stopwatch* stopwatch)
      : mesh_(mesh),
        memory_order_(memory_order),
        options_(options),
        restarts_(restarts),
        observer_(observer),
        stopwatch_(stopwatch),
        input_(memory_order.order.gather(vertex_points(mesh)), *memory_order.adjacency,
               memory_order.order.old_ids(), known.tree_order),
        preservation_(restarts.preservation),
        input_quality_(known.quality ? *known.quality
                                     : measure(input_, mesh, memory_order.order, stopwatch)) {
    preservation_.faceted = is_faceted(input_.points, input_.adjacency);
    preservation_.keeps_facets = preservation_.faceted && options.connectivity != ConnectivityMode::adapt;
  }

  Run best() {
    Run best = make(options_);
    judge(best);
    if (!best.result.measures) return best;  // not finite
    if (!best.is_interrupted()) hold_tips(best);
    if (!best.is_interrupted()) restart(best);
    if (!best.is_interrupted() && best.flaws() > 0) project_to_faces(best);
    if (!best.is_interrupted() && best.flaws() > 0) put_back(best);
    best.result.restarts = made_;
    best.result.kept_run = kept_;
    return best;
  }

 private:
  bool is_good(const Run& a) const {
    constexpr double close = .99;
    return a.flaws() == 0 && a.angle >= std::min(restarts_.good_angle, close * a.bound);
  }

  /// Makes a run and keeps it if it is better. An interrupted run is discarded.
  void try_run(const RemeshOptions& options, Rescue rescue, Run& best) {
    Run next = make(options);
    if (next.is_interrupted()) {
      best.result.reason = StopReason::interrupted;
      --made_;
      return;
    }
    judge(next);
    tests_ += next.result.sliver_tests;
    next.result.rescue = rescue;
    if (!next.is_better_than(best)) return;
    best = std::move(next);
    kept_ = made_;
  }

  /// Runs again with the vertices held that the result has lost, as the tip of a cone.
  void hold_tips(Run& best) {
    std::vector<FarVertex> lost = best.preservation().lost_vertices;
    if (lost.empty()) return;
    constexpr std::size_t max_tips = 100;
    std::ranges::stable_sort(lost, std::greater(), &FarVertex::distance);
    std::vector<int> held;
    for (const FarVertex& tip : lost) {
      const auto is_near = [&](int v) {
        return (input_.points.col(v) - input_.points.col(tip.vertex)).norm() < 2 * tip.distance;
      };
      if (held.size() < max_tips && std::ranges::none_of(held, is_near)) held.push_back(tip.vertex);
    }
    for (int v : held)
      options_.constraints.fixed_vertices.push_back(memory_order_.order.old_vertex[static_cast<size_t>(v)]);
    try_run(options_, best.result.rescue == Rescue::none ? Rescue::tips : best.result.rescue, best);
  }

  /// Runs a small mesh again while the result is not good.
  void restart(Run& best) {
    if (options_.connectivity == ConnectivityMode::fixed) return;
    const int max_flawed_runs = preservation_.keeps_facets ? 2 : 7;
    const double max_runs =
        std::min<double>(restarts_.max_runs, restarts_.max_faces / static_cast<double>(best.face_count()));
    tests_ += best.result.sliver_tests;
    for (int i = 1; made_ + 1 <= max_runs && tests_ < restarts_.max_sliver_tests && !best.is_interrupted() &&
                    !is_good(best) && (best.flaws() == 0 || made_ < max_flawed_runs);
         ++i)
      try_run(varied(i), best.result.rescue, best);
  }

  /// The options of a restart: edges are split at a slightly different length, Lloyd flow has a few more or
  /// fewer rounds, and the deviation bound of the surface is smaller.
  RemeshOptions varied(int number) const {
    RemeshOptions o = options_;
    const int by = number % 2 == 1 ? (number + 1) / 2 : -number / 2;
    o.flips.flow.rounds = std::max(1, o.flips.flow.rounds + 4 * by);
    o.adaptation.steps.split.longest *= 1 - .02 * by;
    o.filter.max_deviation *= std::pow(.9, std::abs(by));
    return o;
  }

  void project_to_faces(Run& best) {
    if (options_.filter.kind == FilterKind::closest) return;
    options_.filter.kind = FilterKind::closest;
    try_run(options_, Rescue::closest, best);
    if (!best.is_interrupted()) hold_tips(best);
  }

  /// Puts vertices back to where they were, ring by ring around what is wrong, in the end all; a result with
  /// other faces is replaced by one with those of the input first.
  void put_back(Run& best) {
    if (options_.connectivity == ConnectivityMode::adapt) return;
    if (options_.connectivity == ConnectivityMode::flip) {
      RemeshOptions o = options_;
      o.connectivity = ConnectivityMode::fixed;
      Run next = make(o);
      if (next.is_interrupted()) {
        best.result.reason = StopReason::interrupted;
        return;
      }
      judge(next);
      best = std::move(next);
      kept_ = made_;
      if (best.flaws() == 0) {
        best.result.rescue = Rescue::put_back;
        return;
      }
    }
    best.result.rescue = Rescue::put_back;
    const auto input_pairs = find_self_intersections(input_.tree);
    for (int rings : {1, 2, 4, 8, 16}) {
      const std::vector<int> wrong = wrong_vertices(best, input_pairs);
      if (wrong.empty()) break;
      move_back(best, wrong, rings);
      if (best.flaws() == 0) return;
    }
    std::vector<int> all(static_cast<size_t>(input_.adjacency.vertex_count));
    std::iota(all.begin(), all.end(), 0);
    move_back(best, all, 1);
  }

  /// The vertices, in memory order, of faces that are turned over, intersect or fold as those of the input do
  /// not, and those that are too far. Pre-condition: the faces are those of the input.
  std::vector<int> wrong_vertices(const Run& run, const std::vector<std::array<int, 2>>& input_pairs) const {
    const MeasuredSurface now = surface_of(run);
    const Adjacency& c = input_.adjacency;
    std::vector<int> wrong;
    const auto add_face = [&](int f) {
      const Triangle& t = c.faces[static_cast<size_t>(f)];
      wrong.insert(wrong.end(), t.begin(), t.end());
    };
    for (const auto& pair : find_self_intersections(now.tree))
      if (!std::ranges::binary_search(input_pairs, pair))
        for (int f : pair) add_face(f);
    std::vector<int> index_of_face(c.faces.size());
    const auto& old_face = memory_order_.order.old_face;
    for (size_t f = 0; f < old_face.size(); ++f)
      index_of_face[static_cast<size_t>(old_face[f])] = static_cast<int>(f);
    for (int id : run.result.measures->deviation.flipped_faces)
      add_face(index_of_face[static_cast<size_t>(id)]);
    for (size_t e = 0; e < c.edges.size(); ++e) {
      const auto& [left, right] = c.edge_faces[e];
      if (right < 0) continue;
      const auto fold = [&](const Mat3X& points) {
        return cosine_between(points, c.faces[static_cast<size_t>(left)],
                              c.faces[static_cast<size_t>(right)]);
      };
      if (fold(now.points) < 0 && fold(now.points) < fold(input_.points)) {
        add_face(left);
        add_face(right);
      }
    }
    for (const FarVertex& far : run.preservation().far_vertices) wrong.push_back(far.vertex);
    for (const FarVertex& lost : run.preservation().lost_vertices) wrong.push_back(lost.vertex);
    std::ranges::sort(wrong);
    wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
    return wrong;
  }

  /// Moves the vertices to their places in the input, and those within `rings` rings around them the less,
  /// the farther away they are.
  void move_back(Run& run, const std::vector<int>& vertices, int rings) const {
    auto points = vertex_points(run.mesh);
    const auto input = vertex_points(mesh_);
    const Adjacency& c = input_.adjacency;
    std::vector<int> ring(static_cast<size_t>(c.vertex_count), rings), front = vertices;
    for (int v : vertices) ring[static_cast<size_t>(v)] = 0;
    for (size_t i = 0; i < front.size(); ++i)
      for (int n : c.vertex_neighbours[front[i]]) {
        const int next = ring[static_cast<size_t>(front[i])] + 1;
        if (next >= ring[static_cast<size_t>(n)]) continue;
        ring[static_cast<size_t>(n)] = next;
        front.push_back(n);
      }
    for (int v : front) {
      const int id = memory_order_.order.old_vertex[static_cast<size_t>(v)];
      const double share = static_cast<double>(ring[static_cast<size_t>(v)]) / rings;
      points.col(id) = (input.col(id) + share * (points.col(id) - input.col(id))).eval();
    }
    judge(run);
  }

  Run make(const RemeshOptions& options) {
    Run a;
    a.mesh = mesh_;
    a.result = remesh(a.mesh, memory_order_, options, observer_, stopwatch_);
    ++made_;
    return a;
  }

  MeasuredSurface surface_of(const Run& a) const {
    const MemoryOrder& memory_order = a.result.memory_order;
    const bool same_faces = memory_order.adjacency->faces.size() == input_.adjacency.faces.size() &&
                            options_.connectivity == ConnectivityMode::fixed;
    return {memory_order.order.gather(vertex_points(a.mesh)), *memory_order.adjacency,
            memory_order.order.old_ids(), same_faces ? input_.tree.order() : std::vector<int>()};
  }

  void judge(Run& a) const {
    a.result.measures.reset();
    if (!vertex_points(a.mesh).allFinite()) return;
    const Permutation& order = a.result.memory_order.order;
    const MeasuredSurface surface = timed(stopwatch_, "tree", [&] { return surface_of(a); });
    ResultMeasures m;
    m.quality = timed(stopwatch_, "after", [&] { return measure(surface, a.mesh, order, stopwatch_); });
    bound_between_creases(m.quality.worst_faces, surface, a.result.crease_edges);
    m.deviation =
        timed(stopwatch_, "deviation", [&] { return measure_deviation(input_, surface, stopwatch_); });
    m.preservation = timed(stopwatch_, "preservation", [&] {
      const std::vector<Edge> before = in_order(memory_order_.order, a.result.input_creases),
                              after = in_order(order, a.result.crease_edges);
      return measure_preservation({input_, input_quality_, before}, {surface, m.quality, after}, m.deviation,
                                  preservation_);
    });
    // The two sides of a cut touch in as many pairs as there are faces.
    if (has_coincident_boundary_) m.preservation.new_crossings = 0;
    a.angle = m.quality.worst_faces.front().min_angle;
    a.bound = m.quality.worst_faces.front().bound.degrees;
    if (getenv("DBG")) { const auto& p = m.preservation; fprintf(stderr, "DBG run %d angle %.2f bound %.1f flipped %zu folds %zu crossings %zu topo %d creases %d (%g) far %zu lost %zu excess %.2f at %g %g %g faces %zu tests %d\n", made_, a.angle, a.bound, p.flipped_faces, p.new_folds, p.new_crossings, p.topology_kept, p.creases_kept, p.crease_loss, p.far_vertices.size(), p.lost_vertices.size(), p.excess, p.place[0], p.place[1], p.place[2], a.face_count(), a.result.sliver_tests); }
    a.result.measures = std::move(m);
  }

  const TriMesh& mesh_;
  const MemoryOrder& memory_order_;
  RemeshOptions options_;
  const RestartOptions& restarts_;
  const Observer& observer_;
  Stopwatch* stopwatch_;
  const MeasuredSurface input_;
  PreservationOptions preservation_;
  const Quality input_quality_;
  const bool has_coincident_boundary_ =
      !coincident_boundary_vertices(input_.points, input_.adjacency).empty();
  int made_ = 0, kept_ = 1;
  int tests_ = 0;
};

}  // namespace

RestartOptions restart_options(Effort effort) {
  switch (effort) {
    case Effort::fast:
      return {.max_runs = 1};
    case Effort::standard:
      break;
    case Effort::thorough:
      return {.max_runs = 20, .max_faces = 2e5, .max_sliver_tests = 4000};
  }
  return {};
}

RemeshResult remesh_with_restarts(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                                  const RestartOptions& restarts, const KnownInput& known,
                                  const Observer& observer, Stopwatch* stopwatch) {
  Run best = Restarts(mesh, memory_order, options, restarts, known, observer, stopwatch).best();
  mesh = std::move(best.mesh);
  return std::move(best.result);
}

}  // namespace hooke
