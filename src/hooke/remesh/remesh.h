// Filtered Hooke's Optimization, Algorithm 1: alternates relaxation and filtering until the mesh is regular.
// Also runs the connectivity modes before it, and angle optimisation and sliver removal after it.
// "Hooke's Optimization for 3D triangular mesh".
#pragma once

#include "hooke/remesh/options.h"
#include "hooke/remesh/result.h"

namespace hooke {

class Stopwatch;

/// Moves the vertices of the mesh on its own surface until its edges are as close to their target lengths
/// (v:target_length, or e:target_length in mode `fixed`) as the connectivity allows, then raises its minimum
/// angles. Mode `fixed` keeps vertices,
/// faces and their ids. Mode `flip` keeps the vertex ids and the number of faces, but replaces the faces, and
/// vertices may travel far. Mode `adapt` replaces the vertices too: the remaining ones come first, in their
/// order, then new ones. The mesh is always left valid; an observer that returns false stops the run with the
/// result reached so far. Throws LimitError or NumericalError if the surface field cannot be fitted, Error
/// for e:target_length in another mode than `fixed`.
RemeshResult remesh(TriMesh& mesh, const RemeshOptions& options, const Observer& observer = nullptr,
                    Stopwatch* stopwatch = nullptr);

/// The same for a mesh whose memory order is known.
RemeshResult remesh(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                    const Observer& observer = nullptr, Stopwatch* stopwatch = nullptr);

/// Makes the guards preserve the minimum angle if the mesh is near-regular or has a uniform target length,
/// and limits the travel of the vertices of a near-regular mesh. Returns whether the mesh is near-regular.
/// Pre-condition: no vertex has moved.
bool keep_near_regular(Workspace& work, const NearRegularOptions& options, GuardOptions& guards);

}  // namespace hooke
