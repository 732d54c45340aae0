#include "hooke/remesh/remesh.h"

#include <numeric>

#include "hooke/core/stopwatch.h"
#include "hooke/core/uniform_vector.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/remesh/run.h"
#include "hooke/remesh/run_options.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/sizing.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {

RemeshResult remesh(TriMesh& mesh, const RemeshOptions& options, const Observer& observer,
                    Stopwatch* stopwatch) {
  return remesh(mesh, timed(stopwatch, "order", [&] { return find_memory_order(mesh); }), options, observer,
                stopwatch);
}

RemeshResult remesh(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                    const Observer& observer, Stopwatch* stopwatch) {
  return Run(mesh, std::move(memory_order), RunOptions(options), observer, stopwatch).remesh(mesh);
}

void set_residual_forces(TriMesh& mesh, const MemoryOrder& memory_order, double altitude) {
  const Permutation& order = memory_order.order;
  const Adjacency& c = *memory_order.adjacency;
  const std::vector<double> of_vertices = vertex_values(mesh, target_length_property);
  const double unit =
      std::accumulate(of_vertices.begin(), of_vertices.end(), 0.) / static_cast<double>(of_vertices.size());
  const auto in_units = [&](const UniformVector& lengths) {
    std::vector<double> values = lengths.values();
    for (double& length : values) length /= unit;
    return UniformVector(std::move(values));
  };
  const TargetLengths in_file = target_lengths_of(mesh, order, c);
  const TargetLengths targets{in_units(in_file.edge), in_units(in_file.face)};
  const Mat3X points = order.gather(vertex_points(mesh)) / unit;
  Mat3X gradient;
  Energy(c, targets, {.altitude = altitude})(points, vertex_normals(points, c), &gradient);
  set_vertex_vectors(mesh, force_property, order.scatter(-gradient));
}

}  // namespace hooke
