// A mesh on a known surface with all that flips want, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/connectivity/edge_flips.h"
#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/wedges.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/working_mesh.h"
#include "support/meshes.h"

namespace hooke::test {

inline Surface unit_sphere() {
  return [](const Vec3& x, int anchor, double) {
    return Foot{x.normalized(), x.normalized(), anchor, FootStatus::converged, 1};
  };
}

inline Surface plane() {
  return [](const Vec3& x, int anchor, double) {
    return Foot{Vec3(x[0], x[1], 0), Vec3::UnitZ(), anchor, FootStatus::converged, 1};
  };
}

/// Keeps what a FlippingMesh refers to. Target lengths are the natural length unless they are changed.
struct FlippingScene {
  Connectivity connectivity;
  Constraints constraints;
  Retraction retraction;
  Placement placement;
  Triangulation triangulation;
  std::vector<double> vertex_length;
  std::vector<int> corner_valences;
  FlippingMesh mesh{triangulation, placement, retraction, constraints, vertex_length, corner_valences};

  FlippingScene(const Triangles& t, const Surface& surface, const std::vector<Edge>& creases = {})
      : connectivity(part_at(creases, make_connectivity(static_cast<int>(t.points.cols()), t.faces))),
        constraints(find_constraints(t.points, connectivity, {})),
        retraction(surface, constraints, {}),
        placement(retraction.place(t.points, std::vector<int>(static_cast<size_t>(connectivity.side_count())),
                                   constraints.segment)),
        triangulation(connectivity),
        vertex_length(static_cast<size_t>(t.points.cols()),
                      natural_length(total_area(t.points, t.faces), t.faces.size())),
        corner_valences(static_cast<size_t>(connectivity.side_count()), 0) {}
  FlippingScene(const FlippingScene&) = delete;
  FlippingScene& operator=(const FlippingScene&) = delete;

  static Connectivity part_at(const std::vector<Edge>& creases, Connectivity c) {
    part_at_creases(c, creases);
    return c;
  }
};

/// The half-edge from a to b, -1 without.
inline int half_edge(const Triangulation& t, int a, int b) {
  for (int h : t.outgoing(a))
    if (t.to(h) == b) return h;
  return -1;
}

/// Boundary edges as sorted pairs.
inline std::vector<Edge> boundary_edges(int vertex_count, const std::vector<Triangle>& faces) {
  const Connectivity c = make_connectivity(vertex_count, faces);
  std::vector<Edge> edges;
  for (size_t e = 0; e < c.edges.size(); ++e)
    if (c.is_boundary_edge(static_cast<int>(e)))
      edges.push_back({std::min(c.edges[e][0], c.edges[e][1]), std::max(c.edges[e][0], c.edges[e][1])});
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// A fan about vertex 0 at the tip of a wedge of `angle` degrees: `spokes` edges of length 1, then a second
/// row beyond.
inline Triangles wedge(double angle, int spokes) {
  Triangles t;
  t.points.resize(3, 1 + 2 * spokes);
  for (int i = 0; i < spokes; ++i) {
    const double phi = angle * i / (spokes - 1) * std::numbers::pi / 180;
    t.points.col(1 + i) = Vec3(std::cos(phi), std::sin(phi), 0);
    t.points.col(1 + spokes + i) = 2 * Vec3(std::cos(phi), std::sin(phi), 0);
  }
  for (int i = 0; i + 1 < spokes; ++i) {
    const int a = 1 + i, b = a + spokes;
    t.faces.push_back({0, a, a + 1});
    t.faces.push_back({a, b, b + 1});
    t.faces.push_back({a, b + 1, a + 1});
  }
  return t;
}

}  // namespace hooke::test
