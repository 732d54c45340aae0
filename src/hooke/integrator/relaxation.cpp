#include "hooke/integrator/relaxation.h"

#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {

Relaxation::Relaxation(const Adjacency& c, const VertexColoring& colors, const TargetLengths& targets,
                       VertexTable& vertices, Retraction& field, const EnergyTerms& weights,
                       const ShapeLimits& limits, Stopwatch* watch)
    : adjacency(c),
      coloring(colors),
      vertex_length(vertices.vertex_length),
      energy(c, targets, weights),
      terms{weights},
      retraction(field),
      guards(c, targets, limits),
      positions(vertices.positions),
      stopwatch(watch) {}

Relaxation::Relaxation(Workspace& work, const EnergyTerms& weights, const ShapeLimits& limits)
    : Relaxation(*work.adjacency, work.coloring, work.targets, work.vertices, *work.retraction, weights,
                 limits, work.stopwatch) {}

double Relaxation::present_energy() {
  return energy(positions.points, positions.normals, nullptr);
}

void cap_displacement(const std::vector<double>& vertex_length, double max_move, Mat3X& displacement) {
  parallel_for(vertex_length.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      auto u = displacement.col(static_cast<Eigen::Index>(v));
      const double length = u.norm();
      const double cap = max_move * vertex_length[v];
      if (length > cap) u *= cap / length;
    }
  });
}

bool RestDetector::at_rest(double energy) {
  history_.push_back(energy);
  const size_t window = options_.window;
  if (history_.size() <= window) return false;
  const double before = history_[history_.size() - 1 - window];
  return before - energy <= options_.energy_drop * std::abs(energy);
}

}  // namespace hooke
