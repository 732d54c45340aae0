#include "hooke/constraints/facet_creases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/smooth_patches.h"

namespace hooke {
namespace {

constexpr double noise_width =
    .1;  // minimum width, in target lengths, of facets beside a sharp edge where facets are meant
constexpr double flat_angle = .2;       // degrees; an edge between resolved flat regions is a crease above it
constexpr double resolved_strip = 1.9;  // minimum width of such regions, where one is a strip of a round body
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
/// Minimum share of faces in flat regions or with a resolved sharp edge, beyond which facets are meant.
constexpr double flat_share = .6;
constexpr double flatness =
    1e-6;  // maximum distance of a flat region from its plane, in diagonals of the mesh

/// Of these vertices, which lie in a plane with this unit normal, those at the corners of their convex hull,
/// the outermost ones twice
/// (the monotone chains of Andrew 1979).
std::vector<int> corners_of_hull(const Mat3X& points, const std::vector<int>& vertices, const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u), origin = points.col(vertices[0]);
  std::vector<std::array<double, 3>> in_plane;
  for (int i : vertices) {
    const Vec3 x = points.col(i) - origin;
    in_plane.push_back({u.dot(x), v.dot(x), static_cast<double>(i)});
  }
  std::ranges::sort(in_plane);
  std::vector<std::array<double, 3>> chain;
  const auto turns_left = [&](const auto& x) {
    const auto &a = chain[chain.size() - 2], &b = chain.back();
    return (b[0] - a[0]) * (x[1] - b[1]) > (b[1] - a[1]) * (x[0] - b[0]);
  };
  std::vector<int> corners;
  for (int half = 0; half < 2; ++half) {
    chain.clear();
    for (const auto& x : in_plane) {
      while (chain.size() > 1 && !turns_left(x)) chain.pop_back();
      chain.push_back(x);
    }
    for (const auto& x : chain) corners.push_back(static_cast<int>(x[2]));
    std::ranges::reverse(in_plane);
  }
  return corners;
}

class FacetCreases {
 public:
  FacetCreases(const Mat3X& points, const Adjacency& c, const std::vector<double>& length,
               const std::vector<double>& angles, double sharp_angle)
      : X_(points),
        c_(c),
        length_(length),
        angle_(angles),
        sharp_angle_(sharp_angle),
        bends_on_(2 * c.edges.size(), 0) {
    find_regions();
    find_rounds();
  }

  void add_to(std::vector<char>& kept) const {
    for (size_t e = 0; e < kept.size(); ++e) {
      const int edge = static_cast<int>(e);
      if (kept[e] || c_.is_boundary_edge(edge)) continue;
      if (angle_[e] > sharp_angle_)
        kept[e] = is_resolved(edge) || divides_flat_regions(edge);
      else if (angle_[e] > flat_angle)
        kept[e] = divides_resolved_regions(edge);
    }
    const std::vector<char> before = kept;
    for (size_t e = 0; e < kept.size(); ++e)
      if (!before[e] && goes_with_creases(static_cast<int>(e), before)) kept[e] = 1;
  }

 private:
  /// Does the edge divide flat regions where edges at both its ends that are hardly sharper are creases? A
  /// body is round both ways or not at all.
  bool goes_with_creases(int edge, const std::vector<char>& kept) const {
    return angle_[edge] > flat_angle && narrower_width(edge) > resolved_facet && !is_in_round(edge) &&
           std::ranges::all_of(c_.edges[edge], [&](int v) {
             return std::ranges::any_of(c_.vertex_edges[v], [&](int e) {
               return kept[e] && angle_[e] < (1 + strip_angle) * angle_[edge];
             });
           });
  }

  /// Numbers the flat regions by face: faces connected over edges, with all vertices in the plane of the
  /// largest; negative for a face without such neighbours.
  void find_regions() {
    std::vector<double> areas(c_.faces.size());
    parallel_for(areas.size(), 4096, [&](size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f) areas[f] = doubled_area_vector(X_, c_.faces[f]).norm();
    });
    const auto has_area = [&](auto f) { return areas[f] > 0; };
    std::vector<int> order;
    for (size_t f = 0; f < areas.size(); ++f)
      if (std::ranges::any_of(c_.face_edges[f],
                              [&](int e) { return angle_[e] <= flat_angle && !c_.is_boundary_edge(e); }))
        order.push_back(static_cast<int>(f));
    std::ranges::stable_sort(order, std::greater(), [&](int f) { return areas[f]; });
    const double tolerance = flatness * diagonal_;
    constexpr int none = -1, alone = -2;
    regions_.assign(areas.size(), none);
    for (int seed : order) {
      if (regions_[seed] != none || !has_area(seed)) continue;
      const Vec3 normal = doubled_area_vector(X_, c_.faces[seed]).normalized();
      const Vec3 origin = X_.col(c_.faces[seed][0]);
      const auto lies_in_plane = [&](int f) {
        return std::ranges::all_of(
            c_.faces[f], [&](int v) { return std::abs(normal.dot(X_.col(v) - origin)) <= tolerance; });
      };
      const auto region = static_cast<int>(region_hulls_.size());
      std::vector<int> members = {seed}, vertices;
      regions_[seed] = region;
      for (size_t i = 0; i < members.size(); ++i)
        for (int e : c_.face_edges[members[i]])
          for (int f : c_.edge_faces[e]) {
            if (f < 0 || regions_[f] != none || angle_[e] > flat_angle || !has_area(f) || !lies_in_plane(f))
              continue;
            regions_[f] = region;
            members.push_back(f);
          }
      if (members.size() < 2) {
        regions_[seed] = alone;
        continue;
      }
      for (int f : members) vertices.insert(vertices.end(), c_.faces[f].begin(), c_.faces[f].end());
      region_hulls_.push_back(corners_of_hull(X_, vertices, normal));
      const auto is_member = [&](int f) { return regions_[f] == region; };
      std::vector<int> borders;
      for (int f : members)
        for (int e : c_.face_edges[f])
          if (!c_.is_boundary_edge(e) && !std::ranges::all_of(c_.edge_faces[e], is_member))
            borders.push_back(e);
      region_is_gentle_.push_back(
          std::ranges::none_of(borders, [&](int e) { return angle_[e] > sharp_angle_; }));
      region_borders_.push_back(std::move(borders));
    }
    region_exits_.resize(region_hulls_.size());
    size_t faces_in_regions = 0, faces_with_area = 0;
    for (size_t f = 0; f < regions_.size(); ++f) {
      if (!has_area(f)) continue;
      ++faces_with_area;
      faces_in_regions += regions_[f] < 0 ? has_resolved_edge(static_cast<int>(f)) : !is_in_smooth_patch_[f];
    }
    flat_mesh_ = static_cast<double>(faces_in_regions) >= flat_share * static_cast<double>(faces_with_area);
  }

  /// Marks the faces of those, see mesh/smooth_patches.h.
  std::vector<char> find_smooth_patches() const {
    std::vector<char> flat, sharp;
    for (double angle : angle_) {
      flat.push_back(angle <= flat_angle);
      sharp.push_back(angle > sharp_angle_);
    }
    return faces_in_smooth_patches(X_, c_, flat, sharp);
  }

  /// Has the face a sharp edge that the target length resolves?
  bool has_resolved_edge(int face) const {
    return std::ranges::any_of(c_.face_edges[face], [&](int e) {
      return angle_[e] > sharp_angle_ && length(e) > resolved_length &&
             std::ranges::all_of(c_.edge_faces[e], [&](int f) { return height(f, e) > resolved_length; });
    });
  }

  /// Maximum distance of the region's vertices from the edge, in target lengths; for a face without a region
  /// its height.
  double width(int face, int region, int edge) const {
    if (region < 0) return height(face, edge);
    const auto& [a, b] = c_.edges[edge];
    const Vec3 along = (X_.col(b) - X_.col(a)).normalized();
    double widest = 0;
    for (int v : region_hulls_[region]) widest = std::max(widest, along.cross(X_.col(v) - X_.col(a)).norm());
    return widest / (.5 * (length_[a] + length_[b]));
  }

  /// Does the edge divide two flat regions, one of which is large?
  bool divides_flat_regions(int edge) const {
    const auto& [left, right] = c_.edge_faces[edge];
    const int a = regions_[left], b = regions_[right];
    return flat_mesh_ && a >= 0 && b >= 0 && a != b &&
           std::max(width(left, a, edge), width(right, b, edge)) > 2 * resolved_length;
  }

  /// Does the edge divide two flat regions, or single faces, that the target length resolves? In a mesh with
  /// few flat regions there are none: a coarse mesh of a round body is not to be taken for a polyhedron.
  bool divides_resolved_regions(int edge) const {
    const double narrower = narrower_width(edge);
    if (narrower <= (is_in_round(edge) ? resolved_gentle_strip : resolved_facet)) return false;
    return std::ranges::all_of(c_.edge_faces[edge], [&](int f) {
      return strip_width(f, edge) > (is_gentle(regions_[f]) ? resolved_gentle_strip : resolved_strip);
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
  double narrower_width(int edge) const {
    const auto& [left, right] = c_.edge_faces[edge];
    if (!flat_mesh_ || right < 0 || (is_in_smooth_patch_[left] && is_in_smooth_patch_[right])) return 0;
    const int a = regions_[left], b = regions_[right];
    return a >= 0 && a == b ? 0 : std::min(width(left, a, edge), width(right, b, edge));
  }

  /// The width of the face or its region as a strip of a round body, in target lengths: the least distance of
  /// the ends of the edge from another one at which it bends on; for a gentle region its width, also where
  /// its edges meet, at a corner of a polyhedron. Infinite or more than is asked for if it is no strip: a
  /// round bends on at three edges in a row, where a polyhedron may have two that are alike.
  double strip_width(int face, int edge) const {
    const int region = regions_[face];
    if (is_gentle(region)) {
      const double whole = width(face, region, edge);
      if (whole > resolved_gentle_strip) return whole;
    }
    const bool is_second = bends_on(other_face(edge, face), edge);
    double least = std::numeric_limits<double>::infinity();
    for (int e : is_second ? borders(face) : exits(face)) {
      if (!bends_on_at(region, edge, e)) continue;
      if (!is_second && !bends_on(face_beyond(e, face), e)) continue;
      if (is_gentle(region)) return width(face, region, edge);
      least = std::min(least, distance_of_ends(face, region, edge, e));
    }
    return least;
  }

  /// Does the face beside the edge, or its region, bend on at any other edge as it does at this one? Each
  /// answer is found once.
  bool bends_on(int face, int edge) const {
    enum : char { unknown, no, yes };
    char& answer = bends_on_[2 * static_cast<size_t>(edge) + (face == c_.edge_faces[edge][0] ? 0 : 1)];
    if (answer == unknown)
      answer = std::ranges::any_of(borders(face), [&](int e) { return bends_on_at(regions_[face], edge, e); })
                   ? yes
                   : no;
    return answer == yes;
  }

  /// The edges around the face or its region.
  std::span<const int> borders(int face) const {
    if (regions_[face] < 0) return c_.face_edges[face];
    return region_borders_[regions_[face]];
  }

  /// The edges around the face beyond which the surface bends on; around a region as far as that can be,
  /// found once.
  std::span<const int> exits(int face) const {
    if (regions_[face] < 0) return c_.face_edges[face];
    std::optional<std::vector<int>>& found = region_exits_[regions_[face]];
    if (!found) {
      found.emplace();
      for (int e : borders(face))
        if (angle_[e] <= max_facet_angle && bends_on(face_beyond(e, face), e)) found->push_back(e);
    }
    return *found;
  }

  int other_face(int edge, int face) const {
    const auto& [left, right] = c_.edge_faces[edge];
    return face == left ? right : left;
  }

  /// The face beside the edge that is neither this one nor in its region.
  int face_beyond(int edge, int face) const {
    const auto& [left, right] = c_.edge_faces[edge];
    return left == face || (regions_[face] >= 0 && regions_[left] == regions_[face]) ? right : left;
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
      const Vec3 a = X_.col(c_.other_end(edge, v)) - X_.col(v),
                 b = X_.col(c_.other_end(other, v)) - X_.col(v);
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

  /// Height of the face over one of its edges, in target lengths.
  double height(int face, int edge) const {
    const auto& [a, b] = c_.edges[edge];
    const double target = .5 * (length_[a] + length_[b]);
    return doubled_area_vector(X_, c_.faces[face]).norm() / (X_.col(a) - X_.col(b)).norm() / target;
  }

  /// Is the sharp edge so long that the target length resolves it, and are its faces as high, or is the edge
  /// twice as long and beside a flat region, or does it divide facets that are meant? Then it is no noise.
  bool is_resolved(int edge) const {
    const auto& [left, right] = c_.edge_faces[edge];
    if (narrower_width(edge) > noise_width) return true;
    if (length(edge) <= resolved_length) return false;
    if (height(left, edge) > resolved_length && height(right, edge) > resolved_length) return true;
    return length(edge) > 2 * resolved_length && (flat_mesh_ || regions_[left] >= 0 || regions_[right] >= 0);
  }

  double length(int edge) const { return length_over_target(X_, c_, length_, edge); }

  const Mat3X& X_;
  const Adjacency& c_;
  const std::vector<double>& length_;
  const std::vector<double>& angle_;
  double sharp_angle_;
  double diagonal_ = box_of_faces(X_, c_.faces).diagonal().norm();
  const std::vector<char> is_in_smooth_patch_ = find_smooth_patches();  // by face
  std::vector<int> regions_;                      // by face: its flat region, negative without one
  std::vector<std::vector<int>> region_hulls_;    // corners of the convex hulls of the flat regions
  std::vector<std::vector<int>> region_borders_;  // the edges around them
  std::vector<char> region_is_gentle_;            // is none of these sharp?
  mutable std::vector<std::optional<std::vector<int>>> region_exits_;  // see exits()
  mutable std::vector<char> bends_on_;  // the answers of bends_on(), two per edge
  std::vector<char> is_in_round_;       // is the vertex of a round body?
  bool flat_mesh_ = false;              // are so many faces in flat regions that these are meant?
};

}  // namespace

double length_over_target(const Mat3X& points, const Adjacency& adjacency,
                          const std::vector<double>& vertex_length, int edge) {
  const auto& [a, b] = adjacency.edges[edge];
  return (points.col(a) - points.col(b)).norm() / (.5 * (vertex_length[a] + vertex_length[b]));
}

void add_facet_creases(const Mat3X& points, const Adjacency& adjacency,
                       const std::vector<double>& vertex_length, const std::vector<double>& angles,
                       double sharp_angle, std::vector<char>& kept) {
  FacetCreases(points, adjacency, vertex_length, angles, sharp_angle).add_to(kept);
}

}  // namespace hooke
