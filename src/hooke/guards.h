// Acceptance per vertex: what a step may do to each face and edge, and the step that obeys.
#pragma once

#include "hooke/guard_rules.h"
#include "hooke/retraction.h"
#include "hooke/sizing.h"
#include "hooke/stopwatch.h"

namespace hooke {

/// Cosine between the face and the sum of the surface normals at its corners; 0 without area. `sides` are the
/// columns of the corners' normals.
double face_alignment(const Mat3X& points, const Mat3X& normals, const Triangle& face, const Triangle& sides);

/// The same away from creases, where the corners are the columns.
inline double face_alignment(const Mat3X& points, const Mat3X& normals, const Triangle& face) {
  return face_alignment(points, normals, face, face);
}

/// Sagitta (l / 2) tan(theta / 4) of a circular arc over a chord of length l whose ends' normals differ by
/// theta. `sides` are the columns of the ends' normals.
double edge_sagitta(const Mat3X& points, const Mat3X& normals, const Edge& edge, const Edge& sides);

inline double edge_sagitta(const Mat3X& points, const Mat3X& normals, const Edge& edge) {
  return edge_sagitta(points, normals, edge, edge);
}

/// Cosine between the normals of two faces; 1 where one has no area.
double cosine_between(const Mat3X& points, const Triangle& face, const Triangle& other);

/// Judges steps against the last accepted placement. Each face and edge is measured on its own side of a
/// crease. Keeps references to the connectivity and the targets.
class Guards {
 public:
  Guards(const Connectivity& connectivity, const TargetLengths& targets, const GuardOptions& options);

  /// Makes the placement the one that steps are judged against.
  void accept(const Placement& placement);

  /// to = from + displacement, retracted and obeying the guards: offending vertices halve their steps, then
  /// stand still; `displacement` becomes what was asked for in the end. `from` must be the accepted
  /// placement. Returns the vertices that were held back.
  std::vector<int> step(Retraction& retraction, const Placement& from, Mat3X& displacement, Placement& to,
                        Stopwatch* stopwatch = nullptr);

  /// The vertices of all faces and edges that break a guard in `trial`, ascending.
  std::vector<int> offenders(const Placement& trial) { return offenders_among_all(trial); }

  /// Makes the outcome of the last step() the accepted placement.
  void accept_step() { std::swap(accepted_, trial_); }

  const GuardOptions& options() const { return options_; }

  /// Faces of the accepted placement that lie against the surface (alignment below the threshold).
  std::vector<int> folded_faces() const;

  /// The vertices of faces and edges that are at a limit, in the accepted placement, or beyond it. Angles
  /// have none here.
  std::vector<int> vertices_at_limits() const;

 private:
  bool face_breaks(size_t face) const;
  bool fold_breaks(size_t edge) const;
  bool edge_breaks(size_t edge) const;
  double fold_at(size_t edge) const;
  void add_offenders(size_t edge, std::vector<int>& vertices) const;
  void measure_face(const Placement& placement, size_t face);
  void measure_edge(const Placement& placement, size_t edge);
  std::vector<int> offenders_among_all(const Placement& trial);
  std::vector<int> offenders_around(const Placement& trial, const std::vector<int>& moved);

  const Connectivity& connectivity_;
  const TargetLengths& targets_;
  GuardOptions options_;
  struct Measures {
    std::vector<double> area, alignment, cotangent;  // per face; cotangents only where they are limited
    std::vector<double> sagitta, fold;               // per edge
  };
  Measures accepted_, trial_;
  Mat3X area_vector_;  // doubled, per face, of what was measured last
};

}  // namespace hooke
