#include "hooke/integrator/lbfgs.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/core/types.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/final_projection.h"
#include "hooke/integrator/gauss_seidel.h"
#include "hooke/integrator/preconditioner.h"
#include "hooke/integrator/relaxation.h"

namespace hooke {
namespace {

constexpr size_t max_pairs = 3;    // of steps and gradient changes that are stored
constexpr double first_step = .5;  // factor of the preconditioned gradient while no pair is stored
constexpr int scaled_pairs = 3;    // number of first pairs that rescale the preconditioner

constexpr double sweep_factor = 1.5;  // over-relaxation of all sweeps but the first
constexpr int curvature_every = 8;    // steps between updates of the preconditioner's local curvatures
constexpr double armijo = 1e-4;       // minimum decrease of the energy, over the predicted one
constexpr int max_backtracks = 12;    // shortened candidates per step before it is given up
constexpr double min_cap = .25;       // lower bound of the cap, in target lengths

// Local relaxation around vertices limited by guards.
constexpr double locally_relaxable = .01;  // largest part of the vertices that is relaxed
constexpr int relaxed_rings = 1;           // around the limited vertices, within which vertices move
constexpr int local_sweeps = 3;

/// The limited memory of L-BFGS: the last steps with their gradient changes, and their product with a vector.
class LbfgsMemory {
 public:
  bool empty() const { return pairs_.empty(); }
  void clear();

  /// Stores a step and its gradient change, unless the energy has no positive curvature along the step.
  void push(const Relaxation& r, const Preconditioner& h0, const Mat3X& step, const Mat3X& gradient_change);

  /// q = H q, H the approximate inverse Hessian.
  void apply(const Relaxation& r, const Preconditioner& h0, Mat3X& q) const;

 private:
  /// Single precision is enough for a search direction, and halves memory and time.
  using Kept = Eigen::Matrix<float, 3, Eigen::Dynamic>;
  struct Pair {
    Kept s, y;
    double rho = 0;  // 1 / s.y
  };
  std::deque<Pair> pairs_;
  double scale_ = first_step;
  int pushed_ = 0;
};

// Parallel arithmetic on matrices of one column per vertex.

/// Calls body(first, count) on blocks of columns.
template <typename Body>
void for_columns(Eigen::Index columns, const Body& body) {
  parallel_for(columns, 4096, [&](std::size_t begin, std::size_t end) {
    body(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
  });
}

/// Sum of the products of all entries, of any precision, in double precision.
template <typename A, typename B>
double dot(const A& a, const B& b) {
  return parallel_sum(a.cols(), 4096, [&](std::size_t begin, std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    return a.middleCols(first, count)
        .template cast<double>()
        .cwiseProduct(b.middleCols(first, count).template cast<double>())
        .sum();
  });
}

/// dot(a, b - c)
inline double dot_with_difference(const Mat3X& a, const Mat3X& b, const Mat3X& c) {
  return parallel_sum(a.cols(), 4096, [&](std::size_t begin, std::size_t end) {
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

/// difference = a - b; it may alias either.
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
  scale_ = first_step;
}

void LbfgsMemory::push(const Relaxation& r, const Preconditioner& h0, const Mat3X& s, const Mat3X& y) {
  const double sy = dot(s, y);
  if (!(sy > 1e-12 * dot(y, y))) return;  // no curvature along this step: it would spoil the inverse Hessian
  if (pushed_++ < scaled_pairs) {
    Mat3X preconditioned = y;
    h0.apply(r, preconditioned);
    scale_ = sy / dot(y, preconditioned);
  }
  Pair pair;
  if (pairs_.size() == max_pairs) {  // reuses the memory of the oldest pair
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

/// The part of the vertices whose step has the length of the cap.
double capped_fraction(const Relaxation& r, double max_move, const Mat3X& d) {
  constexpr double almost = 1 - 1e-6;
  Eigen::Index capped = 0;
  for (Eigen::Index v = 0; v < d.cols(); ++v)
    capped += d.col(v).norm() >= almost * max_move * r.vertex_length[v];
  return static_cast<double>(capped) / static_cast<double>(d.cols());
}

/// Makes d a descent direction in the tangent space, no vertex beyond the cap; blocked vertices neither move
/// nor act on others. Falls back to the preconditioned gradient.
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

/// Raises the lazy error of the retraction during its lifetime.
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

/// Relaxes the candidate locally around vertices limited by guards, which no longer match their
/// neighbourhood.
void relax_around(Relaxation& r, const std::vector<int>& limited, SurfacePositions& candidate) {
  std::swap(r.positions, candidate);
  relax_locally(r, with_rings(r.adjacency, limited, relaxed_rings), {.sweeps = local_sweeps}, nullptr);
  std::swap(r.positions, candidate);
}

/// Leaves drifted vertices unprojected. `candidate` only provides memory: its values on return have no
/// meaning.
IntegrationResult descend(Relaxation& r, const IntegrationOptions& options, const LbfgsOptions& lbfgs,
                          const Observer& observer, SurfacePositions& candidate) {
  constexpr double lazy_error = 1e-2;  // tolerated by the retraction until the end, in mean target lengths
  const LooseRetraction loose(r.retraction, lazy_error);
  IntegrationResult result;
  for (int sweep = 0; sweep < lbfgs.sweeps; ++sweep) {
    const Stage stage(r.stopwatch, "sweeps");
    local_newton_sweep(r, {}, {.over_relaxation = sweep == 0 ? 1 : sweep_factor});
  }
  if (options.max_steps <= 1) {
    result.energy = r.present_energy();
    result.evaluations = 1;
    result.reason = StopReason::step_limit;
    return result;
  }
  LbfgsMemory memory;
  Preconditioner h0(r);
  RestDetector rest(options);
  Mat3X gradient, step;
  Mat3X candidate_gradient;  // first holds the step, which the guards shorten, then the gradient
  std::vector<int> limited;  // vertices limited by guards in the last candidate
  std::vector<int> blocked;  // vertices limited in the last step, which skip this one
  double max_move = options.max_move;

  result.energy = r.energy(r.positions.points, r.positions.normals, &gradient);
  result.evaluations = 1;
  r.retraction.constrain(r.positions, gradient);
  rest.at_rest(result.energy);
  result.reason = StopReason::step_limit;

  while (result.evaluations < options.max_steps) {
    if (result.steps % curvature_every == 0) timed(r.stopwatch, "preconditioner", [&] { h0.refresh(r); });
    const auto find_step = [&] { find_descent(r, max_move, gradient, blocked, h0, memory, step); };
    timed(r.stopwatch, "direction", find_step);
    bool accepted = false;
    bool relaxed_locally = false;
    double candidate_energy = 0;
    for (int tries = 0; tries <= max_backtracks && !accepted; ++tries) {
      if (tries > 0 && (limited.empty() || relaxed_locally)) {
        assign_scaled(.5, step, step);
      } else if (tries > 0) {  // limited vertices spoil the step of the others
        if (max_move > min_cap && capped_fraction(r, max_move, step) > lbfgs.max_capped_fraction) {
          max_move /= 2;
          // The long cap is what limited them.
          result.limited_steps -= static_cast<long long>(limited.size());
        } else {
          blocked.insert(blocked.end(), limited.begin(), limited.end());
        }
        find_step();
      }
      assign_scaled(1, step, candidate_gradient);
      limited = timed(r.stopwatch, "guards", [&] {
        return r.guards.step(r.retraction, r.positions, candidate_gradient, candidate, r.stopwatch);
      });
      result.limited_steps += static_cast<long long>(limited.size());
      relaxed_locally = !limited.empty() &&
                        static_cast<double>(limited.size()) <= locally_relaxable * r.adjacency.vertex_count;
      if (relaxed_locally) timed(r.stopwatch, "mending", [&] { relax_around(r, limited, candidate); });
      candidate_energy = timed(r.stopwatch, "energy", [&] {
        return r.energy(candidate.points, candidate.normals, &candidate_gradient);
      });
      ++result.evaluations;
      const double slope = dot_with_difference(gradient, candidate.points, r.positions.points);
      accepted = candidate_energy <= result.energy + armijo * std::min(0., slope);
      if (!accepted && observer && !observer({"", 0, result.steps, result.energy})) {
        result.reason = StopReason::interrupted;
        return result;
      }
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
    r.retraction.constrain(candidate, candidate_gradient);
    subtract(candidate_gradient, gradient, gradient);
    subtract(candidate.points, r.positions.points, step);
    memory.push(r, h0, step, gradient);
    std::swap(r.positions, candidate);
    std::swap(gradient, candidate_gradient);
    if (relaxed_locally)
      blocked.clear();
    else
      blocked = limited;
    result.energy = candidate_energy;
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
  SurfacePositions candidate;
  IntegrationResult result = descend(r, options, lbfgs, observer, candidate);
  if (!lbfgs.projects_at_end) return result;
  project_drifted(r.guards, r.retraction, r.positions, candidate);
  std::swap(r.positions, candidate);
  result.energy = r.present_energy();
  return result;
}

}  // namespace hooke
