#include "hooke/integrator/local_relaxation.h"

#include <algorithm>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr double still = .3;  // of `rest`: a vertex that wants to move less is not moved at all

/// Marks those of the vertices that moved farther than `rest` and the neighbours of those: all others have
/// found their place. Returns whether there are any.
bool mark_restless(const Connectivity& c, const std::vector<int>& vertices, const std::vector<double>& moves,
                   double rest, std::vector<char>& active) {
  const auto moved = [&](int v) { return moves[static_cast<size_t>(v)] > rest; };
  parallel_for(vertices.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      active[static_cast<size_t>(vertices[i])] =
          moved(vertices[i]) || std::ranges::any_of(c.vertex_neighbours[vertices[i]], moved);
  });
  return std::ranges::any_of(vertices, [&](int v) { return active[static_cast<size_t>(v)] != 0; });
}

}  // namespace

/// Steps are Newton's, not longer: where guards hold and springs end, longer ones magnify every difference,
/// and a mesh that is moved or turned would come out another.
LocalRelaxationResult relax_locally(Relaxation& r, const std::vector<int>& vertices,
                                    const LocalRelaxationOptions& o, const Observer& observer) {
  LocalRelaxationResult result;
  std::vector<char> active(static_cast<size_t>(r.connectivity.vertex_count), 0);
  for (int v : vertices) active[static_cast<size_t>(v)] = 1;
  bool restless = !vertices.empty();
  while (restless && result.sweeps < o.sweeps && !result.interrupted) {
    const std::vector<double> moves =
        local_newton_sweep(r, active, {.over_relaxation = o.over_relaxation, .rest = still * o.rest});
    restless = mark_restless(r.connectivity, vertices, moves, o.rest, active);
    result.interrupted = observer && !observer({.step = result.sweeps});
    ++result.sweeps;
  }
  return result;
}

}  // namespace hooke
