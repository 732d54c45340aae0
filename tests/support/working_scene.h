// A mesh on a known surface with all that changes of its connectivity need, for tests.
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
  return [](const Vec3& x, int hint, double) {
    return Projection{x.normalized(), x.normalized(), hint, ProjectionStatus::converged, 1};
  };
}

inline Surface plane() {
  return [](const Vec3& x, int hint, double) {
    return Projection{Vec3(x[0], x[1], 0), Vec3::UnitZ(), hint, ProjectionStatus::converged, 1};
  };
}

/// A working mesh with what it refers to. Target lengths are the natural length unless they are changed, and
/// no vertex is a corner.
struct WorkingScene {
  Adjacency adjacency;
  VertexTable vertices;
  Constraints& constraints = vertices.constraints;
  SurfacePositions& positions = vertices.positions;
  Retraction retraction;
  WorkingMesh mesh;
  HalfedgeMesh& halfedges = mesh.halfedges;

  WorkingScene(const Triangles& t, const Surface& surface, const std::vector<Edge>& creases = {})
      : adjacency(part_at(creases, make_adjacency(static_cast<int>(t.points.cols()), t.faces))),
        retraction(surface, constrain(t), {}),
        mesh(adjacency, fill(t), retraction) {
    count_curve_edges(mesh, .1);
  }
  WorkingScene(const WorkingScene&) = delete;
  WorkingScene& operator=(const WorkingScene&) = delete;

  const Constraints& constrain(const Triangles& t) {
    return constraints = find_constraints(t.points, adjacency, {});
  }

  VertexTable& fill(const Triangles& t) {
    const std::vector<int> ids(adjacency.wedge_count());
    vertices.positions = retraction.project_all(t.points, ids, constraints.segment);
    vertices.vertex_length.assign(t.points.cols(),
                                  natural_length(total_area(t.points, t.faces), t.faces.size()));
    vertices.origins.assign(t.points.cols(), 0);
    vertices.corner_valences.assign(ids.size(), 0);
    return vertices;
  }

  static Adjacency part_at(const std::vector<Edge>& creases, Adjacency c) {
    split_wedges(c, creases);
    return c;
  }
};

/// The half-edge from a to b, -1 without.
inline int half_edge(const HalfedgeMesh& t, int a, int b) {
  for (int h : t.outgoing(a))
    if (t.to(h) == b) return h;
  return -1;
}

/// Boundary edges as sorted pairs.
inline std::vector<Edge> boundary_edges(int vertex_count, const std::vector<Triangle>& faces) {
  const Adjacency c = make_adjacency(vertex_count, faces);
  std::vector<Edge> edges;
  for (size_t e = 0; e < c.edges.size(); ++e)
    if (c.is_boundary_edge(static_cast<int>(e)))
      edges.push_back({std::min(c.edges[e][0], c.edges[e][1]), std::max(c.edges[e][0], c.edges[e][1])});
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// A fan about vertex 0 at the tip of a corner of `angle` degrees: `edge_count` edges of length 1, then a
/// second row beyond.
inline Triangles fan(double angle, int edge_count) {
  Triangles t;
  t.points.resize(3, 1 + 2 * edge_count);
  for (int i = 0; i < edge_count; ++i) {
    const double phi = angle * i / (edge_count - 1) * std::numbers::pi / 180;
    t.points.col(1 + i) = Vec3(std::cos(phi), std::sin(phi), 0);
    t.points.col(1 + edge_count + i) = 2 * Vec3(std::cos(phi), std::sin(phi), 0);
  }
  for (int i = 0; i + 1 < edge_count; ++i) {
    const int a = 1 + i, b = a + edge_count;
    t.faces.push_back({0, a, a + 1});
    t.faces.push_back({a, b, b + 1});
    t.faces.push_back({a, b + 1, a + 1});
  }
  return t;
}

}  // namespace hooke::test
