// The faces about an edge, before it collapses and after.
#pragma once

#include <boost/container/small_vector.hpp>

#include <optional>

#include "hooke/filter/retraction.h"

namespace hooke {

struct WorkingMesh;
class HalfedgeMesh;

/// The worst of what guards look at.
struct WorstShape {
  double cotangent = 0;  // of the least angle of a face
  double alignment = 1;  // least cosine between a face and the surface
  double fold = 1;       // least cosine between neighbouring faces that no crease parts
  double sagitta = 0;    // of an edge, over its target length
};

WorstShape worse_of(const WorstShape& a, const WorstShape& b);
bool is_within(const WorstShape& worst, const WorstShape& limits);

/// Of the faces at both ends of the edge, their edges and what is across these.
WorstShape worst_about(const WorkingMesh& mesh, int half_edge);

/// The faces that stay when the edge collapses, as they will be about the vertex that stays: each with
/// columns of its own for its corners, of which that vertex is the first. Keeps a reference to the mesh.
class CollapsedRing {
 public:
  CollapsedRing(const WorkingMesh& mesh, int half_edge, int stays);

  /// Of these faces with the vertex at the place, their edges there and what is across their sides.
  WorstShape worst(const SurfacePosition& place);

 private:
  struct Face {
    int spoke;                         // half-edge of the mesh from the first corner
    int wedge;                         // of the first corner
    double first_target, last_target;  // lengths, of the edges to the second corner and from the third
    bool has_beyond;                   // is there a face across from the first corner, and no crease between?
    Vec3 beyond;                       // its doubled area vector
    int next;                          // the face that shares the last edge; -1 if a crease parts them
  };

  void add_face(int spoke, int wedge);
  void copy_corners();
  void put(const SurfacePosition& place);
  int face_after(const Face& face) const;
  void look_at_face(size_t face, WorstShape& worst) const;
  void look_at_edge(size_t face, int corner, double target, WorstShape& worst) const;

  const WorkingMesh& m_;
  const HalfedgeMesh& t_;
  int stays_;
  boost::container::small_vector<Face, 16> faces_;
  boost::container::small_vector<Vec3, 16> areas_;  // doubled area vectors
  Mat3X points_, normals_;
};

// One edge collapse: may it be, and where does the vertex that stays come to lie?

struct CollapseOptions {
  double shortest = .8;  // of an edge over its target length; shorter ones collapse
  /// Of an edge over its target length that a collapse may leave, unless there was one as long at its ends;
  /// before the vertex that stays goes back to the surface.
  double longest = 4. / 3;
  int valence = 9;        // greatest valence of the vertex that stays
  double angle = 10;      // degrees; least angle about the vertex that stays, unless there was a smaller one
  double alignment = .3;  // least cosine between a new face and the surface, unless an old one had less
  double fold = .1;       // least cosine between neighbouring faces, unless two old ones had less
  double sagitta = .2;    // greatest sagitta of an edge over its target length, unless an old one had more
  bool insist_on_alignment = false;  // even where an old face had less
};

struct Collapse {
  int half_edge;
  int stays;              // the vertex of the edge that does
  SurfacePosition place;  // where
};

/// Of the vertex that stays.
int valence_after(const WorkingMesh& mesh, int half_edge);

/// Nothing where the edge may not collapse: where that changes the topology, where a guard forbids it, where
/// it takes a vertex off its curve or an edge from a curve that has no more than it wants. A vertex that is
/// less free stays where it is; of two alike that of the input stays, in the middle of the edge if the guards
/// allow it, else at one of its ends.
/// The mesh is only looked at: edges may be tried at the same time, and of those without a vertex or
/// neighbour in common all may be made that pass, but for what their curves want. Projections are not
/// counted.
/// Pre-condition: the edges of the curves are counted.
std::optional<Collapse> find_collapse(const WorkingMesh& mesh, int half_edge, const CollapseOptions& options);

/// Makes a collapse that has passed its trial.
void make_collapse(WorkingMesh& mesh, const Collapse& collapse);

/// Both: merges the ends of the edge and returns the vertex that stays, -1 where that is not allowed.
int collapse_edge(WorkingMesh& mesh, int half_edge, const CollapseOptions& options);

/// The curve of the edge has more edges than it wants, or the edge has no curve.
bool curve_may_lose(const WorkingMesh& mesh, int half_edge);

}  // namespace hooke
