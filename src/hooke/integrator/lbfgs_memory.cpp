#include "hooke/integrator/lbfgs_memory.h"

#include <utility>

#include "hooke/integrator/column_arithmetic.h"

namespace hooke {

void LbfgsMemory::clear() {
  pairs_.clear();
  pushed_ = 0;
  scale_ = options_.first_step;
}

void LbfgsMemory::push(const Relaxation& r, const Preconditioner& h0, const Mat3X& s, const Mat3X& y) {
  const double sy = dot(s, y);
  if (!(sy > 1e-12 * dot(y, y))) return;  // no curvature along this step: it would spoil the inverse Hessian
  if (pushed_++ < options_.scaled_pairs) {
    Mat3X preconditioned = y;
    h0.apply(r, preconditioned);
    scale_ = sy / dot(y, preconditioned);
  }
  if (options_.pairs == 0) return;
  Pair pair;
  if (pairs_.size() == static_cast<size_t>(options_.pairs)) {  // its memory serves again
    pair = std::move(pairs_.front());
    pairs_.pop_front();
  }
  assign_scaled(1, s, pair.s);
  assign_scaled(1, y, pair.y);
  pair.rho = 1 / sy;
  pairs_.push_back(std::move(pair));
}

void LbfgsMemory::apply(const Relaxation& r, const Preconditioner& h0, Mat3X& q) const {
  std::vector<double> alpha(pairs_.size());
  for (size_t i = pairs_.size(); i-- > 0;) {
    alpha[i] = pairs_[i].rho * dot(pairs_[i].s, q);
    add_scaled(-alpha[i], pairs_[i].y, q);
  }
  h0.apply(r, q);
  assign_scaled(scale_, q, q);
  for (size_t i = 0; i < pairs_.size(); ++i) {
    const double beta = pairs_[i].rho * dot(pairs_[i].y, q);
    add_scaled(alpha[i] - beta, pairs_[i].s, q);
  }
}

}  // namespace hooke
