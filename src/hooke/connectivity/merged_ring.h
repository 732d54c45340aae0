// The faces about an edge, before it collapses and after.
#pragma once

#include <boost/container/small_vector.hpp>

#include "hooke/working_mesh/adapting_mesh.h"

namespace hooke {

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
WorstShape worst_about(const AdaptingMesh& mesh, int half_edge);

/// The faces that stay when the edge collapses, as they will be about the vertex that stays: each with
/// columns of its own for its corners, of which that vertex is the first. Keeps a reference to the mesh.
class MergedRing {
 public:
  MergedRing(const AdaptingMesh& mesh, int half_edge, int stays);

  /// Of these faces with the vertex at the place, their edges there and what is across their sides.
  WorstShape worst(const VertexPlace& place);

 private:
  struct Face {
    int spoke;                         // half-edge of the mesh from the first corner
    int side;                          // of the first corner
    double first_target, last_target;  // lengths, of the edges to the second corner and from the third
    bool has_beyond;                   // is there a face across from the first corner, and no crease between?
    Vec3 beyond;                       // its doubled area vector
    int next;                          // the face that shares the last edge; -1 if a crease parts them
  };

  void add_face(int spoke, int side);
  void copy_corners();
  void put(const VertexPlace& place);
  int face_after(const Face& face) const;
  void look_at_face(size_t face, WorstShape& worst) const;
  void look_at_edge(size_t face, int corner, double target, WorstShape& worst) const;

  const AdaptingMesh& m_;
  const Triangulation& t_;
  int stays_;
  boost::container::small_vector<Face, 16> faces_;
  boost::container::small_vector<Vec3, 16> areas_;  // doubled area vectors
  Mat3X points_, normals_;
};

}  // namespace hooke
