// Acceptance per vertex: what a step may do to each face and edge, and the step that obeys.
#pragma once

#include "hooke/core/stopwatch.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/guard_rules.h"
#include "hooke/springs/sizing.h"

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

/// The same from the vectors of their areas.
double cosine_between(const Vec3& area_vector, const Vec3& other);

/// Judges steps by what they do to each face and edge, each on its own side of a crease. Measures what it
/// needs when it needs it: most steps stay within the absolute limits, whatever was before. Keeps references
/// to the connectivity and the targets.
class Guards {
 public:
  Guards(const Connectivity& connectivity, const TargetLengths& targets, const GuardOptions& options)
      : connectivity_(connectivity), targets_(targets), options_(options) {}

  /// to = from + displacement, retracted and obeying the guards: offending vertices halve their steps, then
  /// stand still; `displacement` becomes what was asked for in the end. Returns the vertices that were held
  /// back.
  std::vector<int> step(Retraction& retraction, const Placement& from, Mat3X& displacement, Placement& to,
                        Stopwatch* stopwatch = nullptr) const;

  /// The vertices of all faces and edges that break a guard on the way from one placement to the other,
  /// ascending.
  std::vector<int> offenders(const Placement& from, const Placement& to) const;

  /// Those about vertices that moved, where no others did.
  std::vector<int> offenders_around(const Placement& from, const Placement& to,
                                    const std::vector<int>& moved) const;

  const GuardOptions& options() const { return options_; }

  /// Faces that lie against the surface (alignment below the threshold), ascending.
  std::vector<int> folded_faces(const Placement& placement) const;

  /// The vertices of faces and edges that are at a limit or beyond it. Angles have none here.
  std::vector<int> vertices_at_limits(const Placement& placement) const;

 private:
  double alignment(const Placement& placement, size_t face) const;
  double sagitta(const Placement& placement, size_t edge) const;
  double fold(const Placement& placement, size_t edge) const;
  bool face_breaks(const Placement& from, const Placement& to, size_t face) const;
  bool fold_breaks(const Placement& from, const Placement& to, size_t edge) const;
  bool edge_breaks(const Placement& from, const Placement& to, size_t edge) const;
  void add_corners(int face, std::vector<int>& vertices) const;
  void add_vertices_about(int edge, bool folds, std::vector<int>& vertices) const;

  const Connectivity& connectivity_;
  const TargetLengths& targets_;
  GuardOptions options_;
};

}  // namespace hooke
