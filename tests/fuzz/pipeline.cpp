// The whole run on tiny meshes, repaired where they are not valid, by cutting their junctions or keeping
// them: the result is finite, its faces are the input's or form a valid mesh, copies of a vertex lie in one
// place, and what is promised is kept but in mode `adapt`.
#include <cstdlib>

#include "arrays.h"
#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/valid_mesh.h"
#include "hooke/remesh/preserving_remesh.h"
#include "hooke/springs/sizing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  const fuzz::Arrays arrays = fuzz::arrays_from(data, size);
  if (arrays.triangles.empty()) return 0;
  constexpr int max_calls = 100;  // a mesh that no lengths can keep is made again and again
  const ThreadLimit one(1);
  RepairOptions mending;
  mending.repair = true;
  mending.keep_junctions = (arrays.choice & 32) != 0;
  RemeshOptions options;
  options.connectivity = static_cast<ConnectivityMode>(arrays.choice % 3);
  const bool adapts = options.connectivity == ConnectivityMode::adapt;
  options.effort = adapts || (arrays.choice & 64) != 0 ? Effort::fast : Effort::standard;
  if (options.connectivity == ConnectivityMode::fixed && (arrays.choice & 128) != 0)
    options.integrator = IntegratorKind::damped;
  try {
    ValidMesh input = make_valid_mesh(arrays.points, arrays.triangles, "mesh", mending);
    TriMesh& mesh = input.mesh;
    const std::vector<Triangle> faces = triangles_of(mesh);
    const std::size_t vertices = mesh.n_vertices();
    set_target_lengths(mesh, input.memory_order, {});
    if (adapts && (arrays.choice & 128) != 0)
      options.min_length = .05 * vertex_values(mesh, target_length_property).front();
    int calls = 0;
    const Observer stops_in_the_end = [&](const Progress&) { return ++calls < max_calls; };
    const RemeshResult done =
        preserving_remesh(mesh, std::move(input.memory_order), options, {}, {}, stops_in_the_end);
    const Mat3X points = vertex_points(mesh);
    const std::vector<Triangle> result = triangles_of(mesh);
    if (!points.allFinite()) std::abort();
    if (!adapts && mesh.n_vertices() != vertices) std::abort();
    if (options.connectivity == ConnectivityMode::fixed && result != faces) std::abort();
    for (const Problem& problem : find_problems(points, result))
      if (!is_acceptable(problem.kind)) std::abort();
    const std::vector<int> joined = joined_vertices(mesh);
    for (std::size_t v = 0; v < joined.size(); ++v)
      if (points.col(static_cast<Eigen::Index>(v)) != points.col(joined[v])) std::abort();
    if (!adapts && done.measures && !done.measures->preservation.holds()) std::abort();
  } catch (const MeshError&) {
  }
  return 0;
}
