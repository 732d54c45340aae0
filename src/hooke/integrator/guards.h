// Guards: steps of vertices, shortened one by one until each face and edge keeps the limits of its shape.
#pragma once

#include "hooke/geometry/local_shape.h"

namespace hooke {

struct Adjacency;
struct SurfacePositions;
class Retraction;
class Stopwatch;
struct TargetLengths;

/// Tests displacements by their effect on each face and edge, with the normals of the wedge on the same side
/// of a crease. Measures lazily: most steps respect the absolute limits, whatever the state before. Keeps
/// references to the adjacency and the targets.
class Guards {
 public:
  Guards(const Adjacency& adjacency, const TargetLengths& targets, const ShapeLimits& limits)
      : adjacency_(adjacency), targets_(targets), limits_(limits) {}

  /// to = from + displacement, projected and within the guards: offending vertices halve their displacement,
  /// and finally stay. On return `displacement` holds what was applied. Returns the vertices that were
  /// limited.
  std::vector<int> step(Retraction& retraction, const SurfacePositions& from, Mat3X& displacement,
                        SurfacePositions& to, Stopwatch* stopwatch = nullptr) const;

  /// The vertices of all faces and edges for which a guard breaks between `from` and `to`, ascending.
  std::vector<int> offenders(const SurfacePositions& from, const SurfacePositions& to) const;

  /// The same around the vertices `moved`, when no others moved.
  std::vector<int> offenders_around(const SurfacePositions& from, const SurfacePositions& to,
                                    const std::vector<int>& moved) const;

  const ShapeLimits& limits() const { return limits_; }

  /// Faces whose alignment with the surface is below the limit, ascending.
  std::vector<int> folded_faces(const SurfacePositions& positions) const;

  /// The vertices of faces and edges at or beyond a limit, ascending. The angle limit does not count.
  std::vector<int> vertices_at_limits(const SurfacePositions& positions) const;

 private:
  double alignment(const SurfacePositions& positions, size_t face) const;
  double sagitta(const SurfacePositions& positions, size_t edge) const;
  double fold(const SurfacePositions& positions, size_t edge) const;
  bool face_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t face) const;
  bool fold_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t edge) const;
  bool edge_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t edge) const;
  void add_corners(int face, std::vector<int>& vertices) const;
  void add_vertices_around(int edge, bool folds, std::vector<int>& vertices) const;

  const Adjacency& adjacency_;
  const TargetLengths& targets_;
  ShapeLimits limits_;
};

}  // namespace hooke
