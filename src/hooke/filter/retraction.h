// Motion on the surface: tangent vectors, and the way back after a step along one.
#pragma once

#include <span>
#include <utility>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/surface.h"

namespace hooke {

/// How the vertices sit on the surface and its curves. Where creases part the surface, normals and hints go
/// on after those of the vertices with those of their further sides.
struct SurfacePositions {
  Mat3X points;
  Mat3X normals;                 // unit, outward, of the surface; per side
  std::vector<int> hints;        // where on the surface each side is tracked
  std::vector<int> segments;     // where on its curve
  std::vector<double> drift;     // length moved since the last projection
  std::vector<int> other_wedge;  // of a vertex on a crease, -1 without one; empty without creases

  int other_wedge_of(int vertex) const {
    return other_wedge.empty() ? -1 : other_wedge[static_cast<size_t>(vertex)];
  }
};

/// One vertex of a placement. Where more than two sides meet the vertex stands still: it has no more than two
/// here.
struct SurfacePosition {
  Vec3 point;
  Vec3 normal;
  int hint;
  int segment;
  double drift;
  int other_wedge;  // -1 without
  Vec3 other_normal = Vec3::Zero();
  int other_hint = -1;

  SurfacePosition(const SurfacePositions& positions, int vertex);
  void write_to(SurfacePositions& positions, int vertex) const;
};

/// Calls and failures of the projection.
struct ProjectionCounts {
  long long calls = 0;
  long long evaluations = 0;
  std::array<long long, 5> by_status{};  // indexed by ProjectionStatus

  ProjectionCounts& operator+=(const ProjectionCounts& other);
};

struct RetractionOptions {
  double tolerance = 1e-6;  // of a projection, in mean target lengths
  /// A vertex that moved less than this since its last projection follows the bend of the surface, where that
  /// takes it no farther off than `lazy_error`; elsewhere its tangent plane, for a way of .1.
  double lazy = 0;
  double lazy_error = 1e-3;
};

/// Keeps references to the surface and the constraints: they must outlive it.
class Retraction {
 public:
  Retraction(Surface surface, const Constraints& constraints, const RetractionOptions& options);

  /// Puts every point on the surface or its curve. `hints` are those of all sides.
  SurfacePositions place(const Mat3X& points, std::vector<int> hints, std::vector<int> segments);

  /// to = retract(from + displacement) for the given vertices; all other entries of `to` stay.
  void step(const SurfacePositions& from, const Mat3X& displacement, std::span<const int> vertices,
            SurfacePositions& to);

  /// The same for all vertices; `to` is resized.
  void step(const SurfacePositions& from, const Mat3X& displacement, SurfacePositions& to);

  /// Where one vertex comes to lie; safe to call for different vertices at once. Call count() after a batch.
  SurfacePosition moved(const SurfacePositions& from, int vertex, const Vec3& displacement);

  /// Of a vertex that is yet to come, free on the surface, which starts where this one is, with this hint.
  SurfacePosition moved_copy(const SurfacePositions& from, int vertex, int hint, const Vec3& displacement);

  /// Adds the projections since the last call to counts().
  void count();

  /// Projects the vertices that have drifted.
  void project_drifted(SurfacePositions& positions);

  /// Projects these vertices, each named once.
  void project_drifted(std::span<const int> vertices, SurfacePositions& positions);

  /// Unit, of the curve along which the vertex slides; zero for all others.
  Vec3 tangent(const SurfacePositions& at, int vertex) const;

  /// Removes what a vertex may not do: the normal part, all but the part along its curve, or everything.
  void constrain(const SurfacePositions& at, Mat3X& vectors) const;

  /// To be called when the constraints have come to be of another number of vertices, or to be ready for as
  /// many.
  void resize(size_t vertices);

  const ProjectionCounts& counts() const { return counts_; }
  bool stands_still(int vertex) const;

  /// Sets the option from now on; returns what it was.
  double set_lazy_error(double error) { return std::exchange(options_.lazy_error, error); }

  const Surface& surface() const { return surface_; }
  const RetractionOptions& options() const { return options_; }

 private:
  SurfacePosition moved(SurfacePosition place, int vertex, Freedom freedom, const Vec3& displacement);
  Vec3 within_deviation_bound(const Vec3& point, int vertex) const;
  CurveProjection foot_on_curve(const Vec3& point, int segment, int vertex) const;
  SurfacePosition on_curve(SurfacePosition place, int vertex) const;
  SurfacePosition on_surface(SurfacePosition place, int vertex, Freedom freedom);
  SurfacePosition projected(SurfacePosition place, int vertex);
  SurfacePosition drifted(SurfacePosition place, const Vec3& way, const ShapeOperator& bend,
                          Freedom freedom) const;
  Projection projection(const Vec3& point, int hint, int vertex);

  Surface surface_;
  const Constraints& constraints_;
  RetractionOptions options_;
  std::vector<long long> uncounted_;  // tallies of groups of vertices, one after the other
  ProjectionCounts counts_;
};

}  // namespace hooke
