// The surface over facets that are too long for a spline through the vertices: as on the side of a cylinder
// whose only vertices lie on its two rims. Each facet is curved by the normals at its corners, and rises no
// more than the arcs over its edges.
// T. Boubekeur, M. Alexa, "Phong tessellation", 2008.
#pragma once

#include <memory>
#include <optional>

#include "hooke/filter/surface.h"
#include "hooke/geometry/aabb_tree.h"
#include "hooke/mesh/sagitta.h"

namespace hooke {

/// Refers to points, normals and adjacency, which must outlive it. Thread-safe.
class CurvedFacets {
 public:
  /// Height of another surface over a point of a face, tracked at the vertex `hint`: its signed distance, NaN
  /// if unknown.
  using HeightOver = std::function<double(const Vec3& point, int hint)>;

  /// The facets over which another surface, a spline through the vertices, rises more than a smooth surface
  /// may. Only facets that are long compared with the spacing of the vertices, or
  /// turn much at an edge, are tested: elsewhere splines keep to the mesh. Null if there are none.
  static std::unique_ptr<const CurvedFacets> where_exceeded(const Mat3X& points, const Mat3X& normals,
                                                            const Adjacency& adjacency,
                                                            const HeightOver& height);

  /// All facets, which are flat.
  static std::unique_ptr<const CurvedFacets> all_flat(const Mat3X& points, const Mat3X& normals,
                                                      const Adjacency& adjacency);

  /// The point closest to x on the facets and the faces next to them, of the same component as the vertex
  /// `hint`, those on the opposite side of a thin body aside; face -1 if there is none.
  ClosestPoint find(const Vec3& x, int hint) const;

  /// Is the face, one of these, a facet that the surface is made of?
  bool is_curved(int face) const { return facet_of(face).is_curved; }

  /// Is there a facet, and may a smooth surface pass it at the distance of its closest point?
  bool allows(const ClosestPoint& closest) const;

  /// The point of the curved facet over a point of it.
  Projection lift(const ClosestPoint& point) const;

  /// May a point tracked at the vertex lie over one of these facets?
  bool is_near(int vertex) const { return near_[vertex] != 0; }

  std::size_t memory_bytes() const;

 private:
  CurvedFacets(const Mat3X& points, const Mat3X& normals, const Adjacency& adjacency,
               const std::vector<char>& curved, const std::vector<EdgeArc>& arcs,
               const std::vector<double>& rises);
  /// A face of the tree.
  struct Facet {
    int face;
    int component;
    bool is_curved;
    double max_rise;              // of a smooth surface over it and the faces around
    Vec3 normal;                  // unit
    std::array<EdgeArc, 3> arcs;  // of edge k, which joins corners k and k + 1
  };

  const Facet& facet_of(int face) const { return facets_[facet_of_face_[face]]; }
  double rise_at(const Facet& facet, const Vec3& at) const;

  const Mat3X& points_;
  const Mat3X& normals_;
  const Adjacency& adjacency_;
  std::vector<char> near_;          // per vertex
  std::vector<char> is_tip_;        // per vertex: do the faces come to a point there?
  std::vector<int> components_;     // per vertex
  std::vector<int> facet_of_face_;  // -1 for faces that are none
  std::vector<Facet> facets_;       // the curved ones and those around
  std::optional<AabbTree> tree_;
};

}  // namespace hooke
