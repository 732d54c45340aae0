// Acceptance per vertex: what a step may do to each face and edge, and the step that obeys.
#pragma once

#include "hooke/retraction.h"
#include "hooke/sizing.h"

namespace hooke {

struct GuardOptions {
  double area_ratio = .2;  // a face keeps at least this part of its area in a step
  double alignment = .3;   // least cosine between a face and the surface under it; below, it may only grow
  double fold = .1;        // least cosine between two neighbouring faces; below, it may only grow
  double sagitta = .2;     // greatest sagitta of an edge over its target length; above, it may only shrink
  double slack = 1e-7;     // by which a cosine may still fall, or a sagitta over its target length rise
  int max_halvings = 8;    // of a vertex's step, before it stands still for this step
};

/// Cosine between the face and the sum of the surface normals at its corners; 0 without area.
double face_alignment(const Mat3X& points, const Mat3X& normals, const Triangle& face);

/// Sagitta (l / 2) tan(theta / 4) of a circular arc over a chord of length l whose ends' normals differ by
/// theta.
double edge_sagitta(const Mat3X& points, const Mat3X& normals, const Edge& edge);

/// Cosine between the normals of two faces; 1 where one has no area.
double cosine_between(const Mat3X& points, const Triangle& face, const Triangle& other);

/// What the guards look at around one vertex: its faces, its edges, and the edges across from it in its
/// faces.
struct RingMeasures {
  std::vector<double> area, alignment, sagitta, fold;
};

/// Judges steps against the last accepted placement. Keeps references to the connectivity and the targets.
class Guards {
 public:
  Guards(const Connectivity& connectivity, const TargetLengths& targets, const GuardOptions& options);

  /// Makes the placement the one that steps are judged against.
  void accept(const Placement& placement);

  /// to = from + displacement, retracted and obeying the guards: offending vertices halve their steps, then
  /// stand still; `displacement` becomes what was asked for in the end. `from` must be the accepted
  /// placement. Returns the vertices that were held back.
  std::vector<int> step(Retraction& retraction, const Placement& from, Mat3X& displacement, Placement& to);

  /// The vertices of all faces and edges that break a guard in `trial`, ascending.
  std::vector<int> offenders(const Placement& trial) { return offenders_among_all(trial); }

  /// Makes the outcome of the last step() the accepted placement.
  void accept_step() { std::swap(accepted_, trial_); }

  /// The same rules for one vertex that moves alone.
  void measure_ring(const Placement& placement, int vertex, RingMeasures& measures) const;
  bool ring_obeys(int vertex, const RingMeasures& before, const RingMeasures& after) const;

  /// Faces of the accepted placement that lie against the surface (alignment below the threshold).
  std::vector<int> folded_faces() const;

 private:
  bool face_breaks(double area_before, double area, double alignment_before, double alignment) const;
  bool face_breaks(size_t face) const;
  bool sagitta_breaks(size_t edge, double before, double after) const;
  bool fold_breaks(double before, double after) const;
  bool edge_breaks(size_t edge) const;
  double fold_at(const Mat3X& points, size_t edge) const;
  size_t opposite_edge(int face, int vertex) const;
  void add_offenders(size_t edge, std::vector<int>& vertices) const;
  void measure_face(const Placement& placement, size_t face);
  void measure_edge(const Placement& placement, size_t edge);
  std::vector<int> offenders_among_all(const Placement& trial);
  std::vector<int> offenders_around(const Placement& trial, const std::vector<int>& moved);

  const Connectivity& connectivity_;
  const TargetLengths& targets_;
  GuardOptions options_;
  struct Measures {
    std::vector<double> area, alignment;  // per face
    std::vector<double> sagitta, fold;    // per edge
  };
  Measures accepted_, trial_;
};

}  // namespace hooke
