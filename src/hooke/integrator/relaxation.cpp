#include "hooke/integrator/relaxation.h"

#include "hooke/core/parallel.h"

namespace hooke {

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
