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
/// result reached so far. v:force then holds what set_residual_forces() says, v:velocity the last velocity
/// of the damped integrator, in mean target lengths, and zero with the other one and in mode `adapt`. Throws
/// LimitError or NumericalError if the surface field cannot be fitted, Error for e:target_length in another
/// mode than `fixed`.
RemeshResult remesh(TriMesh& mesh, const RemeshOptions& options, const Observer& observer = nullptr,
                    Stopwatch* stopwatch = nullptr);

/// The same for a mesh whose memory order is known.
RemeshResult remesh(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                    const Observer& observer = nullptr, Stopwatch* stopwatch = nullptr);

/// Writes the force with which the springs still pull at each vertex to v:force, in space, borders and fixed
/// vertices included: minus the gradient of the energy of strings and, weighted by `altitude`, of altitude
/// springs, in mean target lengths. Where all target lengths are equal, the force of a string stretched to
/// twice its length is 1. `memory_order`: of the mesh, which has target lengths.
void set_residual_forces(TriMesh& mesh, const MemoryOrder& memory_order, double altitude);

}  // namespace hooke
