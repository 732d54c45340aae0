#include "hooke/lbfgs.h"

#include <deque>

#include "hooke/parallel.h"

namespace hooke {
namespace {

double dot(const Mat3X& a, const Mat3X& b) {
  return parallel_sum(static_cast<size_t>(a.cols()), 4096, [&](size_t begin, size_t end) {
    const auto from = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    return a.middleCols(from, count).cwiseProduct(b.middleCols(from, count)).sum();
  });
}

/// The last pairs (s, y) and the two-loop recursion over them.
class Memory {
 public:
  explicit Memory(const LbfgsOptions& options) : options_(options) {}

  bool empty() const { return pairs_.empty(); }
  void clear() { pairs_.clear(); }

  void push(Mat3X s, Mat3X y) {
    const double sy = dot(s, y);
    const double yy = dot(y, y);
    if (!(sy > 1e-12 * yy)) return;  // no curvature along this step: it would spoil the inverse Hessian
    pairs_.push_back({std::move(s), std::move(y), 1 / sy, sy / yy});
    if (pairs_.size() > static_cast<size_t>(options_.memory)) pairs_.pop_front();
  }

  /// -H g
  Mat3X direction(const Mat3X& gradient) const {
    Mat3X q = -gradient;
    std::vector<double> alpha(pairs_.size());
    for (size_t i = pairs_.size(); i-- > 0;) {
      alpha[i] = pairs_[i].rho * dot(pairs_[i].s, q);
      q -= alpha[i] * pairs_[i].y;
    }
    q *= empty() ? options_.first_step : pairs_.back().gamma;
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const double beta = pairs_[i].rho * dot(pairs_[i].y, q);
      q += (alpha[i] - beta) * pairs_[i].s;
    }
    return q;
  }

 private:
  struct Pair {
    Mat3X s, y;
    double rho;    // 1 / s.y
    double gamma;  // s.y / y.y
  };
  LbfgsOptions options_;
  std::deque<Pair> pairs_;
};

/// A descent direction in the tangent space, no vertex longer than the cap. Falls back to the gradient.
Mat3X descent_direction(const Relaxation& r, const IntegrationOptions& options, const Mat3X& gradient,
                        Memory& memory) {
  for (;;) {
    Mat3X d = memory.direction(gradient);
    r.retraction.constrain(r.placement, d);
    cap_displacement(r.vertex_length, options.max_move, d);
    if (memory.empty() || dot(d, gradient) < 0) return d;
    memory.clear();
  }
}

}  // namespace

IntegrationResult relax_lbfgs(Relaxation& r, const IntegrationOptions& options, const LbfgsOptions& lbfgs,
                              const Observer& observer) {
  IntegrationResult result;
  Memory memory(lbfgs);
  RestDetector rest(options);
  Mat3X gradient, trial_gradient;
  Placement trial;

  r.guards.accept(r.placement);
  result.energy = r.energy(r.placement, &gradient);
  result.evaluations = 1;
  r.retraction.constrain(r.placement, gradient);
  rest.at_rest(result.energy);
  result.reason = StopReason::step_limit;

  while (result.evaluations < options.max_steps) {
    Mat3X step = descent_direction(r, options, gradient, memory);
    bool accepted = false;
    double trial_energy = 0;
    for (int halvings = 0; halvings <= lbfgs.max_backtracks && !accepted; ++halvings) {
      if (halvings > 0) step *= .5;
      Mat3X displacement = step;
      result.held_back += r.guards.step(r.retraction, r.placement, displacement, trial);
      trial_energy = r.energy(trial, &trial_gradient);
      ++result.evaluations;
      displacement = trial.points - r.placement.points;
      accepted = trial_energy <= result.energy + lbfgs.armijo * std::min(0., dot(gradient, displacement));
    }
    if (!accepted) {
      if (!memory.empty()) {
        memory.clear();
        continue;
      }
      result.reason = StopReason::stalled;
      break;
    }
    r.retraction.constrain(trial, trial_gradient);
    memory.push(trial.points - r.placement.points, trial_gradient - gradient);
    std::swap(r.placement, trial);
    std::swap(gradient, trial_gradient);
    r.guards.accept_step();
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
  positions(r.mesh) = r.placement.points;
  VProp<Vec3> force(r.mesh, force_property), velocity(r.mesh, velocity_property);
  as_matrix(r.mesh, force) = -gradient;
  as_matrix(r.mesh, velocity).setZero();  // at rest
  return result;
}

}  // namespace hooke
