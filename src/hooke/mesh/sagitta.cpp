#include "hooke/mesh/sagitta.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/smooth_patches.h"

namespace hooke {
namespace {

constexpr std::size_t sagitta_block = 4096;

constexpr double uneven = 3;  // minimum unevenness of a facet, see face_unevenness()

/// The share of the area that lies in faces with two edges more than so many times as long as the third.
double share_of_needles(const Mat3X& points, const Adjacency& c, double ratio) {
  double all = 0, needles = 0;
  for (const Triangle& t : c.faces) {
    std::array<double, 3> lengths;
    for (size_t k = 0; k < 3; ++k) lengths[k] = (points.col(t[k]) - points.col(t[(k + 1) % 3])).norm();
    std::ranges::sort(lengths);
    const double area = doubled_area_vector(points, t).norm();
    all += area;
    if (lengths[1] > ratio * lengths[0]) needles += area;
  }
  return all > 0 ? needles / all : 0;
}

/// Do faces that lie in a plane with a neighbour have most of the area: where no edge is sharp those that are
/// much larger than most, else in a mesh of uneven faces?
template <typename IsFlat>
bool flat_faces_have_the_area(const Mat3X& points, const Adjacency& c, const IsFlat& is_flat, bool is_smooth,
                              const std::vector<double>& unevenness) {
  constexpr double min_share = .75, min_uneven_share = .4, much_larger = 8;
  if (c.faces.empty()) return false;
  std::vector<double> areas(c.faces.size());
  for (std::size_t f = 0; f < areas.size(); ++f) areas[f] = doubled_area_vector(points, c.faces[f]).norm();
  std::vector<double> sorted = areas;
  const auto middle = sorted.begin() + std::ssize(sorted) / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double least = is_smooth ? much_larger * *middle : 0;
  double area = 0, flat_area = 0, uneven_area = 0;
  for (std::size_t f = 0; f < areas.size(); ++f) {
    area += areas[f];
    if (unevenness[f] > uneven) uneven_area += areas[f];
    if (areas[f] >= least && std::ranges::any_of(c.face_edges[f], is_flat)) flat_area += areas[f];
  }
  return area > 0 && flat_area >= min_share * area && uneven_area >= min_uneven_share * area;
}

/// Marks the edges whose faces lie in a plane which is no patch of a smooth surface. `sharp`: marks by edge.
std::vector<char> edges_in_facets(const Mat3X& points, const Adjacency& c, const std::vector<EdgeArc>& arcs,
                                  const std::vector<char>& sharp) {
  constexpr double flat = 1e-6;
  std::vector<char> marks(arcs.size());
  for (std::size_t e = 0; e < marks.size(); ++e)
    marks[e] = arcs[e].chord > 0 && arcs[e].sagitta <= flat * arcs[e].chord;
  const std::vector<char> is_smooth = faces_in_smooth_patches(points, c, marks, sharp);
  for (std::size_t e = 0; e < marks.size(); ++e)
    if (is_smooth[c.edge_faces[e][0]]) marks[e] = 0;
  return marks;
}

}  // namespace

std::vector<EdgeArc> edge_arcs(const Mat3X& points, const Adjacency& c) {
  Mat3X normals(3, std::ssize(c.faces));  // of twice the area
  std::vector<double> areas(c.faces.size());
  parallel_for(areas.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 n = doubled_area_vector(points, c.faces[f]);
      normals.col(static_cast<Eigen::Index>(f)) = n;
      areas[f] = n.norm();
    }
  });
  std::vector<EdgeArc> arcs(c.edges.size());
  parallel_for(arcs.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      if (c.is_feature_edge(static_cast<int>(e))) continue;
      const auto& [a, b] = c.edges[e];
      const auto& [left, right] = c.edge_faces[e];
      const Vec3 n = normals.col(left), m = normals.col(right);
      const double length = (points.col(b) - points.col(a)).norm();
      const double areas_product = areas[left] * areas[right];
      if (!(length > 0 && areas_product > 0)) continue;
      const double sine = n.cross(m).norm(), one_plus_cosine = areas_product + n.dot(m);
      arcs[e].chord = std::min(areas[left], areas[right]) / length;
      const double denominator = one_plus_cosine + std::hypot(one_plus_cosine, sine);
      arcs[e].sagitta = .5 * arcs[e].chord * (denominator > 0 ? sine / denominator : 1);  // tan(theta / 4)
    }
  });
  return arcs;
}

std::vector<double> face_sagittas(const std::vector<EdgeArc>& arcs, const Adjacency& c) {
  std::vector<double> own(c.faces.size()), sagittas(own);
  parallel_for(own.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      for (int e : c.face_edges[f]) own[f] += arcs[e].sagitta;
  });
  parallel_for(own.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      sagittas[f] = own[f];
      for (int e : c.face_edges[f])
        if (!c.is_feature_edge(e))
          for (int other : c.edge_faces[e]) sagittas[f] = std::max(sagittas[f], own[other]);
    }
  });
  return sagittas;
}

std::vector<double> vertex_sagittas(const std::vector<double>& of_faces, const Adjacency& c) {
  std::vector<double> sagittas(c.vertex_count, 0);
  parallel_for(sagittas.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      for (int f : c.vertex_faces[static_cast<int>(v)]) sagittas[v] = std::max(sagittas[v], of_faces[f]);
  });
  return sagittas;
}

std::vector<double> face_unevenness(const Mat3X& points, const Adjacency& c) {
  std::vector<double> spacing(c.vertex_count);  // the second shortest edge
  parallel_for(spacing.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double shortest = std::numeric_limits<double>::infinity(), second = shortest;
      for (int n : c.vertex_neighbours[static_cast<int>(v)]) {
        const double squared = (points.col(n) - points.col(static_cast<Eigen::Index>(v))).squaredNorm();
        second = std::min(second, std::max(shortest, squared));
        shortest = std::min(shortest, squared);
      }
      spacing[v] = second;
    }
  });
  std::vector<double> unevenness(c.faces.size());
  parallel_for(unevenness.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Triangle& t = c.faces[f];
      double longest = 0, narrowest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < 3; ++k) {
        longest = std::max(longest, (points.col(t[k]) - points.col(t[(k + 1) % 3])).squaredNorm());
        narrowest = std::min(narrowest, spacing[t[k]]);
      }
      unevenness[f] = std::sqrt(longest / narrowest);
    }
  });
  return unevenness;
}

bool is_faceted(const Mat3X& points, const Adjacency& c) {
  constexpr double flat_share = .85, uneven_share = .5, needle_share = .25;
  constexpr double some_uneven = .3, most_needles = .75;
  constexpr std::size_t few_faces = 64;
  constexpr double sharp = .088;  // tan(40 degrees / 4) / 2
  const auto faces = static_cast<double>(c.faces.size());
  const std::vector<EdgeArc> arcs = edge_arcs(points, c);
  std::vector<char> sharp_edges;
  for (const EdgeArc& arc : arcs) sharp_edges.push_back(arc.sagitta > sharp * arc.chord);
  const std::vector<char> flat_edges = edges_in_facets(points, c, arcs, sharp_edges);
  const auto is_flat = [&](int e) { return flat_edges[e] != 0; };
  const auto is_sharp = [&](int e) { return sharp_edges[e] != 0; };
  // Two faces in a plane are a quadrilateral, which a smooth surface, such as one of revolution, has too.
  const bool is_smooth = std::ranges::none_of(
      c.face_edges, [&](const Triangle& edges) { return std::ranges::any_of(edges, is_sharp); });
  const std::ptrdiff_t least_flat = is_smooth ? 2 : 1;
  const auto is_in_facet = [&](const Triangle& edges) {
    return std::ranges::any_of(edges, [&](int e) {
      return is_flat(e) && std::ranges::any_of(c.edge_faces[e], [&](int f) {
               return std::ranges::count_if(c.face_edges[f], is_flat) >= least_flat;
             });
    });
  };
  if (static_cast<double>(std::ranges::count_if(c.face_edges, is_in_facet)) >= flat_share * faces)
    return true;
  const std::vector<double> unevenness = face_unevenness(points, c);
  if (flat_faces_have_the_area(points, c, is_flat, is_smooth, unevenness)) return true;
  if (c.faces.size() < few_faces) {
    const auto has_sharp_edge = [&](const Triangle& edges) { return std::ranges::any_of(edges, is_sharp); };
    if (2 * std::ranges::count_if(c.face_edges, has_sharp_edge) >= std::ssize(c.faces)) return true;
  }
  const auto unevens =
      static_cast<double>(std::ranges::count_if(unevenness, [](double u) { return u > uneven; }));
  if (is_smooth || unevens < some_uneven * faces) return false;
  return share_of_needles(points, c, uneven) >=
         (unevens < uneven_share * faces ? most_needles : needle_share);
}

}  // namespace hooke
