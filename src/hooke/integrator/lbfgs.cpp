#include "hooke/integrator/lbfgs.h"

#include <algorithm>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/core/types.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/final_projection.h"
#include "hooke/integrator/gauss_seidel.h"
#include "hooke/integrator/relaxation.h"

namespace hooke {
namespace {

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

// Arithmetic on matrices of one column per vertex, by all threads.

/// Calls body(first, count) on blocks of columns.
template <typename Body>
void for_columns(Eigen::Index columns, const Body& body) {
  parallel_for(static_cast<std::size_t>(columns), 4096, [&](std::size_t begin, std::size_t end) {
    body(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
  });
}

/// Sum of all products of their entries; of any precision, in double precision.
template <typename A, typename B>
double dot(const A& a, const B& b) {
  return parallel_sum(static_cast<std::size_t>(a.cols()), 4096, [&](std::size_t begin, std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    return a.middleCols(first, count)
        .template cast<double>()
        .cwiseProduct(b.middleCols(first, count).template cast<double>())
        .sum();
  });
}

/// dot(a, b - c)
inline double dot_with_difference(const Mat3X& a, const Mat3X& b, const Mat3X& c) {
  return parallel_sum(static_cast<std::size_t>(a.cols()), 4096, [&](std::size_t begin, std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    return a.middleCols(first, count)
        .cwiseProduct(b.middleCols(first, count) - c.middleCols(first, count))
        .sum();
  });
}

/// a += factor * b
template <typename B>
void add_scaled(double factor, const B& b, Mat3X& a) {
  for_columns(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    a.middleCols(first, count) += factor * b.middleCols(first, count).template cast<double>();
  });
}

/// a = factor * b
template <typename B, typename A>
void assign_scaled(double factor, const B& b, A& a) {
  a.resize(3, b.cols());
  for_columns(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    a.middleCols(first, count) = (factor * b.middleCols(first, count)).template cast<typename A::Scalar>();
  });
}

/// difference = a - b, which may be one of them
inline void subtract(const Mat3X& a, const Mat3X& b, Mat3X& difference) {
  difference.resize(3, a.cols());
  for_columns(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    difference.middleCols(first, count) = a.middleCols(first, count) - b.middleCols(first, count);
  });
}

}  // namespace

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

namespace {

void clear_columns(const std::vector<int>& columns, Mat3X& matrix) {
  for (int v : columns) matrix.col(v).setZero();
}

/// Part of the vertices that go as far as they may.
double carried_share(const Relaxation& r, double max_move, const Mat3X& d) {
  constexpr double almost = 1 - 1e-6;
  Eigen::Index carried = 0;
  for (Eigen::Index v = 0; v < d.cols(); ++v)
    carried += d.col(v).norm() >= almost * max_move * r.vertex_length[static_cast<size_t>(v)];
  return static_cast<double>(carried) / static_cast<double>(d.cols());
}

/// Makes d a descent direction in the tangent space, no vertex longer than the cap; blocked vertices neither
/// move nor pull at others. Falls back to the gradient.
void find_descent(const Relaxation& r, double max_move, const Mat3X& gradient,
                  const std::vector<int>& blocked, const Preconditioner& h0, LbfgsMemory& memory, Mat3X& d) {
  for (;;) {
    assign_scaled(-1, gradient, d);
    clear_columns(blocked, d);
    memory.apply(r, h0, d);
    clear_columns(blocked, d);
    r.retraction.constrain(r.positions, d);
    cap_displacement(r.vertex_length, max_move, d);
    if (memory.empty() || dot(d, gradient) < 0) return;
    memory.clear();
  }
}

/// The retraction is content with less while this lives.
class LooseRetraction {
 public:
  LooseRetraction(Retraction& retraction, double lazy_error)
      : retraction_(retraction),
        before_(retraction.set_lazy_error(std::max(lazy_error, retraction.options().lazy_error))) {}
  ~LooseRetraction() { retraction_.set_lazy_error(before_); }
  LooseRetraction(const LooseRetraction&) = delete;
  LooseRetraction& operator=(const LooseRetraction&) = delete;

 private:
  Retraction& retraction_;
  double before_;
};

/// What the guards hold back is out of step with what is around it: lets these places find their own way.
void relax_about(Relaxation& r, const std::vector<int>& held, const LbfgsOptions& lbfgs,
                 SurfacePositions& trial) {
  std::swap(r.positions, trial);
  relax_locally(r, with_rings(r.adjacency, held, lbfgs.relaxed_rings), {.sweeps = lbfgs.local_sweeps},
                nullptr);
  std::swap(r.positions, trial);
}

/// Leaves the vertices where they have drifted to. The trial is for its memory: its values mean nothing.
IntegrationResult descend(Relaxation& r, const IntegrationOptions& options, const LbfgsOptions& lbfgs,
                          const Observer& observer, SurfacePositions& trial) {
  const LooseRetraction loose(r.retraction, lbfgs.lazy_error);
  IntegrationResult result;
  for (int sweep = 0; sweep < lbfgs.sweeps; ++sweep) {
    const Stage stage(r.stopwatch, "sweeps");
    local_newton_sweep(r, {}, {.over_relaxation = sweep == 0 ? 1 : lbfgs.sweep_factor});
  }
  if (options.max_steps <= 1) {
    result.energy = r.energy(r.positions.points, r.positions.normals, nullptr);
    result.evaluations = 1;
    result.reason = StopReason::step_limit;
    return result;
  }
  LbfgsMemory memory(lbfgs.memory);
  Preconditioner h0(r, lbfgs.preconditioner);
  RestDetector rest(options);
  Mat3X gradient, step;
  Mat3X trial_gradient;      // until the energy is known it holds the step, which the guards shorten
  std::vector<int> held;     // by the guards, in the last trial
  std::vector<int> blocked;  // held in the last step: they sit out this one
  double max_move = options.max_move;

  result.energy = r.energy(r.positions.points, r.positions.normals, &gradient);
  result.evaluations = 1;
  r.retraction.constrain(r.positions, gradient);
  rest.at_rest(result.energy);
  result.reason = StopReason::step_limit;

  while (result.evaluations < options.max_steps) {
    if (result.steps % lbfgs.curvature_every == 0)
      timed(r.stopwatch, "preconditioner", [&] { h0.refresh(r); });
    const auto find_step = [&] { find_descent(r, max_move, gradient, blocked, h0, memory, step); };
    timed(r.stopwatch, "direction", find_step);
    bool accepted = false;
    bool relaxed_locally = false;
    double trial_energy = 0;
    for (int tries = 0; tries <= lbfgs.max_backtracks && !accepted; ++tries) {
      if (tries > 0 && (held.empty() || relaxed_locally)) {
        assign_scaled(.5, step, step);
      } else if (tries > 0) {  // what the guards hold back spoils the step of the others
        if (max_move > lbfgs.min_cap && carried_share(r, max_move, step) > lbfgs.carried) {
          max_move /= 2;
          result.limited_steps -= static_cast<long long>(held.size());  // but by what ran over them
        } else {
          blocked.insert(blocked.end(), held.begin(), held.end());
        }
        find_step();
      }
      assign_scaled(1, step, trial_gradient);
      held = timed(r.stopwatch, "guards", [&] {
        return r.guards.step(r.retraction, r.positions, trial_gradient, trial, r.stopwatch);
      });
      result.limited_steps += static_cast<long long>(held.size());
      relaxed_locally = !held.empty() && static_cast<double>(held.size()) <=
                                             lbfgs.locally_relaxable * r.adjacency.vertex_count;
      if (relaxed_locally) timed(r.stopwatch, "mending", [&] { relax_about(r, held, lbfgs, trial); });
      trial_energy = timed(r.stopwatch, "energy",
                           [&] { return r.energy(trial.points, trial.normals, &trial_gradient); });
      ++result.evaluations;
      const double slope = dot_with_difference(gradient, trial.points, r.positions.points);
      accepted = trial_energy <= result.energy + lbfgs.armijo * std::min(0., slope);
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
    subtract(trial_gradient, gradient, gradient);
    subtract(trial.points, r.positions.points, step);
    memory.push(r, h0, step, gradient);
    std::swap(r.positions, trial);
    std::swap(gradient, trial_gradient);
    if (relaxed_locally)
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
  return result;
}

}  // namespace

IntegrationResult relax_lbfgs(Relaxation& r, const IntegrationOptions& options, const LbfgsOptions& lbfgs,
                              const Observer& observer) {
  SurfacePositions trial;
  IntegrationResult result = descend(r, options, lbfgs, observer, trial);
  if (!lbfgs.projects_at_end) return result;
  project_drifted(r.guards, r.retraction, r.positions, trial);
  std::swap(r.positions, trial);
  result.energy = r.energy(r.positions.points, r.positions.normals, nullptr);
  return result;
}

}  // namespace hooke
