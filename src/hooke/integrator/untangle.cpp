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
  constexpr int max_rounds = 12, patience = 3;  // of these, without fewer folded faces
  constexpr int rings = 2;  // around these, within which vertices move; each round adds as many
  constexpr LocalRelaxationOptions sweeps = {.sweeps = 30, .over_relaxation = 1.5};  // faces unfold sooner
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
