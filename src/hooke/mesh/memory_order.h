// Memory order: vertices and faces are renumbered so that neighbours on the mesh are neighbours in the
// arrays.
#pragma once

#include <span>

#include "hooke/core/lists.h"
#include "hooke/core/types.h"

namespace hooke {

/// Mesh ids of vertices and faces that are stored in another order, by their index in that order; without
/// lists the ids are the indices. Refers to the lists, which must outlive it.
struct MeshIds {
  std::span<const int> vertices = {}, faces = {};

  int vertex(int v) const { return vertices.empty() ? v : vertices[v]; }
  Triangle corners(const Triangle& t) const { return {vertex(t[0]), vertex(t[1]), vertex(t[2])}; }
  int face(int f) const { return faces.empty() ? f : faces[f]; }
};

/// order[new] = old vertex id: clusters grown breadth-first over the mesh, so that a ring mostly lies within
/// one cluster. Depends on the faces only, never on coordinates: a moved or rotated mesh has the same order.
std::vector<int> bfs_cluster_order(int vertex_count, const std::vector<Triangle>& faces);

/// A mesh in another order, and the mapping back to its old order.
struct Permutation {
  std::vector<int> old_vertex;  // old id of each new vertex
  std::vector<int> old_face;    // old id of each new face; faces are sorted by their smallest vertex
  std::vector<Triangle> faces;  // in new vertex ids

  MeshIds old_ids() const& { return {old_vertex, old_face}; }
  MeshIds old_ids() const&& = delete;  // the result would outlive the lists

  /// The new ids of these old vertices.
  std::vector<int> new_vertices(const std::vector<int>& old) const;

  /// The edges between the new ids of these pairs of old vertices.
  std::vector<Edge> new_edges(const std::vector<Edge>& old) const;

  /// Vertex data from the old order to the new one (gather) and back (scatter).
  Mat3X gather(const Eigen::Ref<const Mat3X>& old) const;
  std::vector<double> gather(const std::vector<double>& old) const;
  Mat3X scatter(const Mat3X& fresh) const;
  std::vector<double> scatter(const std::vector<double>& fresh) const;

  /// Faces given in new vertex ids and new order, in old ids and old order.
  std::vector<Triangle> scatter(const std::vector<Triangle>& fresh) const;
};

/// Renumbers the vertices: new vertex i is the old one order[i].
Permutation reorder(std::vector<Triangle> faces, const std::vector<int>& order);

}  // namespace hooke
