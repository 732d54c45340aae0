// A mesh on a surface with all that a relaxation works on, and measures of what came out of it. For tests.
#pragma once

#include <algorithm>

#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/ring_energy.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/vertex_table.h"
#include "support/solids.h"

namespace hooke::test {

inline Projection to_unit_sphere(const Vec3& x, int hint, double) {
  const Vec3 n = x.normalized();
  return {n, n, hint, ProjectionStatus::converged, 1};
}
inline Projection to_ground(const Vec3& x, int hint, double) {
  return {Vec3(x[0], x[1], 0), Vec3::UnitZ(), hint, ProjectionStatus::converged, 1};
}

struct SceneOptions {
  RingTerms terms;
  ConstraintOptions constraints;
  RetractionOptions retraction;
  ShapeLimits limits;
};

/// The target length of every vertex is the natural length of the mesh.
struct Scene {
  Adjacency adjacency;
  VertexColoring coloring;
  RingTerms terms;
  VertexTable vertices;
  std::vector<double>& length = vertices.vertex_length;
  Constraints& constraints = vertices.constraints;
  SurfacePositions& positions = vertices.positions;
  TargetLengths targets;
  Energy energy;
  Retraction retraction;
  Guards guards;

  Scene(const Triangles& t, Surface surface, const SceneOptions& o = {})
      : adjacency(connect(t)),
        coloring(color_vertices(adjacency)),
        terms(o.terms),
        vertices(columns(t, adjacency, o.constraints)),
        targets(spread_target_lengths(adjacency, length)),
        energy(adjacency, targets, o.terms),
        retraction(std::move(surface), constraints, o.retraction),
        guards(adjacency, targets, o.limits) {
    std::vector<int> hints(length.size());
    for (size_t v = 0; v < hints.size(); ++v) hints[v] = static_cast<int>(v);
    positions = retraction.project_all(t.points, std::move(hints), constraints.segment);
  }
  Scene(const Scene&) = delete;

  double L() const { return length[0]; }

  Relaxation relaxation() {
    Relaxation r(adjacency, coloring, targets, vertices, retraction, terms, guards.limits());
    r.terms = terms;
    return r;
  }

  static VertexTable columns(const Triangles& t, const Adjacency& adjacency, const ConstraintOptions& o) {
    VertexTable vertices;
    vertices.vertex_length.assign(adjacency.vertex_count,
                                  natural_length(total_area(t.points, t.faces), t.faces.size()));
    vertices.constraints = find_constraints(t.points, adjacency, o);
    return vertices;
  }

  /// Gradient of the energy in the directions that the vertices may move in.
  Mat3X tangent_gradient() {
    Mat3X gradient;
    energy(positions.points, positions.normals, &gradient);
    retraction.constrain(positions, gradient);
    return gradient;
  }
};

inline Scene sphere_scene(double jitter = .3, const SceneOptions& options = {}) {
  return Scene(sphere(2, jitter, 5), to_unit_sphere, options);
}
inline Scene ground_scene(double jitter = .3, const SceneOptions& options = {}) {
  return Scene(grid(8, flat, jitter, 3), to_ground, options);
}

/// Vectors drawn evenly from the cube [-size, size]^3.
inline Mat3X random_vectors(Eigen::Index count, double size, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(-size, size);
  Mat3X u(3, count);
  for (double& x : u.reshaped()) x = draw(random);
  return u;
}

/// Every entry is the same to the last bit.
inline bool same(const SurfacePositions& a, const SurfacePositions& b) {
  return a.points == b.points && a.normals == b.normals && a.hints == b.hints && a.segments == b.segments &&
         a.drift == b.drift;
}

/// Twice the area times the unit normal.
inline Vec3 area_vector(const Mat3X& points, const Triangle& t) {
  return (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0]));
}

/// Distance of x to the polyline, over all of its segments.
inline double distance_to(const Curve& curve, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (int s = 0; s < curve.segment_count(); ++s) {
    const Vec3 a = curve.points.col(s);
    const Vec3 ab = curve.points.col((s + 1) % static_cast<int>(curve.points.cols())) - a;
    const double t = std::clamp((x - a).dot(ab) / ab.squaredNorm(), 0., 1.);
    least = std::min(least, (x - a - t * ab).norm());
  }
  return least;
}

}  // namespace hooke::test
