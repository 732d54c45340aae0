#include "hooke/filter/curved_facets.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "hooke/core/parallel.h"
#include "hooke/mesh/curvature.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

constexpr std::size_t facet_block = 1024;

/// Minimum cosine between a face and the normal at the hint: excludes the opposite side of a thin body.
constexpr double min_agreement = -.2;

/// Unevenness of a face above which splines are tested.
constexpr double uneven = 3;
/// Relative sagitta of an edge, over its chord, above which splines are tested: tan(15 degrees / 4) / 2.
constexpr double much_turned = .033;
/// Height of a spline over a face, in sagittas, beyond which it does not follow the mesh.
constexpr double max_height = 2;
/// The same over an uneven face, between whose vertices nothing holds the spline.
constexpr double max_height_over_long = 1;

/// Height of a spline over a flat face that is only rounding, over the length of an edge.
constexpr double exact = 1e-10;
/// Minimum number of connected faces for which that is no accident.
constexpr int min_group = 20;
/// Relative sagitta of an edge, over its chord, below which its faces are one flat facet.
constexpr double flat = 1e-6;

/// Keeps the connected groups of chosen faces that are large, or half of a component of the mesh, or contain
/// a flat facet of several faces: irregular meshes of round bodies have other such faces everywhere.
void drop_small_groups(const Adjacency& c, const std::vector<EdgeArc>& arcs, std::vector<char>& chosen) {
  const std::vector<int> components = label_components(c);
  std::vector<int> sizes(components.size(), 0);
  for (const Triangle& t : c.faces) ++sizes[components[t[0]]];
  std::vector<char> seen(chosen.size(), 0);
  for (std::size_t f = 0; f < chosen.size(); ++f) {
    if (!chosen[f] || seen[f]) continue;
    std::vector<int> group = {static_cast<int>(f)};
    seen[f] = 1;
    for (std::size_t i = 0; i < group.size(); ++i)
      for (int v : c.faces[group[i]])
        for (int g : c.vertex_faces[v])
          if (chosen[g] && !std::exchange(seen[g], 1)) group.push_back(g);
    const int size = sizes[components[c.faces[f][0]]];
    if (static_cast<int>(group.size()) >= std::min(min_group, (size + 1) / 2)) continue;
    const auto is_flat = [&](int e) {
      const auto& [left, right] = c.edge_faces[e];
      return right >= 0 && chosen[left] && chosen[right] && arcs[e].chord > 0 &&
             arcs[e].sagitta <= flat * arcs[e].chord;
    };
    if (std::ranges::none_of(group, [&](int g) { return std::ranges::any_of(c.face_edges[g], is_flat); }))
      for (int g : group) chosen[g] = 0;
  }
}

/// The faces that are long compared with the spacing of the vertices, or turn much at an edge.
std::vector<char> doubtful_faces(const std::vector<double>& unevenness, const Adjacency& c,
                                 const std::vector<EdgeArc>& arcs) {
  std::vector<char> doubtful(c.faces.size(), 0);
  for (std::size_t f = 0; f < doubtful.size(); ++f)
    doubtful[f] = unevenness[f] > uneven || std::ranges::any_of(c.face_edges[f], [&](int e) {
                    return arcs[e].sagitta > much_turned * arcs[e].chord;
                  });
  return doubtful;
}

/// How far a smooth surface may rise over each face: the sagittas, or that of any face at its corners if that
/// is more.
std::vector<double> max_rises(const std::vector<EdgeArc>& arcs, const Adjacency& c) {
  const std::vector<double> sagittas = face_sagittas(arcs, c);
  const std::vector<double> at_vertex = vertex_sagittas(sagittas, c);
  std::vector<double> rises(sagittas);
  for (std::size_t f = 0; f < rises.size(); ++f)
    for (int v : c.faces[f]) rises[f] = std::max(rises[f], at_vertex[v]);
  return rises;
}

}  // namespace

std::unique_ptr<const CurvedFacets> CurvedFacets::where_exceeded(const Mat3X& points, const Mat3X& normals,
                                                                 const Adjacency& c,
                                                                 const HeightOver& height) {
  const std::vector<EdgeArc> arcs = edge_arcs(points, c);
  const std::vector<double> unevenness = face_unevenness(points, c);
  std::vector<char> curved = doubtful_faces(unevenness, c, arcs);
  if (std::ranges::find(curved, 1) == curved.end()) return nullptr;
  const std::vector<double> rises = max_rises(arcs, c);
  std::vector<char> is_near(c.edges.size(), 0);  // to a doubtful face
  for (std::size_t f = 0; f < curved.size(); ++f)
    if (curved[f])
      for (int e : c.face_edges[f]) is_near[e] = 1;
  std::vector<double> heights(c.edges.size(), 0);  // over their midpoints
  parallel_for(heights.size(), facet_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto& [a, b] = c.edges[e];
      if (!is_near[e]) continue;
      const Vec3 middle = .5 * (points.col(a) + points.col(b));
      const double first = std::abs(height(middle, a)), second = std::abs(height(middle, b));
      heights[e] = std::isnan(first) || first >= second ? first : second;  // the larger; NaN if one is
    }
  });
  parallel_for(curved.size(), facet_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      if (!curved[f]) continue;
      const Triangle& t = c.faces[f];
      const double least = exact * (points.col(t[1]) - points.col(t[0])).norm();
      const double max_rise = (unevenness[f] > uneven ? max_height_over_long : max_height) * rises[f];
      const auto is_exceeded_by = [&](double h) { return !(std::abs(h) <= std::max(max_rise, least)); };
      const Vec3 centre = (points.col(t[0]) + points.col(t[1]) + points.col(t[2])) / 3;
      curved[f] = std::ranges::any_of(c.face_edges[f], [&](int e) { return is_exceeded_by(heights[e]); }) ||
                  is_exceeded_by(height(centre, t[0]));
    }
  });
  drop_small_groups(c, arcs, curved);
  if (std::ranges::find(curved, 1) == curved.end()) return nullptr;
  return std::unique_ptr<const CurvedFacets>(new CurvedFacets(points, normals, c, curved, arcs, rises));
}

std::unique_ptr<const CurvedFacets> CurvedFacets::all_flat(const Mat3X& points, const Mat3X& normals,
                                                           const Adjacency& c) {
  return std::unique_ptr<const CurvedFacets>(
      new CurvedFacets(points, normals, c, std::vector<char>(c.faces.size(), 1),
                       std::vector<EdgeArc>(c.edges.size()), std::vector<double>(c.faces.size())));
}

CurvedFacets::CurvedFacets(const Mat3X& points, const Mat3X& normals, const Adjacency& c,
                           const std::vector<char>& curved, const std::vector<EdgeArc>& arcs,
                           const std::vector<double>& rises)
    : points_(points),
      normals_(normals),
      adjacency_(c),
      near_(c.vertex_count, 0),
      is_tip_(near_),
      components_(label_components(c)),
      facet_of_face_(c.faces.size(), -1) {
  std::vector<char> at_facet(near_.size(), 0);
  for (std::size_t f = 0; f < curved.size(); ++f)
    if (curved[f])
      for (int v : c.faces[f]) at_facet[v] = 1;
  near_ = at_facet;
  for (int v = 0; v < c.vertex_count; ++v)
    if (at_facet[v])
      for (int n : c.vertex_neighbours[v]) near_[n] = 1;
  for (int v = 0; v < c.vertex_count; ++v) is_tip_[v] = at_facet[v] && is_tip(points, c, v);
  const Mat3X face_normal = face_normals(points, c);
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < curved.size(); ++f) {
    const Triangle& t = c.faces[f];
    if (std::ranges::none_of(t, [&](int v) { return near_[v] != 0; })) continue;
    Facet facet{static_cast<int>(f),
                components_[t[0]],
                curved[f] != 0,
                rises[f],
                face_normal.col(static_cast<Eigen::Index>(f)),
                {}};
    for (std::size_t k = 0; k < 3; ++k) facet.arcs[k] = arcs[c.face_edges[f][k]];
    facet_of_face_[f] = static_cast<int>(facets_.size());
    facets_.push_back(facet);
    triangles.push_back(t);
  }
  tree_.emplace(points, triangles);
}

/// How far the curved facet may rise at a point of it: the sum of the sagittas of its edges, each of which
/// matters as far as its chord reaches; both shrink towards a tip.
double CurvedFacets::rise_at(const Facet& facet, const Vec3& at) const {
  const Triangle& t = adjacency_.faces[facet.face];
  double rise = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [sagitta, chord] = facet.arcs[k];
    if (!(sagitta > 0)) continue;
    const Vec3 a = points_.col(t[k]), along = points_.col(t[(k + 1) % 3]) - a;
    const double length = along.norm(), distance = along.cross(at - a).norm() / length;
    double taper = 1;  // facets are the narrower, the nearer the tip
    for (int v : {t[k], t[(k + 1) % 3]})
      if (is_tip_[v]) taper = std::min(taper, (at - points_.col(v)).norm() / length);
    rise += taper * sagitta * std::max(0., 1 - distance / (taper * chord));
  }
  return rise;
}

ClosestPoint CurvedFacets::find(const Vec3& x, int hint) const {
  const int component = components_[hint];
  const Vec3 side = normals_.col(hint);
  const auto accepts = [&](int index) {
    const Facet& facet = facets_[index];
    return facet.component == component && facet.normal.dot(side) >= min_agreement;
  };
  constexpr std::size_t enough = 8;  // faces for a bound; at the centre of a cap there may be thousands
  const std::span<const int> ring = adjacency_.vertex_faces[hint];
  ClosestPoint at_hint;
  for (int f : ring.first(std::min(enough, ring.size()))) {
    const int index = facet_of_face_[f];
    if (index < 0 || !accepts(index)) continue;
    const Triangle& t = adjacency_.faces[f];
    update_closest(x, {points_.col(t[0]), points_.col(t[1]), points_.col(t[2])}, index, at_hint);
  }
  ClosestPoint closest = tree_->closest(x, accepts, at_hint);
  if (closest.face >= 0) closest.face = facets_[closest.face].face;
  return closest;
}

Projection CurvedFacets::lift(const ClosestPoint& point) const {
  const Facet& facet = facet_of(point.face);
  const Triangle& t = adjacency_.faces[point.face];
  const Vec3 weights = on_face(point, points_, adjacency_).weights;
  Vec3 offset = Vec3::Zero(), normal = Vec3::Zero();
  Eigen::Index corner = 0;
  weights.maxCoeff(&corner);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto v = t[k];
    const Vec3 n = is_tip_[v] ? facet.normal : Vec3(normals_.col(v));  // tips have none
    offset += .5 * weights[k] * n.dot(points_.col(v) - point.point) * n;
    normal += weights[k] * n;
  }
  const double height = std::abs(offset.dot(facet.normal)), rise = rise_at(facet, point.point);
  const double share = height > rise ? rise / height : 1;  // of the curved facet, the rest is flat
  const bool has_normal = !facet.normal.isZero(0);
  return {point.point + share * offset,
          Vec3(has_normal ? facet.normal + share * (normal - facet.normal) : normal).normalized(), t[corner],
          ProjectionStatus::converged, 0};
}

bool CurvedFacets::allows(const ClosestPoint& closest) const {
  return closest.face >= 0 &&
         std::sqrt(closest.squared_distance) <= max_height * facet_of(closest.face).max_rise;
}

std::size_t CurvedFacets::memory_bytes() const {
  return near_.capacity() + sizeof(int) * (components_.capacity() + facet_of_face_.capacity()) +
         sizeof(Facet) * facets_.capacity() + sizeof(AabbTree::Face) * facets_.size();
}

}  // namespace hooke
