#include "hooke/remesh/array_remesh.h"

#include <utility>

namespace hooke {

ValidMesh mesh_from_arrays(const Eigen::MatrixX3d& vertices, const Eigen::MatrixX3i& faces) {
  std::vector<Triangle> triangles(faces.rows());
  for (Eigen::Index f = 0; f < faces.rows(); ++f) triangles[f] = {faces(f, 0), faces(f, 1), faces(f, 2)};
  return make_valid_mesh(vertices.transpose(), triangles, "mesh of arrays");
}

RemeshedArrays preserving_remesh(const Eigen::MatrixX3d& vertices, const Eigen::MatrixX3i& faces,
                                 const RemeshOptions& options, LengthSpec length,
                                 const PreservationOptions& preservation, const Observer& observer) {
  ValidMesh input = mesh_from_arrays(vertices, faces);
  if (options.connectivity == ConnectivityMode::adapt) length.whose = LengthSpec::Natural::shorter;
  set_target_lengths(input.mesh, input.memory_order, length);
  RemeshedArrays done;
  done.result =
      preserving_remesh(input.mesh, std::move(input.memory_order), options, preservation, {}, observer);
  done.warnings = std::move(input.warnings);
  done.vertices = vertex_points(input.mesh).transpose();
  const std::vector<Triangle> triangles = triangles_of(input.mesh);
  done.faces.resize(std::ssize(triangles), 3);
  for (Eigen::Index f = 0; f < done.faces.rows(); ++f)
    for (Eigen::Index k = 0; k < 3; ++k) done.faces(f, k) = triangles[f][k];
  return done;
}

}  // namespace hooke
