// Ids of vertices and faces that stand in another order than in the mesh they belong to.
#pragma once

#include <span>

#include "hooke/core/lists.h"
#include "hooke/core/types.h"

namespace hooke {

/// By their place in that order; without a list they are the places themselves. Keeps no copy of the lists.
struct MeshIds {
  std::span<const int> vertices = {}, faces = {};

  int vertex(int v) const { return vertices.empty() ? v : vertices[static_cast<std::size_t>(v)]; }
  Triangle corners(const Triangle& t) const { return {vertex(t[0]), vertex(t[1]), vertex(t[2])}; }
  int face(int f) const { return faces.empty() ? f : faces[static_cast<std::size_t>(f)]; }
};

// Order in memory: neighbours on the mesh become neighbours in the arrays.

/// order[new] = old vertex id: clusters grown breadth-first over the mesh, so that a ring mostly lies within
/// one cluster. Depends on the connectivity only, never on coordinates: a moved or turned mesh has the same
/// order.
std::vector<int> bfs_cluster_order(int vertex_count, const std::vector<Triangle>& faces);

/// A mesh in another order, and the way back.
struct Permutation {
  std::vector<int> old_vertex;  // of a new one
  std::vector<int> old_face;    // of a new one; faces follow their smallest vertex
  std::vector<Triangle> faces;  // in new vertex ids

  MeshIds old_ids() const& { return {old_vertex, old_face}; }
  MeshIds old_ids() const&& = delete;  // they would outlive the lists

  /// The new ids of these old vertices.
  std::vector<int> new_vertices(const std::vector<int>& old) const;

  /// What belongs to the vertices, from the one order to the other.
  Mat3X gather(const Eigen::Ref<const Mat3X>& old) const;
  std::vector<double> gather(const std::vector<double>& old) const;
  Mat3X scatter(const Mat3X& fresh) const;
  std::vector<double> scatter(const std::vector<double>& fresh) const;

  /// Faces in new vertex ids and new order, as they were.
  std::vector<Triangle> scatter(const std::vector<Triangle>& fresh) const;
};
Permutation reorder(std::vector<Triangle> faces, const std::vector<int>& order);

}  // namespace hooke
