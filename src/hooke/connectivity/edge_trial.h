// How good the faces of a small mesh are, and what in it is beyond the limits of the guards.
#pragma once

#include "hooke/integrator/angle_search.h"
#include "hooke/integrator/guards.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/patch.h"

namespace hooke {

struct WorkingMesh;

struct PatchLimits {
  double fair_angle;  // degrees; a face with a smaller one costs the square of what it lacks
  double alignment;   // least cosine between a face and the surface
  double fold;        // least cosine between two neighbouring faces
  double sagitta;     // greatest of an edge, over its target length
  double longest;     // edge over its target length
};

/// What lies beyond the limits.
struct PatchViolation {
  double alignment = 0, fold = 0, sagitta = 0;  // sums over faces and edges
  double length = 0;                            // of the longest edge
  int folds = 0;                                // faces and edges
};

bool is_no_worse(const PatchViolation& now, const PatchViolation& before);

struct PatchQuality {
  double angle_cost = 0;     // degrees squared
  double length_errors = 0;  // sum of the squares of l / L_e - 1
  std::size_t edges = 0;
  double cotangent = 0;  // of the least angle
  double area = 0;       // of the surface that it covers: of faces as seen along the surface's normals
  PatchViolation excess;
};

/// Pre-condition: a connectivity without creases.
PatchQuality look_at(const SurfacePositions& positions, const Adjacency& adjacency,
                     const TargetLengths& targets, const PatchLimits& limits);

// What can become of an edge: which changes are allowed, and each of them in a patch and in the whole mesh.

enum class ChangeKind {
  flip,      // the edge comes to join the corners across it
  split,     // a new vertex halves it
  collapse,  // its ends become one vertex
};

struct EdgeChange {
  int half_edge;
  ChangeKind kind;
  int stays = 0;          // of a merge: the end where the half-edge begins (0) or ends (1)
  bool half_way = false;  // that end comes to the middle
};

/// The changes to choose from.
struct ChangeRules {
  int valence = 9;  // greatest of a vertex that gains edges
  bool splits = true, collapses = true;
};

/// One half-edge of each inner edge of the faces about the corners of this one, ascending.
std::vector<int> inner_edges_about(const HalfedgeMesh& halfedges, int face);

/// The changes of an inner edge that leave a mesh of the same topology, creases and corners included,
/// whatever becomes of angles and folds: that is for a trial to tell. Vertices on curves neither come nor go.
std::vector<EdgeChange> allowed_changes(const WorkingMesh& mesh, int half_edge, const ChangeRules& rules);

/// Puts the vertices of the patch of the edge where the change takes them, on the surface; a split adds one.
/// Returns the faces it has then.
std::vector<Triangle> change_patch(EdgePatch& patch, const EdgeChange& change, const Surface& surface,
                                   const RetractionOptions& options);

/// Changes the mesh as its patch was changed, and moves its vertices to where those of the patch are.
void change_mesh(WorkingMesh& mesh, const EdgeChange& change, EdgePatch& patch);

// Tries one change of an edge in a patch of its own: is the mesh better off there?

struct EdgeTrialOptions {
  double fair_margin =
      6;  // degrees; a face with less than so much more than a sliver costs the square of that
  double length_weight = 100;    // and an edge this many degrees squared times the square of l / L_e - 1
  double gain = 4;               // degrees squared; least fall of the cost of a patch for a change to be kept
  double max_energy_rise = 500;  // degrees squared; greatest rise of it by a change and its springs to go on
  int rings = 2;                 // around an edge, within which the vertices settle
  size_t most = 100;             // vertices that settle: no edge is tried about which there are more
  int sweeps = 3;                // of Newton's method vertex by vertex, for them to settle
  // What a change may leave, besides what is there; alignment and fold are those of the guards.
  double sagitta = .5;    // of an edge, over its target length
  double longest = 1.7;   // edge over its target length
  double area_loss = .2;  // of covered surface, over a mean target length squared: rims of thin sheets stay
  AngleSearchOptions search{.edge_error_limit = 1.2, .sagitta = 0, .max_rounds = 12};  // after the sweeps
};

struct EdgeCandidate {
  EdgeChange change{};
  EdgePatch patch{};
  PatchQuality before{};
  Adjacency adjacency{};  // of the patch once it is changed, as are these:
  TargetLengths targets{};
  double gain = 0;         // degrees squared: fall of the cost so far
  bool is_viable = false;  // is it worth going on or, at the end, worth keeping?
};

/// The mesh is only looked at: several changes may be tried at the same time. Keeps references to the mesh,
/// the terms and the options. Projections are not counted.
class EdgeTrials {
 public:
  EdgeTrials(const WorkingMesh& mesh, const EnergyTerms& terms, const EdgeTrialOptions& options,
             const GuardOptions& guards);

  /// Faces with a smaller angle than this, degrees, are slivers from now on.
  void begin_with(double sliver_angle);

  /// Changes the patch and lets its springs settle. Pre-condition: begin_with().
  EdgeCandidate begin(const EdgeChange& change) const;

  /// Searches for better places, and judges the outcome: it is to lower what the patch costs, to keep the
  /// least angle there and the surface that the faces cover, and to add nothing to what is beyond the limits.
  void finish(EdgeCandidate& trial) const;

 private:
  EdgeCandidate cut(const EdgeChange& change) const;
  PatchQuality look_before(const EdgePatch& patch) const;
  template <typename Relax>
  PatchQuality relax(EdgeCandidate& trial, const Relax& body) const;
  double gain(const PatchQuality& before, const PatchQuality& now) const;

  const WorkingMesh& m_;
  const EnergyTerms& terms_;
  const EdgeTrialOptions& options_;
  GuardOptions guards_;
  PatchLimits limits_{};
};

/// Would the patch, with these faces and its vertices where they are now, break the rule of folds with the
/// faces across its rim?
bool folds_at_rim(const EdgePatch& patch, const std::vector<Triangle>& faces, const FlippableMesh& mesh,
                  const GuardOptions& guards);

}  // namespace hooke
