// A mesh on a known surface with everything that adaptation needs, for tests.
#pragma once

#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/working_mesh/working_mesh.h"
#include "support/flippable_scene.h"

namespace hooke::test {

struct WorkingScene : FlippableScene {
  WorkingScene(const Triangles& t, const Surface& surface, const std::vector<Edge>& creases = {})
      : FlippableScene(t, surface, creases) {
    count_curve_edges(working, .1);
  }

  CurveFinder finder{constraints.curves};
  CurveEdges curve_edges;
  std::vector<int> origins = std::vector<int>(vertex_length.size(), 0);
  WorkingMesh working{halfedges,       positions, retraction, constraints, vertex_length,
                      corner_valences, origins,   finder,     curve_edges};
};

}  // namespace hooke::test
