// Any triangles are repaired to a valid mesh or refused, and what the origin says of the repair is true.
#include <cstdlib>

#include "arrays.h"
#include "hooke/core/error.h"
#include "hooke/mesh/repair.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  const fuzz::Arrays arrays = fuzz::arrays_from(data, size);
  if (arrays.triangles.empty()) return 0;
  RepairOptions options;
  options.repair = true;
  if (arrays.choice & 1) options.weld = 1.5;
  if (arrays.choice & 2) options.fill_holes = 6;
  if (arrays.choice & 4) options.drop_components = .2;
  const MeshSource source{.name = "mesh"};
  try {
    const Repaired repaired = repair(arrays.points, arrays.triangles, options, source);
    for (const Problem& problem : find_problems(repaired.points, repaired.triangles))
      if (!is_acceptable(problem.kind) && problem.kind != ProblemKind::no_faces &&
          problem.kind != ProblemKind::no_area)
        std::abort();
    const MeshOrigin& origin = repaired.origin;
    if (origin.vertex.empty()) return 0;
    if (origin.vertex.size() != static_cast<std::size_t>(repaired.points.cols())) std::abort();
    for (const int v : origin.vertex)
      if (v < 0 || v >= arrays.points.cols()) std::abort();
    if (origin.face.size() != repaired.triangles.size()) std::abort();
    for (const int f : origin.face)
      if (f < 0 || f >= std::ssize(arrays.triangles)) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
