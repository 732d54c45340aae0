// A mesh before and after remeshing.
#pragma once

#include "hooke/geometry/triangle.h"
#include "hooke/measure/deviation.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/remesh.h"
#include "hooke/remesh/result.h"
#include "hooke/remesh/run.h"
#include "hooke/remesh/run_options.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::test {

/// Length with which the surface takes equilateral triangles as many as there are.
inline double natural(const Triangles& t) {
  return natural_length(total_area(t.points, t.faces), t.faces.size());
}

inline TriMesh with_length(const Triangles& t, double length) {
  TriMesh mesh = to_mesh(t);
  set_vertex_values(mesh, target_length_property, length);
  return mesh;
}

struct Outcome {
  Mat3X points;
  std::vector<Triangle> faces;
  RemeshResult result;
  TriMesh mesh;
};

inline Outcome remeshed(const Triangles& t, double length, const RunOptions& options,
                        const Observer& observer = nullptr) {
  Outcome o;
  o.mesh = with_length(t, length);
  o.result = Run(o.mesh, find_memory_order(o.mesh), options, observer, nullptr).remesh(o.mesh);
  o.points = vertex_points(o.mesh);
  o.faces = triangles_of(o.mesh);
  return o;
}
inline Outcome remeshed(const Triangles& t, const RunOptions& options) {
  return remeshed(t, natural(t), options);
}
inline Outcome remeshed(const Triangles& t, double length, const RemeshOptions& options = {},
                        const Observer& observer = nullptr) {
  return remeshed(t, length, RunOptions(options), observer);
}
inline Outcome remeshed(const Triangles& t, const RemeshOptions& options = {}) {
  return remeshed(t, natural(t), options);
}

/// Faces of the result that are turned over.
inline std::vector<int> turned_faces(const Triangles& input, const TriMesh& result) {
  const Mat3X points = vertex_points(result);
  return measure_deviation(input.points, connect(input), points,
                           make_adjacency(static_cast<int>(points.cols()), triangles_of(result)))
      .flipped_faces;
}

}  // namespace hooke::test
