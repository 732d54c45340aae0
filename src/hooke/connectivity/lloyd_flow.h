// Lloyd's method on a surface mesh: each vertex moves toward the centroid of its Voronoi cell. The flow, a
// sequence of over-relaxed steps between Delaunay flips, distributes the vertices as in a regular mesh.
// S. P. Lloyd, "Least squares quantization in PCM", 1982; cells on meshes after Q. Du, V. Faber and M.
// Gunzburger, "Centroidal Voronoi tessellations", 1999.
#pragma once

#include "hooke/connectivity/edge_flips.h"
#include "hooke/integrator/integration.h"

namespace hooke {

struct Adjacency;
struct SurfacePositions;
struct ShapeLimits;

/// Factor on the displacement of a vertex to the centroid.
inline constexpr double lloyd_over_relaxation = 1.3;
/// Factor on the displacement of a vertex between its neighbours on feature edges.
inline constexpr double lloyd_boundary_relaxation = .91;

/// The displacements of all vertices, 3 x n; the caller makes them tangential and retracts. The cell consists
/// of signed kites between the vertex, the midpoints of its edges and the circumcentres of its faces; its
/// density is L^-4, which makes edge lengths follow L. A vertex near a non-Delaunay edge, or near a feature
/// edge opposite an obtuse angle, has no such cell and uses the centroid of its faces. Vertices on feature
/// edges move parallel to the line between their two neighbours, to where the two edges have the ratio of
/// their target lengths. Over-relaxed by the factors above.
Mat3X lloyd_step(const SurfacePositions& positions, const Adjacency& adjacency,
                 const std::vector<double>& vertex_length);

struct LloydFlowResult {
  int rounds = 0;
  long long flips = 0;
  long long limited_steps = 0;  // vertex steps shortened by the guards
  bool interrupted = false;
};

/// Runs so many rounds of flips and one Lloyd step, and ends with flips, after which the mesh is Delaunay as
/// far as the limits allow. The observer is called before the first round and after each round.
LloydFlowResult flow(WorkingMesh& mesh, int rounds, const ShapeLimits& limits, const Observer& observer);

}  // namespace hooke
