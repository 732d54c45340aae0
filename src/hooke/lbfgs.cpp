#include "hooke/lbfgs.h"

#include <algorithm>
#include <deque>

#include "hooke/local_relaxation.h"
#include "hooke/multigrid.h"
#include "hooke/parallel.h"

namespace hooke {
namespace {

/// What is kept from step to step directs the next ones and need not be exact: half the memory, half the
/// time.
using Kept = Eigen::Matrix<float, 3, Eigen::Dynamic>;

template <typename A>
double dot(const A& a, const Mat3X& b) {
  return parallel_sum(static_cast<size_t>(a.cols()), 4096, [&](size_t begin, size_t end) {
    const auto from = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    return a.middleCols(from, count).template cast<double>().cwiseProduct(b.middleCols(from, count)).sum();
  });
}

/// a += factor * b
void add_scaled(double factor, const Kept& b, Mat3X& a) {
  parallel_for(static_cast<size_t>(a.cols()), 4096, [&](size_t begin, size_t end) {
    const auto from = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    a.middleCols(from, count) += factor * b.middleCols(from, count).cast<double>();
  });
}

/// Symmetric.
struct KeptMatrix {
  float xx, yy, zz, xy, yz, zx;

  explicit KeptMatrix(const Eigen::Matrix3d& m = Eigen::Matrix3d::Zero())
      : xx(static_cast<float>(m(0, 0))),
        yy(static_cast<float>(m(1, 1))),
        zz(static_cast<float>(m(2, 2))),
        xy(static_cast<float>(m(0, 1))),
        yz(static_cast<float>(m(1, 2))),
        zx(static_cast<float>(m(2, 0))) {}

  Vec3 operator*(const Vec3& v) const {
    return {xx * v[0] + xy * v[1] + zx * v[2], xy * v[0] + yy * v[1] + yz * v[2],
            zx * v[0] + yz * v[1] + zz * v[2]};
  }
};

/// H0: the inverse curvature around each vertex plus the grids.
class Preconditioner {
 public:
  Preconditioner(const Relaxation& r, const LbfgsOptions& options)
      : options_(options), grids_(r.placement.points, options.grid_cell) {}

  void refresh(Relaxation& r) {
    const auto n = static_cast<size_t>(r.connectivity.vertex_count);
    inverse_.resize(n);
    std::vector<double> mean(n, 0);
    parallel_for(n, 256, [&](size_t begin, size_t end) {
      LocalNewton newton(r);
      for (size_t v = begin; v < end; ++v) {
        const LocalCurvature c = newton.curvature(static_cast<int>(v));
        inverse_[v] = KeptMatrix(c.inverse);
        mean[v] = c.mean;
      }
    });
    const auto middle = mean.begin() + static_cast<std::ptrdiff_t>(n / 2);
    std::nth_element(mean.begin(), middle, mean.end());
    grid_weight_ = *middle > 0 ? options_.grid_weight / *middle : 0;
  }

  /// vectors = H0 vectors
  void apply(const Relaxation& r, Mat3X& vectors) const {
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

 private:
  LbfgsOptions options_;
  GridHierarchy grids_;
  std::vector<KeptMatrix> inverse_;
  double grid_weight_ = 0;
};

/// The last pairs (s, y) and the two-loop recursion over them.
class Memory {
 public:
  explicit Memory(const LbfgsOptions& options) : options_(options), scale_(options.first_step) {}

  bool empty() const { return pairs_.empty(); }

  void clear() {
    pairs_.clear();
    pushed_ = 0;
    scale_ = options_.first_step;
  }

  void push(const Relaxation& r, const Preconditioner& h0, const Mat3X& s, const Mat3X& y) {
    const double sy = dot(s, y);
    if (!(sy > 1e-12 * dot(y, y)))
      return;  // no curvature along this step: it would spoil the inverse Hessian
    if (pushed_++ < options_.scaled_pairs) {
      Mat3X preconditioned = y;
      h0.apply(r, preconditioned);
      scale_ = sy / dot(y, preconditioned);
    }
    if (options_.memory == 0) return;
    if (pairs_.size() == static_cast<size_t>(options_.memory)) pairs_.pop_front();
    pairs_.push_back({s.cast<float>(), y.cast<float>(), 1 / sy});
  }

  /// q = H q
  void apply(const Relaxation& r, const Preconditioner& h0, Mat3X& q) const {
    std::vector<double> alpha(pairs_.size());
    for (size_t i = pairs_.size(); i-- > 0;) {
      alpha[i] = pairs_[i].rho * dot(pairs_[i].s, q);
      add_scaled(-alpha[i], pairs_[i].y, q);
    }
    h0.apply(r, q);
    q *= scale_;
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const double beta = pairs_[i].rho * dot(pairs_[i].y, q);
      add_scaled(alpha[i] - beta, pairs_[i].s, q);
    }
  }

 private:
  struct Pair {
    Kept s, y;
    double rho;  // 1 / s.y
  };
  LbfgsOptions options_;
  std::deque<Pair> pairs_;
  double scale_;
  int pushed_ = 0;
};

void clear_columns(const std::vector<int>& columns, Mat3X& matrix) {
  for (int v : columns) matrix.col(v).setZero();
}

/// A descent direction in the tangent space, no vertex longer than the cap; blocked vertices neither move nor
/// pull at others. Falls back to the gradient.
Mat3X descent_direction(const Relaxation& r, const IntegrationOptions& options, const Mat3X& gradient,
                        const std::vector<int>& blocked, const Preconditioner& h0, Memory& memory) {
  for (;;) {
    Mat3X d = -gradient;
    clear_columns(blocked, d);
    memory.apply(r, h0, d);
    clear_columns(blocked, d);
    r.retraction.constrain(r.placement, d);
    cap_displacement(r.vertex_length, options.max_move, d);
    if (memory.empty() || dot(d, gradient) < 0) return d;
    memory.clear();
  }
}

/// What the guards hold back is out of step with what is around it: lets these places find their own way.
void mend(Relaxation& r, const std::vector<int>& held, const LbfgsOptions& lbfgs, Placement& trial) {
  std::swap(r.placement, trial);
  relax_locally(r, with_rings(r.connectivity, held, lbfgs.mended_rings), {.sweeps = lbfgs.mending_sweeps},
                nullptr);
  std::swap(r.placement, trial);
}

}  // namespace

IntegrationResult relax_lbfgs(Relaxation& r, const IntegrationOptions& options, const LbfgsOptions& lbfgs,
                              const Observer& observer) {
  IntegrationResult result;
  for (int sweep = 0; sweep < lbfgs.sweeps; ++sweep) {
    const Stage stage(r.stopwatch, "sweeps");
    local_newton_sweep(r, {}, {.over_relaxation = sweep == 0 ? 1 : lbfgs.sweep_factor});
  }
  Memory memory(lbfgs);
  Preconditioner h0(r, lbfgs);
  RestDetector rest(options);
  Mat3X gradient, trial_gradient;
  Placement trial;
  std::vector<int> held;     // by the guards, in the last trial
  std::vector<int> blocked;  // held in the last step: they sit out this one

  result.energy = r.energy(r.placement, &gradient);
  result.evaluations = 1;
  r.retraction.constrain(r.placement, gradient);
  rest.at_rest(result.energy);
  result.reason = StopReason::step_limit;

  while (result.evaluations < options.max_steps) {
    if (result.steps % lbfgs.curvature_every == 0)
      timed(r.stopwatch, "preconditioner", [&] { h0.refresh(r); });
    Mat3X step = timed(r.stopwatch, "direction",
                       [&] { return descent_direction(r, options, gradient, blocked, h0, memory); });
    Mat3X displacement;  // from the placement to the trial
    bool accepted = false;
    bool mended = false;
    double trial_energy = 0;
    for (int tries = 0; tries <= lbfgs.max_backtracks && !accepted; ++tries) {
      if (tries > 0 && (held.empty() || mended)) {
        step *= .5;
      } else if (tries > 0) {  // what the guards hold back spoils the step of the others: without it
        blocked.insert(blocked.end(), held.begin(), held.end());
        step = descent_direction(r, options, gradient, blocked, h0, memory);
      }
      displacement = step;
      held = timed(r.stopwatch, "guards", [&] {
        return r.guards.step(r.retraction, r.placement, displacement, trial, r.stopwatch);
      });
      result.held_back += static_cast<long long>(held.size());
      mended =
          !held.empty() && static_cast<double>(held.size()) <= lbfgs.mendable * r.connectivity.vertex_count;
      if (mended) timed(r.stopwatch, "mending", [&] { mend(r, held, lbfgs, trial); });
      trial_energy = timed(r.stopwatch, "energy", [&] { return r.energy(trial, &trial_gradient); });
      ++result.evaluations;
      displacement = trial.points - r.placement.points;
      accepted = trial_energy <= result.energy + lbfgs.armijo * std::min(0., dot(gradient, displacement));
    }
    if (!accepted) {
      if (!memory.empty()) {
        memory.clear();
        blocked.clear();
        continue;
      }
      result.reason = StopReason::stalled;
      break;
    }
    r.retraction.constrain(trial, trial_gradient);
    gradient = trial_gradient - gradient;
    memory.push(r, h0, displacement, gradient);
    std::swap(r.placement, trial);
    std::swap(gradient, trial_gradient);
    if (mended)
      blocked.clear();
    else
      blocked = held;
    result.energy = trial_energy;
    ++result.steps;
    if (observer && !observer({"", 0, result.steps, result.energy})) {
      result.reason = StopReason::interrupted;
      break;
    }
    if (rest.at_rest(result.energy)) {
      result.reason = StopReason::stalled;
      break;
    }
  }
  r.retraction.settle(r.placement);
  return result;
}

}  // namespace hooke
