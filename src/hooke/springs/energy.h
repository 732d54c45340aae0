// The energy that relaxation minimises: springs on edges and altitudes, under the modified Hooke's law [4]
// and relative to their rest lengths, for four faces at a time. Its negative gradient is the force. For one
// vertex to second order, and with springs on angles, see springs/ring_energy.h.
#pragma once

#include "hooke/core/simd.h"
#include "hooke/core/types.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {

/// The springs of four faces, one per lane. All arrays are columns with one value per lane.
struct FaceSprings {
  // Input:
  double corners[9 * lane_count];      // x, y, z of each corner
  double edge_target[3 * lane_count];  // of the edge opposite each corner
  double has_edge[3 * lane_count];     // 1 where that edge belongs to this face, else 0
  double face_target[lane_count];
  double has_face[lane_count];  // 1, or 0 in an unused lane, which must repeat another face
  /// Unit surface normal, which faces without area use; read only if `has_normals`.
  double surface_normal[3 * lane_count];
  bool has_normals = false;

  // Output:
  double energy;                    // weighted sum over all four faces
  double gradient[9 * lane_count];  // with respect to each corner
  bool needs_normals;  // a face has no area, and no normals are given: energy and gradient are invalid
};

/// Weights of the terms; a term with weight 0 costs nothing.
struct EnergyTerms {
  double string = 1;    // lambda: U(l; L_e) / L_e^2 per edge [2]-[4]
  double altitude = 1;  // beta: U(h; h0) / h0^2 per altitude h < h0 = (sqrt 3 / 2) L_f
};

/// The energy of four faces and its gradient, weighted by the terms.
void evaluate_face_springs(const EnergyTerms& terms, FaceSprings& faces);

/// The energy of a whole mesh. Evaluations use parallel sums in a fixed order.
class Energy {
 public:
  /// Keeps references to the adjacency and the targets.
  Energy(const Adjacency& adjacency, const TargetLengths& targets, const EnergyTerms& terms);

  /// The energy at these points, 3 x |V|. `normals` are the unit surface normals, one column per wedge; they
  /// count as constant. A non-null `gradient` receives the gradient with respect to the points, 3 x |V|.
  double operator()(const Mat3X& points, const Mat3X& normals, Mat3X* gradient);

  const TargetLengths& targets() const { return targets_; }

 private:
  struct Points {
    const Mat3X& points;
    const Mat3X& normals;
  };
  double energy_of_four(const Points& at, size_t face, double* corner_gradients) const;
  void gather_faces(const Points& at, size_t face, size_t count, FaceSprings& four) const;
  void gather_normals(const Mat3X& normals, size_t face, size_t count, FaceSprings& four) const;

  /// Faces whose gradients are summed together, and the range of the vertices at their corners.
  struct Part {
    size_t begin, end;
    int first_vertex, last_vertex;
  };
  void add_corner_gradients(const Part& part, Mat3X& gradient) const;

  const Adjacency& adjacency_;
  const TargetLengths& targets_;
  const EnergyTerms terms_;
  std::vector<Part> parts_;
  std::vector<double> corner_gradients_;  // 9 per face of a part: gradients with respect to its corners
};

}  // namespace hooke
