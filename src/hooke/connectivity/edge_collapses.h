// Edge collapses: the quality of the faces around an edge before and after, whether a collapse is allowed,
// and where the remaining vertex is placed; and passes over the whole mesh, of edges that are too short and
// of edges at folded faces.
#pragma once

#include <boost/container/small_vector.hpp>

#include <optional>

#include "hooke/filter/retraction.h"
#include "hooke/geometry/local_shape.h"

namespace hooke {

struct WorkingMesh;
class HalfedgeMesh;

/// The worst shape of the faces around both ends of the edge, including folds with the faces next to them.
LocalShape worst_about(const WorkingMesh& mesh, int half_edge);

/// The one-ring of the remaining vertex after the collapse of an edge. Each face has its own three columns of
/// corner positions, that vertex first. Keeps a reference to the mesh.
class CollapsedRing {
 public:
  CollapsedRing(const WorkingMesh& mesh, int half_edge, int stays);

  /// The worst shape of these faces, their edges at the vertex and the folds with the faces next to them, if
  /// the vertex is at this position.
  LocalShape worst(const SurfacePosition& position);

  /// Distance of x to these faces, with the vertex at the last position.
  double distance(const Vec3& x) const;

 private:
  struct Face {
    int outgoing;                      // outgoing half-edge of the mesh at the first corner
    int wedge;                         // of the first corner
    double first_target, last_target;  // target lengths of the edges to the second corner and from the third
    bool has_neighbour;                // is there a face opposite the first corner, across no crease?
    Vec3 neighbour_area;               // doubled area vector of that face
    int next;                          // the face that shares the last edge; -1 across a feature edge
  };

  void add_face(int outgoing, int wedge);
  void copy_corners();
  void set_position(const SurfacePosition& position);
  int face_after(const Face& face) const;

  const WorkingMesh& m_;
  const HalfedgeMesh& t_;
  int stays_;
  boost::container::small_vector<Face, 16> faces_;
  boost::container::small_vector<Vec3, 16> areas_;  // doubled area vectors
  Mat3X points_, normals_;
};

struct CollapseOptions {
  double shortest = .8;  // edge length over target length; shorter edges collapse
  /// Maximum edge length over target length after a collapse, unless an edge at its ends was as long already;
  /// measured before the remaining vertex is projected to the surface.
  double longest = 4. / 3;
  int valence = 9;  // maximum valence of the remaining vertex
  /// On the one-ring of the remaining vertex; worse is admitted where it was as bad before.
  ShapeLimits limits{.cotangent = cotangent_of(10)};
  /// Maximum distance of the two vertices from the faces after the collapse, in target lengths: keeps tips.
  double distance = .3;
  bool insist_on_alignment = false;  // apply the alignment limit even where it was violated before
};

struct Collapse {
  int half_edge;
  int stays;                 // the remaining vertex, an end of the edge
  SurfacePosition position;  // of that vertex after the collapse
};

/// The valence of the remaining vertex.
int valence_after(const WorkingMesh& mesh, int half_edge);

/// The collapse of the edge, or nothing if it is not allowed: if it changes the topology, violates a limit of
/// the options, takes a vertex off its feature curve, or leaves a curve or a corner with fewer edges than its
/// target; with a very short edge a corner may have one edge less where the least angle rises. The more
/// constrained vertex remains, in its position; of two with equal freedom that of the input remains, at the
/// midpoint of the edge if the limits allow it, else at one of its ends. Does not modify the mesh, so edges
/// can be tested in parallel; the collapses found for edges without a vertex or neighbour in common can all
/// be made, except that may_remove_curve_edge() must be asked again. Projections are not counted.
/// Pre-condition: count_curve_edges().
std::optional<Collapse> find_collapse(const WorkingMesh& mesh, int half_edge, const CollapseOptions& options);

/// Do the limits allow the collapse of the edge into this end at this position? Looks neither at constraints
/// nor at curves, and at the topology only of the sheet in which the edge is.
bool may_collapse_to(const WorkingMesh& mesh, int half_edge, int stays, const SurfacePosition& position,
                     const CollapseOptions& options);

/// Makes a collapse that find_collapse() returned.
void make_collapse(WorkingMesh& mesh, const Collapse& collapse);

/// Finds and makes the collapse. Returns the remaining vertex, -1 if no collapse is allowed.
int collapse_edge(WorkingMesh& mesh, int half_edge, const CollapseOptions& options);

/// Does the curve of the edge have more edges than its target, or does the edge lie on no known curve?
bool may_remove_curve_edge(const WorkingMesh& mesh, int half_edge);

/// Collapses edges until none is too short or no further collapse is allowed. Works in batches of edges
/// without a common neighbour, the shortest first, except for edges that become shorter during a batch. That
/// spreads the collapses: strictly the shortest first, spheres of 222 vertices end with edges that vary by 7
/// % instead of 6 % in mode `adapt`. Returns the number of collapses.
int collapse_short_edges(WorkingMesh& mesh, const CollapseOptions& options = {});

/// Removes folded faces (alignment with the surface below the limit), which vertex motion cannot unfold: for
/// each, collapses the first of its edges or of the edges at its corners that looser limits allow. Returns
/// the number of collapses.
int collapse_folded_faces(WorkingMesh& mesh);

}  // namespace hooke
