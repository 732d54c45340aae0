// Candidate changes of one edge (flip, split, collapse): which are topologically allowed, how each is applied
// to a patch around the edge and to the whole mesh, and whether the relaxed patch is better afterwards.
#pragma once

#include "hooke/geometry/local_shape.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/patch.h"

namespace hooke {

struct WorkingMesh;

// Quality of a patch.

/// Maximum length of an edge after a change, over its target length, unless it was longer before.
inline constexpr double max_length_near_slivers = 1.7;
/// Maximum sagitta of an edge after a change, over its target length, unless it was more before.
inline constexpr double max_sagitta_near_slivers = .5;

/// How far a patch exceeds the limits.
struct PatchViolation {
  double alignment = 0, fold = 0, sagitta = 0;  // sums over faces and edges
  double length = 0;                            // of the longest edge
  int folds = 0;                                // number of faces and edges beyond alignment or fold
};

/// Is each violation at most what it was before?
bool is_no_worse(const PatchViolation& now, const PatchViolation& before);

struct PatchQuality {
  double angle_cost = 0;     // degrees squared
  double length_errors = 0;  // sum of the squares of l / L_e - 1
  std::size_t edges = 0;
  double cotangent = 0;  // of the minimum angle
  double area = 0;       // covered on the surface: areas of the faces, projected along the surface normals
  PatchViolation violation;
};

/// Measures a patch. A face with a smaller minimum angle than `fair_angle`, degrees, costs the squared
/// difference. `limits`: of alignment, fold and sagitta. Pre-condition: the adjacency has no creases.
PatchQuality measure_patch(const SurfacePositions& positions, const Adjacency& adjacency,
                           const TargetLengths& targets, double fair_angle, const ShapeLimits& limits);

// Changes of an edge.

enum class ChangeKind {
  flip,      // the edge joins the two opposite vertices instead
  split,     // a new vertex at the midpoint
  collapse,  // one end is merged into the other
};

struct EdgeChange {
  int half_edge;
  ChangeKind kind;
  int stays = 0;  // of a collapse: the remaining end, the start (0) or the end (1) of the half-edge
  bool to_midpoint = false;  // of a collapse: the remaining vertex moves to the midpoint
};

/// Which changes are considered besides flips.
struct ChangeRules {
  int valence = 9;  // maximum valence of a vertex that gains edges
  bool splits = true, collapses = true;
};

/// One half-edge of each inner edge of the faces around the corners of this face, ascending.
std::vector<int> inner_edges_about(const HalfedgeMesh& halfedges, int face);

/// The changes of an inner edge that preserve the topology and creases and respect the valence limits; a
/// corner may miss its target valence by one, but not by a collapse into it. Angles and folds are left to
/// CandidateEvaluator. Vertices on feature curves are neither added nor removed.
std::vector<EdgeChange> allowed_changes(const WorkingMesh& mesh, int half_edge, const ChangeRules& rules);

/// Applies the change to the vertices of the patch of its edge, with new positions projected to the surface;
/// a split appends a vertex. Returns the faces of the changed patch.
std::vector<Triangle> change_patch(EdgePatch& patch, const EdgeChange& change, const Surface& surface,
                                   const RetractionOptions& options);

/// Applies the change to the mesh and gives its vertices the positions in the changed patch.
void change_mesh(WorkingMesh& mesh, const EdgeChange& change, EdgePatch& patch);

// Evaluation of candidates.

/// A change of an edge with its patch, at some stage of its evaluation.
struct EdgeCandidate {
  EdgeChange change{};
  EdgePatch patch{};
  PatchQuality before{};
  Adjacency adjacency{};  // of the changed patch, as are the targets
  TargetLengths targets{};
  double gain = 0;         // degrees squared: decrease of the cost so far
  bool is_viable = false;  // after begin(): worth going on; after finish(): worth keeping
};

/// Tests changes of edges, each in its own copy of the patch around the edge. The cost of a patch, in degrees
/// squared, is the sum over its faces of the squared shortfall of the minimum angle from the sliver angle
/// plus a margin, and over its edges of the weighted (l / L_e - 1)^2. Does not modify the mesh, so changes
/// can be tested in parallel. Keeps references to the mesh and the terms. Projections are not counted.
class CandidateEvaluator {
 public:
  /// `limits`: of alignment and fold, those of all steps.
  CandidateEvaluator(const WorkingMesh& mesh, const EnergyTerms& terms, const ShapeLimits& limits);

  /// Sets the sliver angle, degrees: faces with a smaller angle are slivers from now on.
  void set_sliver_angle(double sliver_angle);

  /// Cuts and changes the patch and relaxes its springs. Pre-condition: set_sliver_angle().
  EdgeCandidate begin(const EdgeChange& change) const;

  /// Searches for better positions of the vertices and accepts the result if it lowers the cost of the patch,
  /// keeps its minimum angle and its covered surface, and increases no violation of the limits.
  void finish(EdgeCandidate& candidate) const;

 private:
  EdgeCandidate cut(const EdgeChange& change) const;
  PatchQuality quality_before(const EdgePatch& patch) const;
  template <typename Relax>
  PatchQuality relax(EdgeCandidate& candidate, const Relax& body) const;
  double gain(const PatchQuality& before, const PatchQuality& now) const;

  const WorkingMesh& m_;
  const EnergyTerms& terms_;
  ShapeLimits limits_;
  double fair_angle_ = 0;  // degrees
};

/// Would the patch, with these faces and its present positions, violate the fold limits along
/// its boundary or along a crease within it?
bool folds_at_patch_boundary(const EdgePatch& patch, const std::vector<Triangle>& faces,
                             const WorkingMesh& mesh, const ShapeLimits& limits);

}  // namespace hooke
