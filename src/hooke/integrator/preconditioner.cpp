#include "hooke/integrator/preconditioner.h"

#include <algorithm>

#include "hooke/core/parallel.h"
#include "hooke/integrator/local_newton.h"

namespace hooke {

void Preconditioner::refresh(Relaxation& r) {
  const auto n = static_cast<size_t>(r.connectivity.vertex_count);
  inverse_.resize(n);
  std::vector<float> mean(n, 0);  // a weight need not be exact, and memory is scarcest here
  parallel_for(n, 256, [&](size_t begin, size_t end) {
    LocalNewton newton(r);
    for (size_t v = begin; v < end; ++v) {
      const LocalCurvature c = newton.curvature(static_cast<int>(v));
      inverse_[v] = SymmetricMatrix(c.inverse);
      mean[v] = static_cast<float>(c.mean);
    }
  });
  const auto middle = mean.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(mean.begin(), middle, mean.end());
  grid_weight_ = *middle > 0 ? options_.grid_weight / *middle : 0;
}

void Preconditioner::apply(const Relaxation& r, Mat3X& vectors) const {
  const GridHierarchy::Correction correction = grids_.solve(vectors);
  parallel_for(static_cast<size_t>(vectors.cols()), 4096, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      auto u = vectors.col(static_cast<Eigen::Index>(v));
      u = inverse_[v] * Vec3(u);
    }
  });
  grids_.add(correction, grid_weight_, vectors);
  r.retraction.constrain(r.placement, vectors);
}

}  // namespace hooke
