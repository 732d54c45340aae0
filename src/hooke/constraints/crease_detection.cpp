#include "hooke/constraints/crease_detection.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/curvature.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/staircase.h"

namespace hooke {
namespace {

// The bend ratio of an edge compares the flattest continuation of its faces with the edge itself: for each
// face the smaller angle at its two other edges over the angle at the edge; the larger of both faces.
constexpr double hysteresis = .6;  // fraction of the sharp angle above which an edge may continue a crease
constexpr double max_turn = 35;    // degrees; maximum change of direction from edge to edge of a chain
constexpr double max_bend_ratio = .25;          // of a crease edge; above it the surface is round
constexpr double max_round_bend_ratio = .6;     // the same where sharp edges stand out from all others
constexpr double max_going_on_bend_ratio = .5;  // of a sharp edge that continues a crease
constexpr double max_chain_bend_ratio = .1;     // maximum median bend ratio of a chain with a loose end
constexpr double sharp_share = .3;              // minimum fraction of sharp edges in a chain with a loose end
constexpr int min_edges = 12;            // minimum number of edges of such a chain, unless it stands out
constexpr double min_length = 8;         // and its minimum length, in target lengths
constexpr double unlikely = 1e-4;        // expected number of chains of noise with one loose end or none
constexpr double unlikely_lone = 1e-8;   // the same with two
constexpr double clear_sharpness = 1.5;  // minimum mean angle, over `angle`, of a chain that stands out
constexpr double flat_bend_ratio = .02;  // maximum median bend ratio of a chain or network between flat faces
constexpr double min_curve =
    5;  // minimum mean number of edges between corners of a network that is not clear
/// Minimum length of a sharp edge, and minimum height of its faces, in target lengths, for the edge to be
/// certainly no noise.
constexpr double resolved = 1.5;
constexpr double noise_width = .1;      // the same for the facets beside a sharp edge where facets are meant
constexpr double flat_angle = .2;       // degrees; an edge between resolved flat regions is a crease above it
constexpr double resolved_strip = 1.9;  // the same between such regions, where one is a strip of a round body
constexpr double resolved_gentle_strip = 4;  // the same if no edge of the strip is sharp
constexpr double gentle_ratio = 2. / 3;      // and how much of the angle its next edge has
constexpr double resolved_facet = .5;     // minimum width of the regions or faces beside such a weaker crease
constexpr int min_round = 12;             // vertices of a round body
constexpr double max_facet_angle = 31;    // degrees; between the facets of a round body
constexpr double max_round_angle = 25;    // degrees; at the edges of vertices of a round body
constexpr double max_needle_angle = 20;   // degrees; at the sides of a needle of a round body
constexpr double max_needle_width = .25;  // of the shorter of these sides
constexpr double strip_angle = .05;      // maximum relative difference of the angles at both edges of a strip
constexpr double strip_end_angle = .02;  // maximum difference of their ratio from 2 where a round begins
constexpr double facet_angle =
    1.4;  // minimum angle at all edges of a face that is a facet of its own, over `angle`
/// Minimum share of faces in flat regions or with a resolved sharp edge, beyond which facets are meant.
constexpr double flat_share = .6;
constexpr double flatness =
    1e-6;  // maximum distance of a flat region from its plane, in diagonals of the mesh

/// Angle in degrees between the normals of the two faces of each edge; 0 on the boundary and beside faces
/// without area.
std::vector<double> edge_angles(const Mat3X& points, const Adjacency& c) {
  const Mat3X normals = certain_face_normals(points, c);
  std::vector<double> angles(c.edges.size(), 0);
  parallel_for(angles.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      if (c.is_boundary_edge(static_cast<int>(e))) continue;
      const Vec3 a = normals.col(c.edge_faces[e][0]), b = normals.col(c.edge_faces[e][1]);
      angles[e] = std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
    }
  });
  return angles;
}

class FeatureSearch {
 public:
  FeatureSearch(const Mat3X& points, const Adjacency& c, const std::vector<double>& length,
                const CreaseOptions& o)
      : X_(points),
        c_(c),
        length_(length),
        o_(o),
        angle_(edge_angles(points, c)),
        kept_(c.edges.size(), 0),
        cos_turn_(std::cos(max_turn * std::numbers::pi / 180)),
        bends_on_(2 * c.edges.size(), 0) {}

  /// The hard edges that bend enough to be creases, and all that the search finds unless `hard_only`.
  std::vector<int> run(const std::vector<Edge>& hard_edges, bool hard_only) {
    if (!hard_only) search();
    for (const auto& [a, b] : hard_edges)
      for (const int e : c_.vertex_edges[a])
        if (c_.other_end(e, a) == b && angle_[e] > hysteresis * o_.angle) kept_[e] = 1;
    std::vector<int> edges;
    for (size_t e = 0; e < kept_.size(); ++e)
      if (kept_[e]) edges.push_back(static_cast<int>(e));
    return edges;
  }

 private:
  void search() {
    if (!o_.drops_noise) {
      for (size_t e = 0; e < kept_.size(); ++e) kept_[e] = angle_[e] > o_.angle;
    } else if (grow() > 0) {
      drop_loose_chains();
      drop_noise();
    }
    add_resolved();
  }

  /// Bend ratio of the edge, see above. Boundary edges count as flat or, with `goes_on`, where the
  /// surface evidently continues, are left out.
  double bend_ratio(int edge, bool goes_on = false) const {
    double worst = 0;
    for (int f : c_.edge_faces[edge]) {
      if (is_facet(f)) continue;
      double smallest = 180;
      for (int e : c_.face_edges[f])
        if (e != edge && !(goes_on && c_.is_boundary_edge(e))) smallest = std::min(smallest, angle_[e]);
      worst = std::max(worst, smallest);
    }
    return worst / angle_[edge];
  }

  /// Is the face a flat facet of its own: sharp on all sides, in a place where edges are sharp or flat?
  bool is_facet(int face) const {
    const auto is_sharp = [&](int e) { return c_.is_boundary_edge(e) || angle_[e] > facet_angle * o_.angle; };
    const auto is_flat = [&](int e) { return angle_[e] < flat_bend_ratio * o_.angle; };
    return std::ranges::all_of(c_.face_edges[face], is_sharp) &&
           std::ranges::all_of(c_.faces[face], [&](int v) {
             return std::ranges::all_of(c_.vertex_edges[v], [&](int e) { return is_sharp(e) || is_flat(e); });
           });
  }

  /// Height of the face over one of its edges, in target lengths.
  double height(int face, int edge) const {
    const auto& [a, b] = c_.edges[edge];
    const double target = .5 * (length_[a] + length_[b]);
    return doubled_area_vector(X_, c_.faces[face]).norm() / (X_.col(a) - X_.col(b)).norm() / target;
  }

  /// Is the sharp edge so long that the target length resolves it, and are its faces as high, or is the edge
  /// twice as long and beside a flat region, or does it divide facets that are meant? Then it is no noise.
  bool is_resolved(int edge, const std::vector<int>& regions) const {
    const auto& [left, right] = c_.edge_faces[edge];
    if (narrower_width(edge, regions) > noise_width) return true;
    if (length(edge) <= resolved) return false;
    if (height(left, edge) > resolved && height(right, edge) > resolved) return true;
    return length(edge) > 2 * resolved && (flat_mesh_ || regions[left] >= 0 || regions[right] >= 0);
  }

  /// Adds the sharp edges that are resolved or divide flat regions, and weaker edges between resolved flat
  /// regions.
  void add_resolved() {
    const std::vector<int> regions = flat_regions();
    find_rounds();
    for (size_t e = 0; e < kept_.size(); ++e) {
      const int edge = static_cast<int>(e);
      if (kept_[e] || c_.is_boundary_edge(edge)) continue;
      if (angle_[e] > o_.angle)
        kept_[e] = is_resolved(edge, regions) || divides_flat_regions(edge, regions);
      else if (angle_[e] > flat_angle)
        kept_[e] = divides_resolved_regions(edge, regions);
    }
    const std::vector<char> kept = kept_;
    for (size_t e = 0; e < kept_.size(); ++e)
      if (!kept[e] && goes_with_creases(static_cast<int>(e), kept, regions)) kept_[e] = 1;
    if (o_.drops_noise) drop_accidents();
  }

  /// Drops single edges and, where most sharp edges are noise, small networks: faces that are folded over by
  /// noise have sharp edges all around.
  void drop_accidents() {
    int sharp = 0, kept = 0;
    for (size_t e = 0; e < kept_.size(); ++e)
      if (angle_[e] > o_.angle) {
        ++sharp;
        kept += kept_[e];
      }
    const bool is_noisy = 2 * kept < sharp;
    std::vector<char> seen(kept_.size(), 0);
    for (size_t e = 0; e < kept_.size(); ++e) {
      if (!kept_[e] || seen[e]) continue;
      const std::vector<int> network = network_of(static_cast<int>(e), seen);
      const bool is_single =
          network.size() == 1 && std::ranges::all_of(c_.edges[e], [&](int v) { return is_loose(v); });
      if (is_single || (is_noisy && std::ssize(network) < min_edges))
        for (int i : network) kept_[i] = 0;
    }
  }

  /// Does the edge divide flat regions where edges at both its ends that are hardly sharper are creases? A
  /// body is round both ways or not at all.
  bool goes_with_creases(int edge, const std::vector<char>& kept, const std::vector<int>& regions) const {
    return angle_[edge] > flat_angle && narrower_width(edge, regions) > resolved_facet &&
           !is_in_round(edge) && std::ranges::all_of(c_.edges[edge], [&](int v) {
             return std::ranges::any_of(c_.vertex_edges[v], [&](int e) {
               return kept[e] && angle_[e] < (1 + strip_angle) * angle_[edge];
             });
           });
  }

  /// Numbers the flat regions by face: faces connected over edges, with all vertices in the plane of the
  /// largest; negative for a face without such neighbours.
  std::vector<int> flat_regions() {
    std::vector<double> areas(c_.faces.size());
    parallel_for(areas.size(), 4096, [&](size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f) areas[f] = doubled_area_vector(X_, c_.faces[f]).norm();
    });
    std::vector<int> order;
    for (size_t f = 0; f < areas.size(); ++f)
      if (std::ranges::any_of(c_.face_edges[f],
                              [&](int e) { return angle_[e] <= flat_angle && !c_.is_boundary_edge(e); }))
        order.push_back(static_cast<int>(f));
    std::ranges::stable_sort(order, std::greater(), [&](int f) { return areas[f]; });
    const double tolerance = flatness * diagonal_;
    constexpr int none = -1, alone = -2;
    size_t faces_in_regions = 0;
    std::vector<int> regions(areas.size(), none);
    region_vertices_.clear();
    for (int seed : order) {
      if (regions[seed] != none || !(areas[seed] > 0)) continue;
      const Vec3 normal = doubled_area_vector(X_, c_.faces[seed]).normalized();
      const Vec3 origin = X_.col(c_.faces[seed][0]);
      const auto lies_in_plane = [&](int f) {
        return std::ranges::all_of(
            c_.faces[f], [&](int v) { return std::abs(normal.dot(X_.col(v) - origin)) <= tolerance; });
      };
      const auto region = static_cast<int>(region_vertices_.size());
      std::vector<int> members = {seed}, vertices;
      regions[seed] = region;
      for (size_t i = 0; i < members.size(); ++i)
        for (int e : c_.face_edges[members[i]])
          for (int f : c_.edge_faces[e]) {
            if (f < 0 || regions[f] != none || angle_[e] > flat_angle || !lies_in_plane(f)) continue;
            regions[f] = region;
            members.push_back(f);
          }
      if (members.size() < 2) {
        regions[seed] = alone;
        continue;
      }
      for (int f : members) vertices.insert(vertices.end(), c_.faces[f].begin(), c_.faces[f].end());
      region_vertices_.push_back(std::move(vertices));
      const auto is_member = [&](int f) { return regions[f] == region; };
      std::vector<int> borders;
      for (int f : members)
        for (int e : c_.face_edges[f])
          if (!c_.is_boundary_edge(e) && !std::ranges::all_of(c_.edge_faces[e], is_member))
            borders.push_back(e);
      region_is_gentle_.push_back(std::ranges::none_of(borders, [&](int e) { return angle_[e] > o_.angle; }));
      region_borders_.push_back(std::move(borders));
      faces_in_regions += members.size();
    }
    for (size_t f = 0; f < regions.size(); ++f)
      if (regions[f] < 0) faces_in_regions += has_resolved_edge(static_cast<int>(f));
    flat_mesh_ = static_cast<double>(faces_in_regions) >= flat_share * static_cast<double>(regions.size());
    return regions;
  }

  /// Has the face a sharp edge that the target length resolves?
  bool has_resolved_edge(int face) const {
    return std::ranges::any_of(c_.face_edges[face], [&](int e) {
      return angle_[e] > o_.angle && length(e) > resolved &&
             std::ranges::all_of(c_.edge_faces[e], [&](int f) { return height(f, e) > resolved; });
    });
  }

  /// Maximum distance of the region's vertices from the edge, in target lengths; for a face without a region
  /// its height.
  double width(int face, int region, int edge) const {
    if (region < 0) return height(face, edge);
    const auto& [a, b] = c_.edges[edge];
    const Vec3 along = (X_.col(b) - X_.col(a)).normalized();
    double widest = 0;
    for (int v : region_vertices_[region])
      widest = std::max(widest, along.cross(X_.col(v) - X_.col(a)).norm());
    return widest / (.5 * (length_[a] + length_[b]));
  }

  /// Does the edge divide two flat regions, one of which is large?
  bool divides_flat_regions(int edge, const std::vector<int>& regions) const {
    const auto& [left, right] = c_.edge_faces[edge];
    const int a = regions[left], b = regions[right];
    return flat_mesh_ && a >= 0 && b >= 0 && a != b &&
           std::max(width(left, a, edge), width(right, b, edge)) > 2 * resolved;
  }

  /// Does the edge divide two flat regions, or single faces, that the target length resolves? In a mesh with
  /// few flat regions there are none: a coarse mesh of a round body is not to be taken for a polyhedron.
  bool divides_resolved_regions(int edge, const std::vector<int>& regions) const {
    const double narrower = narrower_width(edge, regions);
    if (narrower <= (is_in_round(edge) ? resolved_gentle_strip : resolved_facet)) return false;
    return std::ranges::all_of(c_.edge_faces[edge], [&](int f) {
      return strip_width(f, regions, edge) > (is_gentle(regions[f]) ? resolved_gentle_strip : resolved_strip);
    });
  }

  /// Does the edge end at a vertex of a round body?
  bool is_in_round(int edge) const {
    return std::ranges::any_of(c_.edges[edge], [&](int v) { return is_in_round_[v] != 0; });
  }

  /// Finds the vertices of round bodies: the surface turns at three edges or more there, but little at each,
  /// and in the same way - out, in, or as a saddle - at `min_round` such vertices or more that these edges
  /// connect. The folds of a polyhedron are fewer or alternate.
  void find_rounds() {
    enum : char { not_gentle, out = 1, in = 2, saddle = out | in };
    std::vector<char> way(c_.vertex_count, not_gentle);
    const auto turns = [&](int e) { return angle_[e] > flat_angle; };
    for (int v = 0; v < c_.vertex_count; ++v) {
      const auto edges = c_.vertex_edges[v];
      if (std::ranges::count_if(edges, turns) < 3 || std::ranges::any_of(edges, [&](int e) {
            return c_.is_boundary_edge(e) || angle_[e] >= max_round_angle;
          }))
        continue;
      for (int e : edges)
        if (turns(e)) way[v] |= is_convex(e) ? out : in;
    }
    is_in_round_.assign(c_.vertex_count, 0);
    std::vector<char> seen(c_.vertex_count, 0);
    for (int seed = 0; seed < c_.vertex_count; ++seed) {
      if (way[seed] == not_gentle || seen[seed]) continue;
      std::vector<int> round = {seed};
      seen[seed] = 1;
      for (size_t i = 0; i < round.size(); ++i)
        for (int e : c_.vertex_edges[round[i]]) {
          const int next = c_.other_end(e, round[i]);
          if (turns(e) && way[next] == way[seed] && !std::exchange(seen[next], 1)) round.push_back(next);
        }
      if (std::ssize(round) >= min_round)
        for (int v : round) is_in_round_[v] = 1;
    }
  }

  /// The smaller width of the two flat regions, or single faces, that the edge divides; 0 if it divides none,
  /// or few faces of the mesh are in such regions.
  double narrower_width(int edge, const std::vector<int>& regions) const {
    const auto& [left, right] = c_.edge_faces[edge];
    if (!flat_mesh_ || right < 0) return 0;
    const int a = regions[left], b = regions[right];
    return a >= 0 && a == b ? 0 : std::min(width(left, a, edge), width(right, b, edge));
  }

  /// The width of the face or its region as a strip of a round body, in target lengths: the least distance of
  /// the ends of the edge from another one at which it bends on; for a gentle region its width, also where
  /// its edges meet, at a corner of a polyhedron. Infinite if it is no strip: a round bends on at three edges
  /// in a row, where a polyhedron may have two that are alike.
  double strip_width(int face, const std::vector<int>& regions, int edge) const {
    const int region = regions[face];
    const bool is_second = bends_on(other_face(edge, face), regions, edge);
    double least = std::numeric_limits<double>::infinity();
    for (int e : borders(face, regions)) {
      if (!bends_on_at(region, edge, e)) continue;
      if (!is_second && !bends_on(face_beyond(e, face, regions), regions, e)) continue;
      if (is_gentle(region)) return width(face, region, edge);
      least = std::min(least, distance_of_ends(face, region, edge, e));
    }
    return least;
  }

  /// Does the face beside the edge, or its region, bend on at any other edge as it does at this one? Each
  /// answer is found once.
  bool bends_on(int face, const std::vector<int>& regions, int edge) const {
    enum : char { unknown, no, yes };
    char& answer = bends_on_[2 * static_cast<size_t>(edge) + (face == c_.edge_faces[edge][0] ? 0 : 1)];
    if (answer == unknown)
      answer = std::ranges::any_of(borders(face, regions),
                                   [&](int e) { return bends_on_at(regions[face], edge, e); })
                   ? yes
                   : no;
    return answer == yes;
  }

  /// The edges around the face or its region.
  std::span<const int> borders(int face, const std::vector<int>& regions) const {
    if (regions[face] < 0) return c_.face_edges[face];
    return region_borders_[regions[face]];
  }

  int other_face(int edge, int face) const {
    const auto& [left, right] = c_.edge_faces[edge];
    return face == left ? right : left;
  }

  /// The face beside the edge that is neither this one nor in its region.
  int face_beyond(int edge, int face, const std::vector<int>& regions) const {
    const auto& [left, right] = c_.edge_faces[edge];
    return left == face || (regions[face] >= 0 && regions[left] == regions[face]) ? right : left;
  }

  /// Does the region, or the face if there is none, bend on at e as it does at the edge, as far as the facets
  /// of a round body may bend: to the same side, and about as much, or twice as much where the round begins
  /// at this edge; where no edge is sharp at least 2/3 as much, as on a surface whose curvature varies; at
  /// the sides of a needle somehow, as where a cylinder ends at an oblique cut? Edges of a region must be
  /// about parallel. Edges in line or at an obtuse angle to each other do not count.
  bool bends_on_at(int region, int edge, int e) const {
    const bool gentle = is_gentle(region);
    const double ratio = angle_[e] / angle_[edge];
    const bool is_alike = gentle ? ratio > gentle_ratio
                                 : std::abs(ratio - 1) < strip_angle || std::abs(ratio - 2) < strip_end_angle;
    const bool is_needle = are_sides_of_needle(edge, e);
    if (e == edge || std::max(angle_[e], angle_[edge]) > max_facet_angle || !(is_alike || is_needle) ||
        is_convex(e) != is_convex(edge))
      return false;
    const Vec3 along = direction(edge);
    if (are_in_line(e, edge, along) || continues(e, edge)) return false;
    const double parallel = gentle ? .7 : .96;  // cosine; the meridians of a sphere meet at its poles
    return is_needle || region < 0 || std::abs(direction(e).dot(along)) > parallel;
  }

  /// Are the edges, at which the surface turns but little, sides of needles that are close to each other?
  bool are_sides_of_needle(int edge, int e) const {
    if (!divides_needles(edge) || !divides_needles(e)) return false;
    const Vec3 side = X_.col(c_.edges[edge][1]) - X_.col(c_.edges[edge][0]);
    const Vec3 other = X_.col(c_.edges[e][1]) - X_.col(c_.edges[e][0]);
    const double least = max_needle_width * std::min(side.norm(), other.norm());
    return std::ranges::all_of(c_.edges[e], [&](int v) {
      return side.cross(X_.col(v) - X_.col(c_.edges[edge][0])).norm() <= least * side.norm();
    });
  }

  /// Does the surface turn but little at the edge, and are both faces beside it narrow?
  bool divides_needles(int edge) const {
    return angle_[edge] > flat_angle && angle_[edge] < max_needle_angle &&
           std::ranges::all_of(c_.edge_faces[edge],
                               [&](int f) { return height(f, edge) <= max_needle_width * length(edge); });
  }

  /// Distance, in target lengths, of the ends of the edge from another edge of the face or its region; the
  /// height of a face alone where they are not about parallel.
  double distance_of_ends(int face, int region, int edge, int e) const {
    constexpr double parallel = .96;  // cosine
    const Vec3 other = direction(e), origin = X_.col(c_.edges[e][0]);
    if (region < 0 && std::abs(other.dot(direction(edge))) <= parallel) return height(face, edge);
    const auto& [a, b] = c_.edges[edge];
    const double least =
        std::min(other.cross(X_.col(a) - origin).norm(), other.cross(X_.col(b) - origin).norm());
    return least / (.5 * (length_[a] + length_[b]));
  }

  /// Is no edge of the flat region sharp, as of the quadrilaterals of a smooth surface?
  bool is_gentle(int region) const { return region >= 0 && region_is_gentle_[region]; }

  Vec3 direction(int edge) const {
    const auto& [a, b] = c_.edges[edge];
    return (X_.col(b) - X_.col(a)).normalized();
  }

  /// Are both edges pieces of one straight line?
  bool are_in_line(int edge, int other, const Vec3& along) const {
    return std::ranges::all_of(c_.edges[edge], [&](int v) {
      return (X_.col(v) - X_.col(c_.edges[other][0])).cross(along).norm() <= flatness * diagonal_;
    });
  }

  /// Do the edges meet at an obtuse angle, of more than 96 degrees?
  bool continues(int edge, int other) const {
    constexpr double obtuse = -.1;  // cosine
    for (int v : c_.edges[edge]) {
      if (std::ranges::find(c_.edges[other], v) == c_.edges[other].end()) continue;
      const Vec3 a = X_.col(other_end(edge, v)) - X_.col(v), b = X_.col(other_end(other, v)) - X_.col(v);
      return a.dot(b) < obtuse * a.norm() * b.norm();
    }
    return false;
  }

  bool is_convex(int edge) const {
    const auto& [left, right] = c_.edge_faces[edge];
    const Triangle& t = c_.faces[right];
    const Vec3 n = doubled_area_vector(X_, c_.faces[left]);
    return n.dot(X_.col(t[0]) + X_.col(t[1]) + X_.col(t[2]) - 3 * X_.col(c_.edges[edge][0])) < 0;
  }

  bool may_belong(int edge, double min_angle) const {
    const bool is_clear = sharp_stand_out_ && angle_[edge] > clear_sharpness * o_.angle;
    return angle_[edge] > min_angle && bend_ratio(edge) <= (is_clear ? max_round_bend_ratio : max_bend_ratio);
  }

  /// Are nearly all sharp edges far sharper than the others? Noise makes edges of all angles.
  bool sharp_edges_stand_out() const {
    constexpr double max_between = .01;
    const auto sharper = [&](double angle) {
      return static_cast<double>(std::ranges::count_if(angle_, [&](double a) { return a > angle; }));
    };
    const double clear = sharper(clear_sharpness * o_.angle);
    return sharper(o_.angle) - clear <= max_between * clear;
  }

  /// May the edge go on with a crease? If it is sharp, also where the surface beside it is rather round.
  bool may_continue(int edge) const {
    return may_belong(edge, hysteresis * o_.angle) ||
           (angle_[edge] > o_.angle && bend_ratio(edge) <= max_going_on_bend_ratio);
  }

  int other_end(int edge, int vertex) const {
    const Edge& e = c_.edges[edge];
    return e[0] == vertex ? e[1] : e[0];
  }

  double length(int edge) const {
    const auto& [a, b] = c_.edges[edge];
    return (X_.col(a) - X_.col(b)).norm() / (.5 * (length_[a] + length_[b]));
  }

  /// Whether the chain continues nearly straight at the vertex.
  bool goes_on(int edge, int next, int vertex) const {
    const Vec3 in = X_.col(vertex) - X_.col(other_end(edge, vertex));
    const Vec3 out = X_.col(other_end(next, vertex)) - X_.col(vertex);
    return in.dot(out) >= cos_turn_ * in.norm() * out.norm();
  }

  /// Marks the sharp edges and the weaker ones that continue them. Returns their number.
  size_t grow() {
    size_t count = 0;
    std::vector<int> front;
    for (size_t e = 0; e < kept_.size(); ++e)
      if (may_belong(static_cast<int>(e), o_.angle)) {
        kept_[e] = 1;
        front.push_back(static_cast<int>(e));
      }
    while (!front.empty()) {
      const int edge = front.back();
      front.pop_back();
      ++count;
      for (int v : c_.edges[edge])
        for (int next : c_.vertex_edges[v]) {
          if (kept_[next] || !may_continue(next) || !goes_on(edge, next, v)) continue;
          kept_[next] = 1;
          front.push_back(next);
        }
    }
    return count;
  }

  std::vector<int> kept_edges(int vertex) const {
    std::vector<int> edges;
    for (int e : c_.vertex_edges[vertex])
      if (kept_[e]) edges.push_back(e);
    return edges;
  }

  struct Chain {
    std::vector<int> edges;
    int first, last;  // vertices
  };

  /// The chain from a vertex to where it meets another chain, turns, or ends.
  Chain chain_from(int vertex, int edge) const {
    Chain chain{{edge}, vertex, other_end(edge, vertex)};
    for (;;) {
      const std::vector<int> here = kept_edges(chain.last);
      if (here.size() != 2) return chain;
      const int next = here[0] == edge ? here[1] : here[0];
      if (!goes_on(edge, next, chain.last)) return chain;
      chain.edges.push_back(edge = next);
      chain.last = other_end(edge, chain.last);
    }
  }

  double median_bend_ratio(const std::vector<int>& edges, bool goes_on = false) const {
    std::vector<double> ratios;
    ratios.reserve(edges.size());
    for (int e : edges) ratios.push_back(bend_ratio(e, goes_on));
    const auto middle = ratios.begin() + std::ssize(ratios) / 2;
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
  }

  bool on_boundary(int vertex) const {
    const auto edges = c_.vertex_edges[vertex];
    return std::any_of(edges.begin(), edges.end(), [&](int e) { return c_.is_boundary_edge(e); });
  }

  bool is_loose(int vertex) const { return kept_edges(vertex).size() == 1 && !on_boundary(vertex); }

  /// About how many such chains noise makes in the mesh: of the edges that it makes a tenth has a bend ratio
  /// below .04, and few have one above .4; those of faces that it folds over may have any.
  double expected_by_noise(const std::vector<int>& chain) const {
    constexpr double folded = 135;  // degrees
    auto number = static_cast<double>(c_.edges.size());
    for (int e : chain)
      if (angle_[e] < folded) number *= std::clamp(bend_ratio(e) / .4, .05, 1.);
    return number;
  }

  /// Are the edges, with this median bend ratio, very sharp or between flat faces, and hardly made by noise?
  bool stands_out(const std::vector<int>& edges, double ratio, bool is_lone = false) const {
    double sum = 0;
    for (int e : edges) sum += angle_[e];
    return (ratio <= flat_bend_ratio ||
            sum > clear_sharpness * o_.angle * static_cast<double>(edges.size())) &&
           expected_by_noise(edges) < (is_lone ? unlikely_lone : unlikely);
  }

  /// Noise makes short chains and chains that begin and end in the interior of the surface, unless they are
  /// very sharp or flat on both sides, and unlikely by chance: where round bodies meet. A chain from the
  /// boundary to another crease or to the boundary, sharp between flat faces, may be short: the corner of an
  /// open box, the fold of a strip. A single edge may not: it could be the edge of a loose triangle.
  bool is_worth_keeping(const Chain& chain) const {
    double sum = 0;
    int sharp = 0;
    for (int e : chain.edges) {
      sum += length(e);
      sharp += angle_[e] > o_.angle;
    }
    const auto edges = static_cast<int>(chain.edges.size());
    const double ratio = median_bend_ratio(chain.edges);
    if (on_boundary(chain.first) && edges > 1 && sharp == edges) {
      if (kept_edges(chain.last).size() > 1 && ratio <= flat_bend_ratio) return true;
      if (on_boundary(chain.last) && median_bend_ratio(chain.edges, true) <= flat_bend_ratio) return true;
    }
    const bool is_lone = is_loose(chain.first) && is_loose(chain.last);
    if (sharp < sharp_share * edges) return false;
    if (stands_out(chain.edges, ratio, is_lone)) return true;
    return edges >= min_edges && sum >= min_length &&
           ratio <= (is_lone ? flat_bend_ratio : max_chain_bend_ratio);
  }

  void drop_loose_chains() {
    std::vector<int> ends;
    for (int v = c_.vertex_count; v-- > 0;) ends.push_back(v);
    while (!ends.empty()) {
      const int v = ends.back();
      ends.pop_back();
      const std::vector<int> here = kept_edges(v);
      if (here.size() != 1) continue;
      const Chain chain = chain_from(v, here[0]);
      if (is_worth_keeping(chain)) continue;
      for (int e : chain.edges) kept_[e] = 0;
      ends.push_back(chain.last);
    }
  }

  /// All kept edges connected with this one.
  std::vector<int> network_of(int edge, std::vector<char>& seen) const {
    std::vector<int> network = {edge};
    seen[edge] = 1;
    for (size_t i = 0; i < network.size(); ++i)
      for (int v : c_.edges[network[i]])
        for (int e : kept_edges(v))
          if (!std::exchange(seen[e], 1)) network.push_back(e);
    return network;
  }

  /// Number of edges that end at a corner, counted at both ends.
  int curve_ends(const std::vector<int>& network) const {
    int ends = 0;
    for (int e : network)
      for (int v : c_.edges[e]) {
        const std::vector<int> here = kept_edges(v);
        ends += here.size() != 2 || !goes_on(here[0], here[1], v);
      }
    return ends;
  }

  void drop_noise() {
    std::vector<char> seen(kept_.size(), 0);
    for (size_t e = 0; e < kept_.size(); ++e) {
      if (!kept_[e] || seen[e]) continue;
      const std::vector<int> network = network_of(static_cast<int>(e), seen);
      const bool short_curves = 2 * static_cast<double>(network.size()) < min_curve * curve_ends(network);
      const double ratio = median_bend_ratio(network);
      const bool is_clear =
          ratio <= flat_bend_ratio || (ratio <= max_chain_bend_ratio && stands_out(network, ratio));
      if (short_curves && !is_clear)
        for (int i : network) kept_[i] = 0;
    }
  }

  const Mat3X& X_;
  const Adjacency& c_;
  const std::vector<double>& length_;
  const CreaseOptions& o_;
  std::vector<double> angle_;
  std::vector<char> kept_;
  double cos_turn_;
  double diagonal_ = box_diagonal(X_);
  std::vector<std::vector<int>> region_vertices_;  // of the flat regions
  std::vector<std::vector<int>> region_borders_;   // the edges around them
  std::vector<char> region_is_gentle_;             // is none of these sharp?
  mutable std::vector<char> bends_on_;             // the answers of bends_on(), two per edge
  std::vector<char> is_in_round_;                  // is the vertex of a round body?
  bool sharp_stand_out_ = sharp_edges_stand_out();
  bool flat_mesh_ = false;  // are so many faces in flat regions that these are meant?
};

}  // namespace

std::vector<int> detect_tips(const Mat3X& points, const Adjacency& c,
                             const std::vector<double>& vertex_length, const CreaseOptions& o) {
  std::vector<int> tips;
  if (o.angle >= 180) return tips;
  for (int v = 0; v < c.vertex_count; ++v) {
    const auto is_resolved = [&](int e) {
      return (points.col(c.other_end(e, v)) - points.col(v)).norm() > resolved * vertex_length[v];
    };
    if (std::ranges::all_of(c.vertex_edges[v], is_resolved) && is_tip(points, c, v)) tips.push_back(v);
  }
  return tips;
}

std::vector<int> detect_creases(const Mat3X& points, const Adjacency& adjacency,
                                const std::vector<double>& vertex_length, const CreaseOptions& options,
                                const std::vector<Edge>& hard_edges) {
  if (options.angle >= 180) return {};
  const bool is_noise = options.drops_noise && is_staircase(points, adjacency, vertex_length);
  if (is_noise && hard_edges.empty()) return {};
  return FeatureSearch(points, adjacency, vertex_length, options).run(hard_edges, is_noise);
}

}  // namespace hooke
