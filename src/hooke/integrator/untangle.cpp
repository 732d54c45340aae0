#include "hooke/integrator/untangle.h"

#include "hooke/integrator/gauss_seidel.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/energy.h"

namespace hooke {
namespace {

std::vector<int> corners_of(const Adjacency& c, const std::vector<int>& faces) {
  std::vector<int> vertices;
  for (int f : faces) {
    const Triangle& t = c.faces[f];
    vertices.insert(vertices.end(), t.begin(), t.end());
  }
  return vertices;
}

}  // namespace

UntangleResult untangle(Relaxation& r, const Observer& observer) {
  constexpr int max_rounds = 12;
  constexpr int patience = 3;  // rounds without fewer folded faces before giving up
  constexpr int rings = 2;     // around the folded faces, within which vertices move; each round adds as many
  // In each round; faces unfold sooner with over-relaxation.
  constexpr LocalRelaxationOptions sweeps = {.sweeps = 30, .over_relaxation = 1.5};
  UntangleResult result;
  result.folded = r.guards.folded_faces(r.positions);
  result.folded_before = static_cast<int>(result.folded.size());
  if (result.folded.empty()) return result;

  const TermsScope scope(r);
  r.terms.unfold = 1;
  size_t fewest = result.folded.size();
  for (int round = 0, rounds_without_gain = 0;
       round < max_rounds && rounds_without_gain < patience && !result.folded.empty() && !result.interrupted;
       ++round) {
    const LocalRelaxationResult relaxed =
        relax_locally(r, with_rings(r.adjacency, corners_of(r.adjacency, result.folded), (round + 1) * rings),
                      sweeps, observer);
    result.sweeps += relaxed.sweeps;
    result.interrupted = relaxed.interrupted;
    result.folded = r.guards.folded_faces(r.positions);
    rounds_without_gain = result.folded.size() < fewest ? 0 : rounds_without_gain + 1;
    fewest = std::min(fewest, result.folded.size());
  }
  return result;
}

}  // namespace hooke
