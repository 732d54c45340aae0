// Filtered Hooke's Optimization, Algorithm 1: relaxation and filtering by turns until the mesh is regular.
// "Hooke's Optimization for 3D triangular mesh".
#pragma once

#include "hooke/remesh/options.h"
#include "hooke/remesh/result.h"

namespace hooke {

class Stopwatch;

/// Moves the vertices of the mesh on its own surface until its edges are as near to their target lengths
/// (v:target_length) as the connectivity allows, then raises its least angles. Ids stay, and in mode `fixed`
/// connectivity; in mode `flip` the mesh gets new faces, of as many ids, and its vertices may travel far from
/// where they were. In mode `adapt` it gets other vertices too: first those that are left of its own, in
/// their order, then new ones. The mesh is always left valid; an observer that returns false stops with what
/// has been reached.
RemeshResult remesh(TriMesh& mesh, const RemeshOptions& options, const Observer& observer = nullptr,
                    Stopwatch* stopwatch = nullptr);

/// The same with the mesh's layout, where it is known already.
RemeshResult remesh(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                    const Observer& observer = nullptr, Stopwatch* stopwatch = nullptr);

/// Lets the guards keep the least angle where all edges are to have one length or the mesh is near-regular,
/// and the vertices of a near-regular mesh within reach. Returns whether it is near-regular. Pre-condition:
/// no vertex has moved.
bool keep_near_regular(Workspace& work, const NearRegularOptions& options, GuardOptions& guards);

}  // namespace hooke
