#include "hooke/measure/preservation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/geometry/self_intersection.h"
#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/sagitta.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

constexpr std::size_t block = 512;

constexpr double max_sagittas = 12;
constexpr double min_limit = 1e-3;  // of the diagonal
constexpr double max_chord = .6;    // of an edge
constexpr double max_rough = .5;    // of the mean edge, over 2 sagittas
constexpr double max_crease_loss = .5;

/// The arcs of the edges, sharp ones left out.
std::vector<EdgeArc> smooth_arcs(const MeasuredSurface& surface, double feature_angle) {
  std::vector<EdgeArc> arcs = edge_arcs(surface.points, surface.adjacency);
  const double sharp = .5 * std::tan(feature_angle * std::numbers::pi / 720);
  for (EdgeArc& arc : arcs)
    if (arc.sagitta > sharp * arc.chord) arc = {};
  return arcs;
}

double longest_edge(const MeasuredSurface& surface, int face) {
  const Triangle& t = surface.adjacency.faces[face];
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, (surface.points.col(t[k]) - surface.points.col(t[(k + 1) % 3])).norm());
  return longest;
}

/// The vertices of the surface that lie beyond the limit from the other one, which limit_at(vertex, closest
/// face of the other) gives; where that face is of another shell, from their own shell too. Updates the
/// greatest excess.
template <typename LimitAt>
std::vector<FarVertex> vertices_beyond(const MeasuredSurface& surface, const MeasuredSurface& other,
                                       const VertexDistances& to_other, const LimitAt& limit_at,
                                       Preservation& p) {
  std::vector<FarVertex> beyond;
  for (int v = 0; v < surface.adjacency.vertex_count; ++v) {
    const int face = to_other.faces[v];
    if (face < 0) continue;
    const double distance = to_other.distances[v], limit = limit_at(v, face), excess = distance / limit;
    if (excess > 1 && other.shell_of_face(face) != surface.shell_of_vertex(v)) {
      const ClosestPoint own = other.tree_of(surface.shell_of_vertex(v)).closest(surface.points.col(v));
      if (own.face >= 0 && std::sqrt(own.squared_distance) <= limit_at(v, own.face)) continue;
    }
    if (excess > p.excess) {
      p.excess = excess;
      p.distance = distance;
      p.place = surface.points.col(v);
    }
    if (excess > 1) beyond.push_back({v, distance, limit});
  }
  return beyond;
}

/// The limits on the faces of a mesh whose facets are meant, those that turn by more than 20 degrees at
/// least.
std::vector<double> facet_limits(const MeasuredSurface& surface) {
  std::vector<double> limits = face_sagittas(smooth_arcs(surface, 12), surface.adjacency);
  constexpr double margin = .8;  // the distances between samples may be greater
  for (double& limit : limits) limit = margin * std::max(2 * limit, min_limit * surface.extent.diagonal);
  return limits;
}

/// Does the other surface have the face where this one does?
bool has_same_face(const MeasuredSurface& surface, const MeasuredSurface& other, std::size_t f) {
  const Triangle& t = surface.adjacency.faces[f];
  return f < other.adjacency.faces.size() && other.adjacency.faces[f] == t &&
         std::ranges::all_of(t, [&](int v) { return surface.points.col(v) == other.points.col(v); });
}

/// The corners of the faces of `from` with a sample beyond the limit from `to`, and the worst of these.
/// `limits`: per face of the reference, which is `to` or, if `is_reference`, `from`.
void add_faces_beyond(const MeasuredSurface& from, const MeasuredSurface& to,
                      const std::vector<double>& limits, bool is_reference, std::vector<FarVertex>& far,
                      Preservation& p) {
  constexpr double rounding = 1e-9;  // of the limit
  const Adjacency& c = from.adjacency;
  const auto any_face = [](int) { return true; };
  const double least_limit = std::ranges::min(limits);
  std::vector<double> excess(c.faces.size(), 0);
  std::vector<FarSample> worst(c.faces.size());
  parallel_for(c.faces.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      if (has_same_face(from, to, f)) continue;
      const auto corner = [&](std::size_t k) { return Vec3(from.points.col(c.faces[f][k % 3])); };
      int near = f < to.adjacency.faces.size() ? static_cast<int>(f) : -1;  // close to the sample before
      const auto sample = [&](const Vec3& x) {
        ClosestPoint known;
        if (near >= 0) {
          const Triangle& t = to.adjacency.faces[near];
          update_closest(x, {to.points.col(t[0]), to.points.col(t[1]), to.points.col(t[2])}, near, known);
          const double enough = std::max(excess[f], rounding) * (is_reference ? limits[f] : least_limit);
          if (known.squared_distance <= enough * enough) return;
        }
        const ClosestPoint closest = to.tree.closest(x, any_face, known);
        near = closest.face;
        const double distance = std::sqrt(closest.squared_distance),
                     limit = limits[is_reference ? f : closest.face];
        if (distance / limit <= excess[f]) return;
        excess[f] = distance / limit;
        worst[f] = {is_reference ? near : static_cast<int>(f), is_reference ? closest.point : x,
                    is_reference ? x : closest.point, limit};
      };
      sample((corner(0) + corner(1) + corner(2)) / 3);
      for (std::size_t k = 0; k < 3; ++k) {
        sample((4 * corner(k) + corner(k + 1) + corner(k + 2)) / 6);  // as the Deviation has them
        for (double t : {.25, .5, .75}) sample(corner(k) + t * (corner(k + 1) - corner(k)));
      }
    }
  });
  for (std::size_t f = 0; f < excess.size(); ++f) {
    const double distance = excess[f] * worst[f].limit;
    if (excess[f] > p.excess) {
      p.excess = excess[f];
      p.distance = distance;
      p.place = is_reference ? worst[f].on_reference : worst[f].on_result;
    }
    if (!(excess[f] > 1)) continue;
    for (int v : c.faces[f]) far.push_back({v, distance, worst[f].limit});
    p.far_samples.push_back(worst[f]);
  }
}

void measure_distances(const MeasuredSurface& reference, const MeasuredSurface& result,
                       const Deviation& deviation, const ReferenceScale& scale, const PreservationOptions& o,
                       Preservation& p) {
  const double rough = o.faceted ? 0 : max_rough * scale.mean_edge;
  const double least = min_limit * scale.diagonal;
  const std::vector<double> sagittas = vertex_sagittas(
      face_sagittas(smooth_arcs(reference, o.feature_angle), reference.adjacency), reference.adjacency);
  const auto limit_of = [&](double sagitta) {
    return std::max(least, std::min(max_sagittas * sagitta, 2 * sagitta + rough));
  };
  const auto limit_of_result = [&](int, int face) {
    if (o.max_distance) return *o.max_distance;
    double sagitta = 0;
    for (int v : reference.adjacency.faces[face]) sagitta = std::max(sagitta, sagittas[v]);
    return limit_of(sagitta);
  };
  const auto limit_of_reference = [&](int v, int face) {
    if (o.max_distance) return *o.max_distance;
    return std::max(limit_of(sagittas[v]), max_chord * longest_edge(result, face));
  };
  p.far_vertices = vertices_beyond(result, reference, deviation.vertices_to_reference, limit_of_result, p);
  p.lost_vertices =
      vertices_beyond(reference, result, deviation.vertices_from_reference, limit_of_reference, p);
  if (o.max_distance ? std::isinf(*o.max_distance) : !o.keeps_facets) return;
  const std::vector<double> limits =
      o.max_distance ? std::vector<double>(reference.adjacency.faces.size(), *o.max_distance)
                     : facet_limits(reference);
  add_faces_beyond(result, reference, limits, false, p.far_vertices, p);
  add_faces_beyond(reference, result, limits, true, p.lost_vertices, p);
  if (!o.max_distance) return;
  const double farthest = std::max(deviation.to_reference.max, deviation.from_reference.max);
  p.within_max_distance = farthest <= *o.max_distance;
  if (farthest <= p.distance) return;
  p.distance = farthest;
  p.excess = farthest / *o.max_distance;
}

std::vector<Triangle> as_segments(const std::vector<Edge>& edges) {
  std::vector<Triangle> segments;
  segments.reserve(edges.size());
  for (const auto& [a, b] : edges) segments.push_back({a, b, b});
  return segments;
}

/// The edges at which faces turn by more than the angle, in degrees.
std::vector<Edge> sharper_edges(const MeasuredSurface& surface, double angle) {
  std::vector<Edge> sharp;
  for (int e : sharp_edges(surface.points, surface.adjacency, angle))
    sharp.push_back(surface.adjacency.edges[e]);
  return sharp;
}

/// How far a smooth curve through the vertices may be from each crease edge: (l / 2) tan(phi / 4) where two
/// creases, the shorter of length l, meet at a vertex and turn by phi, at most 60 degrees.
std::vector<double> crease_sagittas(const MeasuredSurface& surface, const std::vector<Edge>& creases) {
  const Mat3X& X = surface.points;
  std::vector<std::vector<std::size_t>> at(surface.adjacency.vertex_count);
  for (std::size_t e = 0; e < creases.size(); ++e)
    for (int v : creases[e]) at[v].push_back(e);
  std::vector<double> sagittas(creases.size(), 0);
  for (std::size_t v = 0; v < at.size(); ++v) {
    if (at[v].size() != 2) continue;
    const auto direction = [&](std::size_t e) {
      const auto& [a, b] = creases[e];
      return Vec3(X.col(a == static_cast<int>(v) ? b : a) - X.col(static_cast<int>(v)));
    };
    const Vec3 in = -direction(at[v][0]), out = direction(at[v][1]);
    const double turn = std::atan2(in.cross(out).norm(), in.dot(out));
    if (turn >= std::numbers::pi / 3) continue;
    for (std::size_t e : at[v])
      sagittas[e] = std::max(sagittas[e], .5 * std::min(in.norm(), out.norm()) * std::tan(turn / 4));
  }
  return sagittas;
}

/// Of each edge the greatest distance of a sample from the closest other edge, and that edge.
struct EdgeDistances {
  std::vector<double> distance;
  std::vector<std::size_t> closest;
};

EdgeDistances edge_distances(const Mat3X& points, const std::vector<Edge>& edges, const Mat3X& other_points,
                             const std::vector<Edge>& others) {
  constexpr int samples = 4;
  const AabbTree tree(other_points, as_segments(others));
  EdgeDistances d{std::vector<double>(edges.size(), 0), std::vector<std::size_t>(edges.size(), 0)};
  parallel_for(edges.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const Vec3 a = points.col(edges[e][0]), b = points.col(edges[e][1]);
      for (int k = 0; k <= samples; ++k) {
        const ClosestPoint closest = tree.closest(a + (b - a) * k / samples);
        const double distance = std::sqrt(closest.squared_distance);
        if (distance < d.distance[e]) continue;
        d.distance[e] = distance;
        d.closest[e] = closest.face;
      }
    }
  });
  return d;
}

/// Notes how far the farthest of these edges is from the others, and where the farthest of the lost ones is.
void note_crease_loss(const Mat3X& points, const std::vector<Edge>& edges,
                      const std::vector<double>& distances, const std::vector<std::size_t>& lost,
                      Preservation& p) {
  p.crease_loss = std::max(p.crease_loss, std::ranges::max(distances));
  if (lost.empty()) return;
  const bool is_first = std::exchange(p.creases_kept, false);
  if (!is_first || p.excess > 1 || p.flipped_faces + p.new_crossings + p.new_degenerate_faces > 0) return;
  const std::size_t farthest =
      *std::ranges::max_element(lost, {}, [&](std::size_t e) { return distances[e]; });
  const auto& [a, b] = edges[farthest];
  p.place = (points.col(a) + points.col(b)) / 2;
}

/// Compares the creases that were found with those of the result.
void measure_creases(const CreasedSurface& reference, const CreasedSurface& result, double least,
                     Preservation& p) {
  if (reference.creases.empty()) return;
  const Mat3X& from = reference.surface.points;
  const Mat3X& X = result.surface.points;
  EdgeDistances d{std::vector<double>(reference.creases.size(), reference.surface.extent.diagonal), {}};
  if (!result.creases.empty()) d = edge_distances(from, reference.creases, X, result.creases);
  std::vector<std::size_t> lost;
  for (std::size_t e = 0; e < d.distance.size(); ++e) {
    double limit = 0;
    if (!result.creases.empty()) {
      const auto& [a, b] = result.creases[d.closest[e]];
      limit = std::max(least, max_crease_loss * (X.col(a) - X.col(b)).norm());
    }
    if (d.distance[e] <= limit) continue;
    lost.push_back(e);
    p.lost_creases.push_back(reference.creases[e]);
  }
  note_crease_loss(from, reference.creases, d.distance, lost, p);
}

/// Compares all sharp edges, both ways, where the facets are meant: each lies on one of the other mesh that
/// is at least half as sharp.
void measure_sharp_edges(const MeasuredSurface& reference, const MeasuredSurface& result, double angle,
                         Preservation& p) {
  constexpr double exact = 1e-6, certain = 1.1;
  const auto compare = [&](const MeasuredSurface& from, double from_angle, const MeasuredSurface& to,
                           bool is_reference, std::vector<FarVertex>& far) {
    const std::vector<Edge> edges = sharper_edges(from, from_angle), others = sharper_edges(to, .5 * angle);
    if (edges.empty()) return;
    const std::vector<double> sagittas = crease_sagittas(reference, is_reference ? edges : others);
    EdgeDistances d{std::vector<double>(edges.size(), reference.extent.diagonal),
                    std::vector<std::size_t>(edges.size(), 0)};
    if (!others.empty()) d = edge_distances(from.points, edges, to.points, others);
    std::vector<std::size_t> lost;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const double sagitta = others.empty() ? 0 : sagittas[is_reference ? e : d.closest[e]];
      const double limit = std::max(exact * reference.extent.diagonal, 2 * sagitta);
      if (d.distance[e] <= limit) continue;
      lost.push_back(e);
      for (int v : edges[e]) far.push_back({v, d.distance[e], limit});
    }
    note_crease_loss(from.points, edges, d.distance, lost, p);
  };
  compare(reference, angle, result, true, p.lost_vertices);
  compare(result, certain * angle, reference, false, p.far_vertices);
}

std::array<Vec3, 2> crossing_segment_of(const MeasuredSurface& surface, const std::array<int, 2>& pair) {
  const auto corners = [&](int f) {
    const Triangle& t = surface.adjacency.faces[f];
    return std::array<Vec3, 3>{surface.points.col(t[0]), surface.points.col(t[1]), surface.points.col(t[2])};
  };
  return crossing_segment(corners(pair[0]), corners(pair[1]));
}

/// Does another shell touch the surface at the point of it that is closest to x, no farther than `reach`
/// away? `shell`: per vertex.
bool shells_touch(const MeasuredSurface& surface, const std::vector<int>& shell, const Vec3& x,
                  double reach) {
  constexpr double touching = 1e-6;  // of the diagonal
  const auto shell_of = [&](int f) { return shell[surface.adjacency.faces[f][0]]; };
  const ClosestPoint here = surface.tree.closest(x);
  if (here.face < 0 || here.squared_distance > reach * reach) return false;
  return surface.tree.has_face_within(touching * surface.extent.diagonal, here.point,
                                      [&](int f) { return shell_of(f) != shell_of(here.face); });
}

/// Removes the pairs of faces of two shells of the result that cross where shells of the reference touch.
void drop_contacts(const MeasuredSurface& reference, const MeasuredSurface& result,
                   std::vector<std::array<int, 2>>& crossings) {
  if (crossings.empty() || !reference.joined.empty()) return;
  const std::vector<int> before = label_components(reference.adjacency),
                         after = label_components(result.adjacency);
  std::erase_if(crossings, [&](const std::array<int, 2>& pair) {
    const auto shell = [&](int f) { return after[result.adjacency.faces[f][0]]; };
    if (shell(pair[0]) == shell(pair[1])) return false;
    const auto [from, to] = crossing_segment_of(result, pair);
    const double reach = std::max(longest_edge(result, pair[0]), longest_edge(result, pair[1]));
    return shells_touch(reference, before, (from + to) / 2, reach);
  });
}

/// Removes the pairs of faces of the result that cross where faces of the reference do.
void drop_old_crossings(const MeasuredSurface& reference, const MeasuredSurface& result,
                        std::vector<std::array<int, 2>>& crossings) {
  const std::vector<std::array<int, 2>>& old = reference.self_intersections();
  if (crossings.empty() || old.empty()) return;
  Mat3X ends(3, 2 * std::ssize(old));
  std::vector<Edge> segments;
  for (const auto& pair : old) {
    const int next = 2 * static_cast<int>(segments.size());
    const auto [from, to] = crossing_segment_of(reference, pair);
    ends.col(next) = from;
    ends.col(next + 1) = to;
    segments.push_back({next, next + 1});
  }
  const AabbTree tree(ends, as_segments(segments));
  std::erase_if(crossings, [&](const std::array<int, 2>& pair) {
    const auto [from, to] = crossing_segment_of(result, pair);
    const double reach = std::max(longest_edge(result, pair[0]), longest_edge(result, pair[1]));
    return tree.has_face_within(reach, (from + to) / 2);
  });
}

}  // namespace

std::vector<std::array<int, 2>> new_crossings(const MeasuredSurface& reference,
                                              const MeasuredSurface& result) {
  std::vector<std::array<int, 2>> crossings = result.self_intersections();
  drop_old_crossings(reference, result, crossings);
  drop_contacts(reference, result, crossings);  // takes longer
  return crossings;
}

namespace {

std::vector<int> faces_without_area(const MeasuredSurface& surface) {
  const std::vector<Triangle>& faces = surface.adjacency.faces;
  std::vector<int> found;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (has_no_area(face_shape(surface.points, faces[f]).area, surface.extent.diagonal))
      found.push_back(static_cast<int>(f));
  return found;
}

}  // namespace

std::vector<int> new_degenerate_faces(const MeasuredSurface& reference, const MeasuredSurface& result) {
  std::vector<Triangle> old;
  for (int f : faces_without_area(reference)) old.push_back(reference.adjacency.faces[f]);
  const AabbTree tree(reference.points, old);
  constexpr double within = 1e-3, rounding = 1e-12;  // of its longest edge, and of the diagonal
  std::vector<int> found = faces_without_area(result);
  std::erase_if(found, [&](int f) {
    const double distance = within * longest_edge(result, f) + rounding * result.extent.diagonal;
    return std::ranges::all_of(result.adjacency.faces[f],
                               [&](int v) { return tree.has_face_within(distance, result.points.col(v)); });
  });
  return found;
}

namespace {

Vec3 centre_of(const MeasuredSurface& surface, int face) {
  const Triangle& t = surface.adjacency.faces[face];
  return (surface.points.col(t[0]) + surface.points.col(t[1]) + surface.points.col(t[2])) / 3;
}

int face_with_id(const MeasuredSurface& surface, int id) {
  int face = 0;
  while (surface.ids.face(face) != id) ++face;
  return face;
}

}  // namespace

Preservation measure_preservation(const CreasedSurface& reference, const CreasedSurface& result,
                                  const Deviation& deviation, const PreservationOptions& options) {
  Preservation p;
  p.flipped_faces = deviation.flipped_faces.size();
  const ReferenceScale scale = options.scale.value_or(
      ReferenceScale{reference.surface.extent.diagonal, result.quality.edge_length.mean});
  measure_distances(reference.surface, result.surface, deviation, scale, options, p);
  const auto excess_of = [](std::size_t after, std::size_t before) {
    return after - std::min(after, before);
  };
  p.new_folds = excess_of(result.quality.folded_edges, reference.quality.folded_edges);
  p.new_degenerate_faces = excess_of(result.quality.degenerate_faces, reference.quality.degenerate_faces);
  const auto crossings = static_cast<long long>(result.quality.self_intersections.value_or(0)),
             allowed = std::max(static_cast<long long>(reference.quality.self_intersections.value_or(0)) +
                                    options.more_crossings,
                                0LL);
  p.new_crossings = std::max(crossings - allowed, 0LL);
  std::optional<int> wrong;  // a face
  if (p.flipped_faces > 0) wrong = face_with_id(result.surface, deviation.flipped_faces.front());
  if (p.new_crossings > 0) {
    p.crossings = new_crossings(reference.surface, result.surface);
    p.new_crossings = std::min(p.new_crossings, p.crossings.size());
    if (p.new_crossings > 0 && !wrong) wrong = p.crossings.front()[0];
  }
  if (p.new_degenerate_faces > 0) {
    p.degenerate_faces = new_degenerate_faces(reference.surface, result.surface);
    p.new_degenerate_faces = std::min(p.new_degenerate_faces, p.degenerate_faces.size());
    if (p.new_degenerate_faces > 0 && !wrong) wrong = p.degenerate_faces.front();
  }
  if (wrong && p.excess <= 1) p.place = centre_of(result.surface, *wrong);
  const Topology &before = reference.quality.topology, &after = result.quality.topology;
  p.topology_kept = before.components == after.components && before.boundary_loops == after.boundary_loops &&
                    before.euler == after.euler &&
                    reference.quality.junctions.same_network(result.quality.junctions);
  if (options.keeps_facets)
    measure_sharp_edges(reference.surface, result.surface, options.feature_angle, p);
  else
    measure_creases(reference, result, min_limit * scale.diagonal, p);
  return p;
}

}  // namespace hooke
