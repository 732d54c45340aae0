#include "hooke/untangle.h"

namespace hooke {

UntangleResult untangle(Relaxation& r, const UntangleOptions& options, const Observer& observer) {
  UntangleResult result;
  r.guards.accept(r.placement);
  result.folded = r.guards.folded_faces();
  result.folded_before = static_cast<int>(result.folded.size());

  const EnergyTerms terms = r.energy.terms;
  r.energy.terms.unfold = 1;
  IntegrationOptions integration;
  integration.max_steps = options.evaluations;
  for (int round = 0; round < options.max_rounds && !result.folded.empty() && !result.interrupted; ++round) {
    const IntegrationResult relaxed = relax_lbfgs(r, integration, LbfgsOptions{}, observer);
    result.evaluations += relaxed.evaluations;
    result.interrupted = relaxed.reason == StopReason::interrupted;
    r.guards.accept(r.placement);
    result.folded = r.guards.folded_faces();
    if (relaxed.steps == 0) break;
  }
  r.energy.terms = terms;
  return result;
}

}  // namespace hooke
