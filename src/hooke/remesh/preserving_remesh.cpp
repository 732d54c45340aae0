#include "hooke/remesh/preserving_remesh.h"

#include "hooke/remesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "hooke/core/stopwatch.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/sagitta.h"
#include "hooke/mesh/staircase.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/springs/sizing.h"

namespace hooke {
namespace {

Quality measure(const MeasuredSurface& surface, const TriMesh& mesh, const Permutation& order,
                Stopwatch* stopwatch) {
  return measure_quality(surface, target_lengths_of(mesh, order, surface.adjacency).edge, {}, stopwatch);
}

struct Run {
  TriMesh mesh;
  RemeshResult result;
  double angle = 0;           // minimum angle, degrees
  double unmended_angle = 0;  // before vertices were moved to the input
  bool lost_angle = false;  // is it less than in the input with fixed faces, or with flipped ones and small?

  bool is_interrupted() const { return result.reason == StopReason::interrupted; }

  const Preservation& preservation() const { return result.measures->preservation; }

  std::size_t flaws() const { return result.measures ? preservation().flaws() : std::size_t(-1); }

  /// Faces that lie against the surface where others lie like them, as a chord across a sharp rounding: no
  /// broken promise, but better avoided. None if there are so many that the input is rough.
  std::size_t chords() const {
    constexpr std::size_t max_chords = 20;
    const std::size_t count = result.measures->deviation.opposing_faces.size();
    return count > max_chords ? 0 : count;
  }

  std::size_t face_count() const { return result.memory_order.adjacency->faces.size(); }

  /// Does nothing break a promise?
  bool keeps_promises() const { return flaws() == 0 && !lost_angle; }

  /// The same, and have angles not become small for it?
  bool is_good() const {
    constexpr double good_angle = 25, kept_share = .8;
    return keeps_promises() && angle >= std::min(good_angle, kept_share * unmended_angle);
  }

  bool is_better_than(const Run& other) const {
    return std::tuple(flaws(), lost_angle, -angle) <
           std::tuple(other.flaws(), other.lost_angle, -other.angle);
  }
};

class PreservingRemesh {
 public:
  PreservingRemesh(const TriMesh& mesh, const MemoryOrder& memory_order, const RemeshOptions& options,
                   const PreservationOptions& preservation, const KnownInput& known, const Observer& observer,
                   Stopwatch* stopwatch, bool smooths_steps)
      : mesh_(mesh),
        memory_order_(memory_order),
        options_(options),
        observer_(observer),
        stopwatch_(stopwatch),
        input_(memory_order.order.gather(vertex_points(mesh)), *memory_order.adjacency,
               memory_order.order.old_ids(), known.tree_order, joined_vertices(mesh, memory_order.order)),
        preservation_(preservation),
        input_quality_(known.quality ? *known.quality
                                     : measure(input_, mesh, memory_order.order, stopwatch)) {
    is_mask_ = smooths_steps && options.constraints.features.drops_noise &&
               options.constraints.hard_edges.empty() && is_marched_mask_at_lengths();
    const bool is_noise = is_mask_ || (options.constraints.features.drops_noise &&
                                       is_staircase(input_.points, input_.adjacency, target_lengths()));
    if (is_noise) preservation_.feature_angle = 180;
    if (is_mask_) smooth_steps();
    constexpr double rounding = 1e-9;
    const bool must_unfold = input_quality_.folded_edges > 0;
    if (!must_unfold && !target_lengths_of(mesh, memory_order.order, input_.adjacency).edge.is_varying())
      least_angle_ = (1 - rounding) * input_quality_.min_angle.min;
    preservation_.faceted = !is_noise && is_faceted(input_.points, input_.adjacency);
    preservation_.keeps_facets = preservation_.faceted && options.connectivity != ConnectivityMode::adapt;
  }

  Run best() {
    Run best = attempt();
    if (!best.result.measures) return best;  // not finite
    const FilterKind filter = options_.filter.kind;
    if (best.is_interrupted() && options_.connectivity == ConnectivityMode::adapt) mend(best);
    if (!best.is_interrupted() && !best.is_good()) project_to_faces(best);
    if (!best.is_interrupted() && !best.keeps_promises()) hold_junctions(filter, best);
    if (options_.connectivity == ConnectivityMode::adapt && !best.is_interrupted() &&
        !best.keeps_promises() && !is_mask_)
      shorten_lengths(filter, best);
    if (best.is_interrupted() ? best.flaws() > 0 : !best.keeps_promises()) put_back(best);
    if (options_.connectivity != ConnectivityMode::adapt && vertex_points(best.mesh) == vertex_points(mesh_))
      best.result.steps_smoothed = false;
    return best;
  }

 private:
  /// A run with the vertices moved to the input that must be. If vertices of the input are lost in spite
  /// of that, or angles get small, but nothing else is wrong, there is a second run with these held; it is
  /// discarded if it is interrupted.
  Run attempt() {
    Run run = make();
    judge(run);
    if (!run.result.measures || run.is_interrupted()) return run;
    const std::vector<FarVertex> lost = run.preservation().lost_vertices;
    mend(run);
    const bool only_lost = run.flaws() == run.preservation().lost_vertices.size();
    if (lost.empty() || run.is_good() || !only_lost) return run;
    hold(lost);
    Run next = make();
    if (next.is_interrupted()) {
      run.result.reason = StopReason::interrupted;
      return run;
    }
    judge(next);
    next.result.rescue = Rescue::tips;
    mend(next);
    return next.is_better_than(run) ? std::move(next) : std::move(run);
  }

  /// Moves vertices to the input while that leaves fewer flaws, or fewer chords; an interrupted run only as
  /// long as it has flaws, and not for long.
  void mend(Run& run) const {
    const int max_rounds = run.is_interrupted() ? 2 : 6;
    const auto must_go_on = [&] { return run.flaws() + (run.is_interrupted() ? 0 : run.chords()) > 0; };
    if (!run.result.measures) return;  // not finite
    run.unmended_angle = run.angle;
    for (int round = 0; round < max_rounds && must_go_on() && move_to_input(run); ++round) continue;
  }

  /// Moves vertices that are too far to the closest points of the input, the corners of faces that are turned
  /// over or intersect to the points closest to the middle of their neighbours, and the vertices closest to
  /// lost ones of the input towards these, as near as they must be, but none that is fixed, at a junction or
  /// on the boundary or, for faces, on a crease. Keeps that if it makes fewer flaws, and returns whether it
  /// did.
  bool move_to_input(Run& run) const {
    const Preservation& p = run.preservation();
    const MeasuredSurface surface = surface_of(run);
    Mat3X moved = surface.points;
    std::vector<char> is_held(moved.cols(), 0);
    for (int v : find_junctions(surface.adjacency, surface.joined).vertices) is_held[v] = 1;
    constexpr unsigned char immovable = limited_by_boundary | limited_at_corner | limited_by_request;
    const auto may_move = [&](int v) { return !is_held[v] && (limits_of(run, surface, v) & immovable) == 0; };
    std::vector<FarVertex> lost = p.lost_vertices;
    std::ranges::stable_sort(lost, std::greater(), &FarVertex::distance);
    for (const FarVertex& tip : lost) {
      const Vec3 x = input_.points.col(tip.vertex);
      const int face = surface.tree.closest(x).face;
      if (face < 0) continue;
      const Triangle& t = surface.adjacency.faces[face];
      const int v = *std::ranges::min_element(
          t, {}, [&](int corner) { return (surface.points.col(corner) - x).squaredNorm(); });
      const Vec3 way = x - moved.col(v);
      constexpr double well_within = .95;
      const double share = 1 - well_within * tip.limit / way.norm();
      if (!(share > 0) || !may_move(v)) continue;
      is_held[v] = 1;
      moved.col(v) += share * way;
    }
    const auto move = [&](int v, const Vec3& x) {
      const ClosestPoint closest = input_.tree.closest(x);
      if (closest.face >= 0 && may_move(v)) moved.col(v) = closest.point;
    };
    for (const FarVertex& far : p.far_vertices) move(far.vertex, surface.points.col(far.vertex));
    for (int v : corners_of_wrong_faces(run, surface)) {
      Vec3 middle = Vec3::Zero();
      for (int n : surface.adjacency.vertex_neighbours[v]) middle += surface.points.col(n);
      move(v, middle / std::ssize(surface.adjacency.vertex_neighbours[v]));
    }
    take_back_needles(surface, moved);
    if (moved == surface.points) return false;
    Run before = run;
    for (int v = 0; v < moved.cols(); ++v)
      if (moved.col(v) != surface.points.col(v)) place(v, moved.col(v), run);
    judge(run);
    const bool only_chords = before.flaws() == 0;
    if (only_chords ? run.flaws() == 0 && run.chords() < before.chords() && run.angle >= before.angle
                    : run.flaws() < before.flaws())
      return true;
    run = std::move(before);
    return false;
  }

  /// Takes back what was moved at faces that would lose nearly all of their angle, as where two corners go to
  /// the same place, until there are none.
  static void take_back_needles(const MeasuredSurface& surface, Mat3X& moved) {
    constexpr double kept_share = .05;
    for (bool changed = true; changed;) {
      changed = false;
      for (const Triangle& t : surface.adjacency.faces) {
        const auto has_moved = [&](int v) { return moved.col(v) != surface.points.col(v); };
        if (std::ranges::none_of(t, has_moved) ||
            min_angle(moved, {t}) >= kept_share * min_angle(surface.points, {t}))
          continue;
        for (int v : t) moved.col(v) = surface.points.col(v);
        changed = true;
      }
    }
  }

  /// What limits a vertex of the run's surface: bits of VertexLimit.
  static unsigned char limits_of(const Run& run, const MeasuredSurface& surface, int vertex) {
    return run.result.vertex_limits[surface.ids.vertex(vertex)];
  }

  /// Which faces of the result intersect where those of the input do not, or are among those with these ids.
  std::vector<char> wrong_faces(const Run& run, const MeasuredSurface& surface,
                                const std::vector<int>& turned) const {
    std::vector<char> is_wrong(surface.adjacency.faces.size(), 0);
    if (!turned.empty())
      for (size_t f = 0; f < is_wrong.size(); ++f)
        is_wrong[f] = std::ranges::binary_search(turned, surface.ids.face(static_cast<int>(f)));
    if (run.preservation().new_crossings > 0)
      for (const auto& pair : new_crossings(input_, surface))
        for (int f : pair) is_wrong[f] = 1;
    return is_wrong;
  }

  /// The vertices, none on a crease, of faces of the result that are turned over, chords or intersecting.
  std::vector<int> corners_of_wrong_faces(const Run& run, const MeasuredSurface& surface) const {
    const Deviation& deviation = run.result.measures->deviation;
    const std::vector<char> is_wrong =
        wrong_faces(run, surface, run.chords() > 0 ? deviation.opposing_faces : deviation.flipped_faces);
    std::vector<char> is_corner(surface.adjacency.vertex_count, 0);
    for (size_t f = 0; f < is_wrong.size(); ++f)
      if (is_wrong[f])
        for (int v : surface.adjacency.faces[f]) is_corner[v] = 1;
    std::vector<int> corners;
    for (size_t v = 0; v < is_corner.size(); ++v)
      if (is_corner[v] && (limits_of(run, surface, static_cast<int>(v)) & limited_by_crease) == 0)
        corners.push_back(static_cast<int>(v));
    return corners;
  }

  /// Moves a vertex, by its index in memory order, and finds it on the input again.
  void place(int vertex, const Vec3& point, Run& run) const {
    const int id = run.result.memory_order.order.old_vertex[vertex];
    vertex_points(run.mesh).col(id) = point;
    if (run.result.map.empty()) return;
    const ClosestPoint closest = input_.tree.closest(point);
    if (closest.face < 0) return;
    const Triangle& t = input_.adjacency.faces[closest.face];
    run.result.map[id].position = {memory_order_.order.old_face[closest.face],
                                   barycentric(closest.point, input_.points.col(t[0]),
                                               input_.points.col(t[1]), input_.points.col(t[2]))};
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
    for (int v : held) options_.constraints.fixed_vertices.push_back(memory_order_.order.old_vertex[v]);
  }

  /// Makes an attempt on the faces of the input, and keeps it if it is better.
  void project_to_faces(Run& best) {
    if (options_.filter.kind == FilterKind::closest) return;
    options_.filter.kind = FilterKind::closest;
    Run next = attempt();
    if (next.is_interrupted()) {
      best.result.reason = StopReason::interrupted;
      return;
    }
    next.result.rescue = Rescue::closest;
    if (next.is_better_than(best)) best = std::move(next);
  }

  /// May these vertices of the input have moved? In mode `adapt` others may stand in their places.
  bool may_have_moved(const std::vector<int>& ids, const Run& run) const {
    const auto now = vertex_points(run.mesh), before = vertex_points(mesh_);
    return options_.connectivity == ConnectivityMode::adapt ||
           std::ranges::any_of(ids, [&](int id) { return now.col(id) != before.col(id); });
  }

  /// If vertices of junctions may have slid, makes attempts in which they stand still, and keeps the first
  /// that is better.
  void hold_junctions(FilterKind filter, Run& best) {
    const Junctions junctions = find_junctions(input_.adjacency, input_.joined);
    std::vector<int> ids;
    for (int v : junctions.vertices) ids.push_back(memory_order_.order.old_vertex[v]);
    if (junctions.edges.empty() || !may_have_moved(ids, best)) return;
    std::vector<int>& fixed = options_.constraints.fixed_vertices;
    fixed.insert(fixed.end(), ids.begin(), ids.end());
    options_.filter.kind = filter;
    Run next = attempt();
    if (!next.is_interrupted() && !next.is_good()) project_to_faces(next);
    if (next.is_interrupted()) {
      best.result.reason = StopReason::interrupted;
      return;
    }
    if (next.result.rescue == Rescue::none) next.result.rescue = Rescue::junctions;
    if (next.is_better_than(best)) best = std::move(next);
  }

  /// Halves the target lengths about what is wrong, as where edges are too long for a thin part, and makes
  /// attempts with these until nothing is; then about faces with small angles, which parts as narrow have
  /// left, while that halves their number. The result is kept if nothing is wrong with it. Ends without that
  /// where it makes matters much worse, as at folds of the input, or would take too many faces.
  void shorten_lengths(FilterKind filter, Run& best) {
    const double faces = best.result.adaptation.target_faces;
    const double max_faces = std::max(std::min(5e4, 25 * faces), 1.5 * faces);
    const int max_rounds = std::clamp(static_cast<int>(2e5 / faces), 3, 10);
    constexpr double slope = .3;
    constexpr std::size_t much_worse = 4, few = 10;
    RemeshOptions start = options_;  // with the tips and junctions that are held
    start.filter.kind = filter;
    const Adjacency& c = input_.adjacency;
    const std::vector<double> asked = target_lengths();
    const auto covering = [&](const std::vector<double>& lengths) {
      return covering_length(input_.points, c, spread_target_lengths(c, lengths));
    };
    const auto small_angles = [](const Run& run) { return run.result.measures->quality.faces_below_20; };
    std::vector<double> lengths = asked, longest(asked.size(), std::numeric_limits<double>::infinity());
    Run last = best;
    for (int round = 0; round < max_rounds && !(last.keeps_promises() && small_angles(last) == 0); ++round) {
      for (int v : input_vertices_at_flaws(last)) longest[v] = lengths[v] / 2;
      limit_gradation(input_.points, c, slope, longest);
      const std::vector<double> before = lengths;
      for (std::size_t v = 0; v < lengths.size(); ++v) lengths[v] = std::min(asked[v], longest[v]);
      if (lengths == before || faces * std::pow(covering(asked) / covering(lengths), 2) > max_faces) return;
      shortened_ = memory_order_.order.scatter(lengths);
      options_ = start;
      const bool projects = last.result.rescue == Rescue::closest;
      if (projects) options_.filter.kind = FilterKind::closest;
      Run next = attempt();
      if (projects) next.result.rescue = Rescue::closest;
      if (!projects && !next.is_interrupted() && !next.keeps_promises()) project_to_faces(next);
      if (next.is_interrupted()) {
        best.result.reason = StopReason::interrupted;
        return;
      }
      if (next.keeps_promises()
              ? last.keeps_promises() && 2 * small_angles(next) > small_angles(last)
              : last.keeps_promises() || next.flaws() > much_worse * std::max(few, last.flaws()))
        return;
      for (std::size_t v = 0; v < lengths.size(); ++v) next.result.shortened += 2 * lengths[v] <= asked[v];
      if (next.keeps_promises()) best = next;
      last = std::move(next);
    }
  }

  /// Which vertices of the result, in memory order, are at faces that do not keep the input or at folds, or
  /// too far from it; if it keeps the input, which are at angles below 20 degrees.
  std::vector<char> at_flaws(const Run& run, const MeasuredSurface& now) const {
    const Adjacency& c = now.adjacency;
    const Preservation& p = run.preservation();
    std::vector<char> is_wrong(c.vertex_count, 0);
    const auto add = [&](const auto& vertices) {
      for (int v : vertices) is_wrong[v] = 1;
    };
    const std::vector<char> wrong = wrong_faces(run, now, run.result.measures->deviation.flipped_faces);
    for (size_t f = 0; f < wrong.size(); ++f)
      if (wrong[f]) add(c.faces[f]);
    if (p.new_folds > 0) {
      std::vector<Edge> creases = run.result.memory_order.order.new_edges(run.result.crease_edges);
      for (Edge& e : creases) std::ranges::sort(e);
      std::ranges::sort(creases);
      for (int e : sharp_edges(now.points, c, 90)) {
        Edge ends = c.edges[e];
        std::ranges::sort(ends);
        if (!std::ranges::binary_search(creases, ends)) add(ends);
      }
    }
    for (const FarVertex& far : p.far_vertices) is_wrong[far.vertex] = 1;
    constexpr double small_angle = 20;
    if (run.keeps_promises())
      for (const Triangle& t : c.faces)
        if (min_angle(now.points, {t}) < small_angle) add(t);
    return is_wrong;
  }

  /// The vertices of the input, in memory order, whose surface a result does not keep: those it lost, and the
  /// corners of the faces closest to its vertices at_flaws(), on the same side of the surface.
  std::vector<int> input_vertices_at_flaws(const Run& run) const {
    const MeasuredSurface now = surface_of(run);
    const Preservation& p = run.preservation();
    const Adjacency& c = input_.adjacency;
    std::vector<char> is_near(c.vertex_count, 0);
    for (const FarVertex& lost : p.lost_vertices) is_near[lost.vertex] = 1;
    const auto add_closest = [&](const Vec3& x, const auto& is_meant) {
      const int face = input_.tree.closest(x, is_meant).face;
      if (face < 0) return;
      for (int v : c.faces[face]) is_near[v] = 1;
    };
    const std::vector<char> is_wrong = at_flaws(run, now);
    const Mat3X normals = vertex_normals(now.points, now.adjacency),
                input_normals = face_normals(input_.points, c);
    for (size_t v = 0; v < is_wrong.size(); ++v)
      if (is_wrong[v])
        add_closest(now.points.col(v), [&](int f) { return input_normals.col(f).dot(normals.col(v)) > 0; });
    if (!p.creases_kept) add_closest(p.place, [](int) { return true; });
    std::vector<int> near;
    for (int v = 0; v < c.vertex_count; ++v)
      if (is_near[v]) near.push_back(v);
    return near;
  }

  /// Puts vertices back to where they were, ring by ring around what is wrong, and all if that is not enough
  /// or makes worse faces than there were; a result with other faces is replaced by one with those of the
  /// input first.
  void put_back(Run& best) {
    if (options_.connectivity == ConnectivityMode::adapt) return;
    if (options_.connectivity == ConnectivityMode::flip) {
      options_.connectivity = ConnectivityMode::fixed;
      Run next = make();  // ends at once if the work is interrupted
      const bool interrupted = best.is_interrupted() || next.is_interrupted();
      judge(next);
      if (!next.result.measures) return;  // not finite
      best = std::move(next);
      if (interrupted) best.result.reason = StopReason::interrupted;
    }
    best.result.rescue = Rescue::put_back;
    for (int rings : {1, 2, 4, 8, 16}) {
      if (best.keeps_promises()) break;
      const std::vector<int> wrong = wrong_vertices(best);
      if (wrong.empty()) break;
      move_back(best, wrong, rings);
    }
    if (best.keeps_promises() && best.result.measures->quality.shape.mean >= input_quality_.shape.mean)
      return;
    std::vector<int> all(input_.adjacency.vertex_count);
    std::iota(all.begin(), all.end(), 0);
    move_back(best, all, 1);
    if (is_mask_) best.result.creases.dropped = 0;
  }

  /// The vertices, in memory order, of faces that are turned over, intersect or fold as those of the input do
  /// not, or have smaller angles, and those that are too far. Pre-condition: the faces are those of the
  /// input.
  std::vector<int> wrong_vertices(const Run& run) const {
    const MeasuredSurface now = surface_of(run);
    const Adjacency& c = input_.adjacency;
    std::vector<int> wrong;
    const auto add_face = [&](int f) {
      const Triangle& t = c.faces[f];
      wrong.insert(wrong.end(), t.begin(), t.end());
    };
    const std::vector<char> is_wrong = wrong_faces(run, now, run.result.measures->deviation.flipped_faces);
    for (size_t f = 0; f < is_wrong.size(); ++f)
      if (is_wrong[f]) add_face(static_cast<int>(f));
    for (size_t e = 0; e < c.edges.size(); ++e) {
      const int left = c.edge_faces[e][0], right = c.edge_faces[e][1];
      if (right < 0) continue;
      const auto fold = [&](const Mat3X& points) {
        return cosine_between(points, c.faces[left], c.faces[right]);
      };
      if (fold(now.points) < 0 && fold(now.points) < fold(input_.points)) {
        add_face(left);
        add_face(right);
      }
    }
    if (run.lost_angle || run.preservation().new_degenerate_faces > 0) {
      constexpr double no_angle = 1e-6;
      for (size_t f = 0; f < c.faces.size(); ++f)
        if (min_angle(now.points, {c.faces[f]}) < std::max(least_angle_, no_angle))
          add_face(static_cast<int>(f));
    }
    for (const FarVertex& far : run.preservation().far_vertices) wrong.push_back(far.vertex);
    for (const FarVertex& lost : run.preservation().lost_vertices) wrong.push_back(lost.vertex);
    std::ranges::sort(wrong);
    wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
    return wrong;
  }

  /// The vertices with all copies of those at junctions.
  std::vector<int> with_copies(const std::vector<int>& vertices) const {
    if (input_.joined.empty()) return vertices;
    std::vector<char> is_meant(input_.joined.size(), 0);
    for (int v : vertices) is_meant[input_.joined[v]] = 1;
    std::vector<int> all;
    for (std::size_t v = 0; v < input_.joined.size(); ++v)
      if (is_meant[input_.joined[v]]) all.push_back(static_cast<int>(v));
    return all;
  }

  /// Moves the vertices to their places in the input, and those within `rings` rings around them the less,
  /// the farther away they are; not those at junctions, which might leave their curves.
  void move_back(Run& run, const std::vector<int>& vertices, int rings) const {
    const auto points = vertex_points(run.mesh);
    const auto input = vertex_points(mesh_);
    const Adjacency& c = input_.adjacency;
    std::vector<int> ring(c.vertex_count, rings), front = with_copies(vertices);
    std::vector<char> at_junction(c.vertex_count, 0);
    for (int v : find_junctions(c, input_.joined).vertices) at_junction[v] = 1;
    for (int v : front) ring[v] = 0;
    for (size_t i = 0; i < front.size(); ++i)
      for (int n : c.vertex_neighbours[front[i]]) {
        const int next = ring[front[i]] + 1;
        if (next >= ring[n]) continue;
        ring[n] = next;
        front.push_back(n);
      }
    for (int v : front) {
      const int id = memory_order_.order.old_vertex[v];
      const double share = static_cast<double>(ring[v]) / rings;
      if (share > 0 && at_junction[v]) continue;
      if (share == 0) run.result.vertex_limits[id] |= VertexLimit::put_back;
      place(v, input.col(id) + share * (points.col(id) - input.col(id)), run);
    }
    judge(run);
  }

  std::vector<double> target_lengths() const {
    return memory_order_.order.gather(vertex_values(mesh_, target_length_property));
  }

  /// Is the input made of a binary mask? Without creases no length resolves its steps.
  bool is_marched_mask_at_lengths() const {
    std::vector<double> lengths = target_lengths();
    if (options_.constraints.features.angle >= 180)
      std::ranges::fill(lengths, std::numeric_limits<double>::infinity());
    return is_marched_mask(input_.points, input_.adjacency, lengths);
  }

  /// Lets attempts start from the input with its steps smoothed and no creases; boundaries, seams, junctions
  /// and fixed vertices stay.
  void smooth_steps() {
    const Adjacency& c = input_.adjacency;
    std::vector<char> is_held(c.vertex_count, 0);
    const auto hold_edge = [&](const Edge& e) {
      for (int v : e) is_held[v] = 1;
    };
    for (std::size_t e = 0; e < c.edges.size(); ++e)
      if (c.is_boundary_edge(static_cast<int>(e))) hold_edge(c.edges[e]);
    std::ranges::for_each(memory_order_.order.new_edges(options_.constraints.seams), hold_edge);
    for (int v : memory_order_.order.new_vertices(options_.constraints.fixed_vertices)) is_held[v] = 1;
    for (int v : find_junctions(c, input_.joined).vertices) is_held[v] = 1;
    smoothed_ = memory_order_.order.scatter(without_steps(input_.points, c, is_held));
    double& angle = options_.constraints.features.angle;
    if (angle < 180) steps_ = static_cast<int>(sharp_edges(input_.points, c, angle).size());
    angle = 180;
  }

  Run make() const {
    Run a;
    a.mesh = mesh_;
    if (!shortened_.empty()) set_vertex_values(a.mesh, target_length_property, shortened_);
    if (is_mask_) vertex_points(a.mesh) = smoothed_;
    a.result = remesh(a.mesh, memory_order_, options_, observer_, stopwatch_);
    if (is_mask_) {
      a.result.steps_smoothed = smoothed_ != vertex_points(mesh_);
      a.result.creases.sharp = a.result.creases.dropped = steps_;
      a.result.input_points = vertex_points(mesh_);
    }
    return a;
  }

  MeasuredSurface surface_of(const Run& a) const {
    const MemoryOrder& memory_order = a.result.memory_order;
    const bool same_faces = memory_order.adjacency->faces.size() == input_.adjacency.faces.size() &&
                            options_.connectivity == ConnectivityMode::fixed;
    return {memory_order.order.gather(vertex_points(a.mesh)), *memory_order.adjacency,
            memory_order.order.old_ids(), same_faces ? input_.tree.order() : std::vector<int>(),
            joined_vertices(a.mesh, memory_order.order)};
  }

  void judge(Run& a) const {
    a.result.measures.reset();
    if (!vertex_points(a.mesh).allFinite()) return;
    const Permutation& order = a.result.memory_order.order;
    const MeasuredSurface surface = timed(stopwatch_, "tree", [&] { return surface_of(a); });
    ResultMeasures m;
    m.quality = timed(stopwatch_, "after", [&] { return measure(surface, a.mesh, order, stopwatch_); });
    const std::vector<Edge> before = memory_order_.order.new_edges(a.result.input_creases),
                            after = order.new_edges(a.result.crease_edges);
    m.input_quality = input_quality_;
    apply_creases(m.input_quality, input_, before);
    apply_creases(m.quality, surface, after);
    m.deviation =
        timed(stopwatch_, "deviation", [&] { return measure_deviation(input_, surface, stopwatch_); });
    m.preservation = timed(stopwatch_, "preservation", [&] {
      return measure_preservation({input_, m.input_quality, before}, {surface, m.quality, after}, m.deviation,
                                  preservation_);
    });
    m.judged_by = preservation_;
    a.angle = m.quality.worst_faces.front().min_angle;
    constexpr double small_angle = 25;
    a.lost_angle =
        (options_.connectivity == ConnectivityMode::fixed && a.angle < least_angle_) ||
        (options_.connectivity == ConnectivityMode::flip && a.angle < std::min(least_angle_, small_angle));
    a.result.measures = std::make_shared<ResultMeasures>(std::move(m));
  }

  const TriMesh& mesh_;
  bool is_mask_ = false;
  Mat3X smoothed_;                 // of a mask: the points that attempts start from, by vertex id
  int steps_ = 0;                  // sharp edges of a mask
  std::vector<double> shortened_;  // target lengths by vertex id, if they are not those of the mesh
  const MemoryOrder& memory_order_;
  RemeshOptions options_;
  const Observer& observer_;
  Stopwatch* stopwatch_;
  const MeasuredSurface input_;
  PreservationOptions preservation_;
  const Quality input_quality_;
  double least_angle_ = 0;  // that faces of the input must keep, degrees
};

}  // namespace

RemeshResult preserving_remesh(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                               const PreservationOptions& preservation, const KnownInput& known,
                               const Observer& observer, Stopwatch* stopwatch) {
  const auto best_run = [&](bool smooths_steps) {
    return PreservingRemesh(mesh, memory_order, options, preservation, known, observer, stopwatch,
                            smooths_steps)
        .best();
  };
  Run best = best_run(true);
  if (best.result.steps_smoothed && best.result.measures && !best.is_interrupted() && !best.keeps_promises())
    best = best_run(false);
  mesh = std::move(best.mesh);
  if (vertex_points(mesh).allFinite())  // vertices may have been put back since
    set_residual_forces(mesh, best.result.memory_order, options.altitude);
  return std::move(best.result);
}

}  // namespace hooke
