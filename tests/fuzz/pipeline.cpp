// The whole run on tiny meshes, repaired where they are not valid: the result is finite, its faces are the
// input's or form a valid mesh, and what is promised is kept but in mode `adapt`.
#include <cstdlib>

#include "arrays.h"
#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/mesh/repair.h"
#include "hooke/remesh/array_remesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  const fuzz::Arrays arrays = fuzz::arrays_from(data, size);
  if (arrays.triangles.empty()) return 0;
  const ThreadLimit one(1);
  RepairOptions mending;
  mending.repair = true;
  RemeshOptions options;
  options.connectivity = static_cast<ConnectivityMode>(arrays.choice % 3);
  options.effort = (arrays.choice & 64) != 0 ? Effort::fast : Effort::standard;
  if (options.connectivity == ConnectivityMode::fixed && (arrays.choice & 128) != 0)
    options.integrator = IntegratorKind::damped;
  try {
    const Repaired repaired = repair(arrays.points, arrays.triangles, mending, {.name = "mesh"});
    const Eigen::MatrixX3d vertices = repaired.points.transpose();
    Eigen::MatrixX3i faces(repaired.triangles.size(), 3);
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
      for (int k = 0; k < 3; ++k) faces(f, k) = repaired.triangles[f][k];
    const RemeshedArrays done = preserving_remesh(vertices, faces, options);
    if (!done.vertices.allFinite()) std::abort();
    const bool adapts = options.connectivity == ConnectivityMode::adapt;
    if (!adapts && done.vertices.rows() != vertices.rows()) std::abort();
    if (options.connectivity == ConnectivityMode::fixed && done.faces != faces) std::abort();
    std::vector<Triangle> result;
    for (Eigen::Index f = 0; f < done.faces.rows(); ++f)
      result.push_back({done.faces(f, 0), done.faces(f, 1), done.faces(f, 2)});
    for (const Problem& problem : find_problems(done.vertices.transpose(), result))
      if (!is_acceptable(problem.kind)) std::abort();
    if (!adapts && done.result.measures && !done.result.measures->preservation.holds()) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
