#include "hooke/mesh/sagitta.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"

namespace hooke {
namespace {

constexpr std::size_t sagitta_block = 4096;

std::size_t index_of(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

std::vector<EdgeArc> edge_arcs(const Mat3X& points, const Adjacency& c) {
  std::vector<EdgeArc> arcs(c.edges.size());
  parallel_for(arcs.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      if (c.is_feature_edge(static_cast<int>(e))) continue;
      const auto& [a, b] = c.edges[e];
      const Vec3 n = doubled_area_vector(points, c.faces[static_cast<std::size_t>(c.edge_faces[e][0])]);
      const Vec3 m = doubled_area_vector(points, c.faces[static_cast<std::size_t>(c.edge_faces[e][1])]);
      const double length = (points.col(b) - points.col(a)).norm(), n_length = n.norm(), m_length = m.norm();
      if (!(length > 0 && n_length > 0 && m_length > 0)) continue;
      arcs[e].chord = std::min(n_length, m_length) / length;
      arcs[e].sagitta = .5 * arcs[e].chord * std::tan(std::atan2(n.cross(m).norm(), n.dot(m)) / 4);
    }
  });
  return arcs;
}

std::vector<double> face_sagittas(const std::vector<EdgeArc>& arcs, const Adjacency& c) {
  std::vector<double> own(c.faces.size());
  for (std::size_t f = 0; f < own.size(); ++f)
    for (int e : c.face_edges[f]) own[f] += arcs[index_of(e)].sagitta;
  std::vector<double> sagittas = own;
  for (std::size_t e = 0; e < arcs.size(); ++e) {
    if (c.is_feature_edge(static_cast<int>(e))) continue;
    const auto left = static_cast<std::size_t>(c.edge_faces[e][0]),
               right = static_cast<std::size_t>(c.edge_faces[e][1]);
    sagittas[left] = std::max(sagittas[left], own[right]);
    sagittas[right] = std::max(sagittas[right], own[left]);
  }
  return sagittas;
}

std::vector<double> vertex_sagittas(const std::vector<double>& of_faces, const Adjacency& c) {
  std::vector<double> sagittas(static_cast<std::size_t>(c.vertex_count), 0);
  for (std::size_t f = 0; f < of_faces.size(); ++f)
    for (int v : c.faces[f]) {
      double& sagitta = sagittas[index_of(v)];
      sagitta = std::max(sagitta, of_faces[f]);
    }
  return sagittas;
}

std::vector<double> second_shortest_edges(const std::vector<double>& lengths, const Adjacency& c) {
  std::vector<double> spacing(static_cast<std::size_t>(c.vertex_count));
  parallel_for(spacing.size(), sagitta_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double shortest = std::numeric_limits<double>::infinity(), second = shortest;
      for (int e : c.vertex_edges[static_cast<int>(v)]) {
        const double length = lengths[index_of(e)];
        second = std::min(second, std::max(shortest, length));
        shortest = std::min(shortest, length);
      }
      spacing[v] = second;
    }
  });
  return spacing;
}

bool is_faceted(const Mat3X& points, const Adjacency& c) {
  constexpr double flat = 1e-6, flat_share = .85, long_edge = 3, long_share = .5;
  const std::vector<EdgeArc> arcs = edge_arcs(points, c);
  std::vector<double> lengths;
  for (const auto& [a, b] : c.edges) lengths.push_back((points.col(a) - points.col(b)).norm());
  const std::vector<double> spacing = second_shortest_edges(lengths, c);
  std::size_t flats = 0, longs = 0;
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    double longest = 0, narrowest = std::numeric_limits<double>::infinity();
    bool is_flat = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t e = index_of(c.face_edges[f][k]);
      longest = std::max(longest, lengths[e]);
      narrowest = std::min(narrowest, spacing[index_of(c.faces[f][k])]);
      is_flat |= arcs[e].chord > 0 && arcs[e].sagitta <= flat * arcs[e].chord;
    }
    flats += is_flat;
    longs += longest > long_edge * narrowest;
  }
  const double faces = static_cast<double>(c.faces.size());
  return static_cast<double>(flats) >= flat_share * faces || static_cast<double>(longs) >= long_share * faces;
}

}  // namespace hooke
