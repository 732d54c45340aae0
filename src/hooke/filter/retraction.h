// Retraction: motion of vertices along tangent vectors, followed by the projection back to the surface.
#pragma once

#include <span>
#include <utility>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/surface.h"

namespace hooke {

/// Positions of all vertices on the surface and its curves. Normals and hints are per wedge: those of the
/// extra wedges follow those of the vertices.
struct SurfacePositions {
  Mat3X points;
  Mat3X normals;                 // unit outward normals of the surface, per wedge
  std::vector<int> hints;        // per wedge: reference vertex where its projection starts to search
  std::vector<int> segments;     // per vertex: segment of its curve
  std::vector<double> drift;     // per vertex: length moved since the last projection
  std::vector<int> other_wedge;  // per vertex: its second wedge, -1 without one; empty without creases

  int other_wedge_of(int vertex) const { return other_wedge.empty() ? -1 : other_wedge[vertex]; }
};

/// Surface position of one vertex. It holds at most two wedges: vertices with more stand still.
struct SurfacePosition {
  Vec3 point;
  Vec3 normal;
  int hint;
  int segment;
  double drift;
  int other_wedge;  // -1 without one
  Vec3 other_normal = Vec3::Zero();
  int other_hint = -1;

  SurfacePosition(const SurfacePositions& positions, int vertex);
  void write_to(SurfacePositions& positions, int vertex) const;
};

struct RetractionOptions {
  double tolerance = 1e-6;  // of a projection, in mean target lengths
  /// A vertex that moved less than this since its last projection is not projected. It follows the shape
  /// operator of the surface if that keeps it within `lazy_error` of the surface; otherwise it stays in its
  /// tangent plane, for at most 0.1. All three are lengths in mean target lengths.
  double lazy = 0;
  double lazy_error = 1e-3;
};

/// Moves vertices on the surface under their constraints. Keeps a reference to the constraints, which must
/// outlive it; so must all that the surface refers to.
class Retraction {
 public:
  Retraction(Surface surface, const Constraints& constraints, const RetractionOptions& options);

  /// Projects every point to the surface or its curve. `hints` are per wedge, `segments` per vertex.
  SurfacePositions project_all(const Mat3X& points, std::vector<int> hints, std::vector<int> segments);

  /// to = retract(from + displacement) for the given vertices; all other entries of `to` are unchanged. The
  /// copies of a junction vertex that slides all follow the displacement of the first, and must be given
  /// together.
  void step(const SurfacePositions& from, const Mat3X& displacement, std::span<const int> vertices,
            SurfacePositions& to);

  /// The same for all vertices; `to` is resized.
  void step(const SurfacePositions& from, const Mat3X& displacement, SurfacePositions& to);

  /// The position of a copy of a junction vertex after a displacement of all copies along their curve. With
  /// the same one of them as `first` all get the same point, bit by bit. Thread-safe like moved().
  SurfacePosition slid(const SurfacePositions& from, int copy, int first, const Vec3& displacement);

  /// The position of one vertex after a displacement. Thread-safe for different vertices; call count() after
  /// a batch.
  SurfacePosition moved(const SurfacePositions& from, int vertex, const Vec3& displacement);

  /// The same for a new vertex, free on the surface, that starts at the position of `vertex` in its `wedge`.
  SurfacePosition moved_copy(const SurfacePositions& from, int vertex, int wedge, const Vec3& displacement);

  /// Adds the projections made since the last call to counts().
  void count();

  /// Projects the vertices that have drifted since their last projection.
  void project_drifted(SurfacePositions& positions);

  /// Projects these vertices. Pre-condition: each is listed once.
  void project_drifted(std::span<const int> vertices, SurfacePositions& positions);

  /// Unit tangent of the curve along which the vertex slides, by itself or with its copies; zero for all
  /// other vertices.
  Vec3 tangent(const SurfacePositions& at, int vertex) const;

  /// Removes what the constraints forbid: the normal part for a vertex on the surface, all but the tangential
  /// part on a curve, everything for a fixed vertex. Copies that slide together get the mean of theirs.
  void constrain(const SurfacePositions& at, Mat3X& vectors) const;

  /// Adapts to another number of vertices in the constraints. To be called when it has changed, or beforehand
  /// with the largest number to come.
  void resize(size_t vertices);

  const ProjectionCounts& counts() const { return counts_; }
  bool stands_still(int vertex) const;

  /// Sets options().lazy_error; returns the previous value.
  double set_lazy_error(double error) { return std::exchange(options_.lazy_error, error); }

  const Surface& surface() const { return surface_; }
  const Constraints& constraints() const { return constraints_; }
  const RetractionOptions& options() const { return options_; }

 private:
  SurfacePosition moved(SurfacePosition position, int vertex, Freedom freedom, const Vec3& displacement);
  SurfacePosition stepped(const SurfacePositions& from, const Mat3X& displacement, int vertex,
                          const std::vector<int>& first);
  Vec3 within_max_travel(const Vec3& point, int vertex) const;
  const Curve* curve_of(int vertex) const;
  SurfacePosition on_curve(SurfacePosition position, int vertex) const;
  SurfacePosition on_surface(SurfacePosition position, int vertex, Freedom freedom);
  SurfacePosition projected(const SurfacePosition& position, int vertex);
  SurfacePosition drifted(SurfacePosition position, const Vec3& displacement,
                          const ShapeOperator& shape_operator, Freedom freedom) const;
  Projection projection(const Vec3& point, int hint, int vertex);

  Surface surface_;
  const Constraints& constraints_;
  RetractionOptions options_;
  std::vector<long long> uncounted_;  // counters per group of vertices, end to end
  ProjectionCounts counts_;
};

}  // namespace hooke
