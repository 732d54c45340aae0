// The limited memory of L-BFGS: the last steps and changes of the gradient, and what they make of a vector.
// J. Nocedal, "Updating quasi-Newton matrices with limited storage", 1980.
#pragma once

#include <deque>

#include "hooke/integrator/preconditioner.h"

namespace hooke {

struct LbfgsMemoryOptions {
  int pairs = 3;           // of steps and gradient changes
  double first_step = .5;  // of the preconditioned gradient, while there is no memory
  int scaled_pairs = 3;    // the preconditioner is scaled to the last pair until this many are held
};

class LbfgsMemory {
 public:
  explicit LbfgsMemory(const LbfgsMemoryOptions& options) : options_(options), scale_(options.first_step) {}

  bool empty() const { return pairs_.empty(); }
  void clear();

  /// Takes in a step and what it did to the gradient; not if the energy did not curve along it.
  void push(const Relaxation& r, const Preconditioner& h0, const Mat3X& step, const Mat3X& gradient_change);

  /// q = H q, H the inverse Hessian as far as it is known.
  void apply(const Relaxation& r, const Preconditioner& h0, Mat3X& q) const;

 private:
  /// Directs the next steps and need not be exact: half the memory, half the time.
  using Kept = Eigen::Matrix<float, 3, Eigen::Dynamic>;
  struct Pair {
    Kept s, y;
    double rho = 0;  // 1 / s.y
  };
  LbfgsMemoryOptions options_;
  std::deque<Pair> pairs_;
  double scale_;
  int pushed_ = 0;
};

}  // namespace hooke
