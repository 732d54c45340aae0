// Optimizes a mesh in arrays: a square with a vertex near one of its corners.
#include <hooke/remesh/array_remesh.h>

#include <iostream>

int main() {
  Eigen::MatrixX3d V(5, 3);  // a vertex a row
  V << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, .9, .2, 0;
  Eigen::MatrixX3i F(4, 3);  // a face a row: vertex ids
  F << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;

  const hooke::RemeshedArrays done = hooke::preserving_remesh(V, F);

  const hooke::ResultMeasures& measures = *done.result.measures;
  std::cout << "least angle " << measures.input_quality.min_angle.min << " -> "
            << measures.quality.min_angle.min << " degrees, vertex 4 at " << done.vertices.row(4) << "\n";
}
