// One step of Lloyd's method on a surface mesh: every vertex heads for the centroid of its Voronoi cell.
// S. P. Lloyd, "Least squares quantization in PCM", 1982; cells on meshes after Q. Du, V. Faber and M.
// Gunzburger, "Centroidal Voronoi tessellations", 1999.
#pragma once

#include "hooke/connectivity/edge_flips.h"
#include "hooke/integrator/relaxation.h"

namespace hooke {

struct Adjacency;
struct GuardOptions;

struct LloydOptions {
  double over_relaxation = 1.3;      // of the way to the centroid
  double boundary_relaxation = .91;  // of the way to the middle of the two neighbours on the boundary
  double max_move = .3;              // in target lengths
};

/// Where every vertex is to go; the caller makes that tangential and retracts. The cell is made of signed
/// kites between the vertex, the middles of its edges and the circumcentres of its faces; its density is
/// L^-4, which makes the lengths of the edges follow L. A vertex near an edge that is not Delaunay, or near a
/// boundary edge that faces an obtuse angle, has no such cell and takes the centroid of its faces. Vertices
/// on the boundary or a crease go along the line between their neighbours to where the two edges have the
/// ratio of their target lengths.
Mat3X lloyd_step(const SurfacePositions& positions, const Adjacency& adjacency,
                 const std::vector<double>& vertex_length, const LloydOptions& options);

// Flow: over-relaxed Lloyd steps between Delaunay flips. It carries the vertices to where a regular mesh has
// them; springs with flips alone lock long before.

struct LloydFlowOptions {
  int rounds = 32;       // of flips and one step
  int corner_every = 5;  // rounds between two looks at the corners, after the first quarter of the rounds
  LloydOptions lloyd{};
};

struct LloydFlowResult {
  int rounds = 0;
  long long flips = 0;
  long long limited_steps = 0;  // vertex steps shortened by the guards
  bool interrupted = false;
};

/// Ends with flips: the mesh is Delaunay as far as the guards allow. The observer is asked beforehand, and
/// after each round.
LloydFlowResult flow(FlippableMesh& mesh, const LloydFlowOptions& options, const FlipGuardOptions& flip_guard,
                     const GuardOptions& guards, const Observer& observer);

}  // namespace hooke
