// Strings and altitude springs [2]-[4] of faces, four at a time: the bulk of every relaxation.
#pragma once

#include "hooke/core/simd.h"
#include "hooke/core/types.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {

/// Four faces, one in each lane. All but `flat` are columns of one entry a lane.
struct FaceSprings {
  static constexpr double min_length = 1e-9;  // of the face's target: a zero edge has a force, not a NaN

  // What is asked:
  double corners[9 * lane_count];      // x, y, z of each corner
  double edge_target[3 * lane_count];  // of the edge across from each corner
  double has_edge[3 * lane_count];     // 1 where that edge counts with this face, else 0
  double face_target[lane_count];
  double has_face[lane_count];  // 1; 0 in a lane without a face, which must hold the numbers of another

  // What is found:
  double energy;                    // of all four, the weights included
  double gradient[9 * lane_count];  // by each corner
  bool flat;                        // a face has no area to speak of: energy and gradient mean nothing
};

/// `string` and `altitude` weigh the terms U(l; L_e) / L_e^2 and U(h; h0) / h0^2, h0 = (sqrt 3 / 2) L_f.
void evaluate_face_springs(double string, double altitude, FaceSprings& faces);

// The energy that relaxation minimises: springs on edges, on altitudes and on corner angles, all under the
// modified Hooke's law [4], each measured in parts of its own rest length. Its negative gradient is the
// force.

struct FaceSprings;

/// Weights of the terms; a term with weight 0 costs nothing.
struct EnergyTerms {
  double string = 1;           // lambda: U(l; L_e) / L_e^2 per edge [2]-[4]
  double altitude = 1;         // beta: U(h; h0) / h0^2 per altitude h < h0 = (sqrt 3 / 2) L_f
  double angle = 0;            // w: U(theta; t) / t^2 per corner angle theta < t
  double angle_threshold = 0;  // t, radians, below pi / 2
  double unfold = 0;           // weight of 3/2 ((d - s) / d)^2 for faces with alignment < d; replaces the
                               // altitude and angle terms of such a face
  double unfold_below = .3;    // d
};

class Energy {
 public:
  /// Keeps references to the connectivity and the targets.
  Energy(const Adjacency& adjacency, const TargetLengths& targets, const EnergyTerms& terms);

  /// Energy of the vertices at these points, `normals` those of the surface there, per side: they count as
  /// constant. With `gradient` also its gradient by the points.
  double operator()(const Mat3X& points, const Mat3X& normals, Mat3X* gradient);

  const TargetLengths& targets() const { return targets_; }

  EnergyTerms terms;

 private:
  struct Points {
    const Mat3X& points;
    const Mat3X& normals;
  };
  double energy_of_four(const Points& at, size_t face, double* corner_gradients) const;
  void gather_faces(const Points& at, size_t face, size_t count, FaceSprings& four) const;
  double face_energy(const Points& at, size_t face, double* corner_gradients) const;

  /// Faces whose gradients are added up together, and the vertices among which all their corners are.
  struct Part {
    size_t begin, end;
    int first_vertex, last_vertex;
  };
  void add_corner_gradients(const Part& part, Mat3X& gradient) const;

  const Adjacency& adjacency_;
  const TargetLengths& targets_;
  std::vector<Part> parts_;
  std::vector<double> corner_gradients_;  // 9 per face of a part: gradient by each of its corners
};

}  // namespace hooke
