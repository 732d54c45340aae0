// What every connectivity mode ends with, on faces that stay: relaxation and filter in turns, then the
// polish.
#pragma once

#include "hooke/remesh/remesh.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {

/// Unfolds, relaxes and puts the vertices back on the surface until they are at rest, then raises the least
/// angles. They have landed on the field of the input in the end, interrupted or not. `flips` is what the
/// mode has done before: nothing more is done if it was interrupted.
RemeshResult iterate(Workspace& work, const RemeshOptions& options, const FlipResult& flips,
                     const Observer& observer);

/// After other faces about the worst corners: these are searched again, for the `result` of a run so far,
/// which has taken so many seconds.
RemeshResult search_again(Workspace& work, const RemeshOptions& options, RemeshResult result, double seconds,
                          const Observer& observer);

}  // namespace hooke
