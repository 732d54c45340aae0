#include "hooke/mesh/mesh.h"

#include <fmt/format.h>

#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr size_t mesh_block = 4096;

using OpenMesh::HalfedgeHandle, OpenMesh::FaceHandle, OpenMesh::VertexHandle;

/// OpenMesh's half-edge along edge k of the face.
HalfedgeHandle half_edge(const Adjacency& c, size_t face, size_t k) {
  const size_t edge = c.face_edges[face][k];
  const bool along = c.edge_faces[edge][0] == static_cast<int>(face);
  return HalfedgeHandle(static_cast<int>(2 * edge + (along ? 0 : 1)));
}

void link_inside(const Adjacency& c, const MeshIds& ids, TriMesh& mesh) {
  parallel_for(c.faces.size(), mesh_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const FaceHandle face(ids.face(static_cast<int>(f)));
      for (size_t k = 0; k < 3; ++k) {
        const HalfedgeHandle h = half_edge(c, f, k);
        mesh.set_vertex_handle(h, VertexHandle(ids.vertex(c.faces[f][(k + 1) % 3])));
        mesh.set_face_handle(h, face);
        mesh.set_next_halfedge_handle(h, half_edge(c, f, (k + 1) % 3));
      }
      mesh.set_halfedge_handle(face, half_edge(c, f, 2));  // so that its circulators begin at corner 0
    }
  });
}

/// Sets the outgoing half-edge of each vertex; link_boundary() replaces it by the one without a face.
void link_vertices(const Adjacency& c, const MeshIds& ids, TriMesh& mesh) {
  parallel_for(c.vertex_count, mesh_block, [&](size_t begin, size_t end) {
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
      const VertexHandle vertex(ids.vertex(v));
      const auto ring = c.vertex_faces[v];
      if (ring.empty()) {
        mesh.set_isolated(vertex);
        continue;
      }
      const size_t f = ring.front();
      mesh.set_halfedge_handle(vertex, half_edge(c, f, corner_of(c.faces[f], v)));
    }
  });
}

void link_boundary(const Adjacency& c, const MeshIds& ids, TriMesh& mesh) {
  const auto end = [&](size_t e, size_t k) { return VertexHandle(ids.vertex(c.edges[e][k])); };
  const auto boundary = [&](size_t e) { return HalfedgeHandle(static_cast<int>(2 * e + 1)); };
  for (size_t e = 0; e < c.edges.size(); ++e) {
    if (!c.is_boundary_edge(static_cast<int>(e))) continue;
    mesh.set_vertex_handle(boundary(e), end(e, 0));
    mesh.set_boundary(boundary(e));
    mesh.set_halfedge_handle(end(e, 1), boundary(e));
  }
  for (size_t e = 0; e < c.edges.size(); ++e)
    if (c.is_boundary_edge(static_cast<int>(e)))
      mesh.set_next_halfedge_handle(boundary(e), mesh.halfedge_handle(end(e, 0)));
}

}  // namespace

TriMesh build_mesh(const Mat3X& points, const Adjacency& adjacency, const MeshIds& ids) {
  TriMesh mesh;
  mesh.resize(points.cols(), 0, 0);
  vertex_points(mesh) = points;
  replace_faces(mesh, adjacency, ids);
  return mesh;
}

TriMesh build_mesh(const Mat3X& points, const std::vector<Triangle>& triangles) {
  VertexFans fans = examine_fans(static_cast<int>(points.cols()), triangles);
  if (const int broken = first_broken(fans); broken >= 0)
    throw MeshError(fmt::format("the faces around vertex {} do not fit a manifold mesh", broken));
  return build_mesh(points, make_adjacency(triangles, std::move(fans)));
}

// Writes the arrays of the kernel directly: adding face by face would search the rings repeatedly.
void replace_faces(TriMesh& mesh, const Adjacency& adjacency, const MeshIds& ids) {
  mesh.resize(mesh.n_vertices(), 0, 0);  // properties of edges and faces go with them
  mesh.resize(mesh.n_vertices(), adjacency.edges.size(), adjacency.faces.size());
  link_inside(adjacency, ids, mesh);
  link_vertices(adjacency, ids, mesh);
  link_boundary(adjacency, ids, mesh);
}

Eigen::Map<Mat3X> vertex_points(TriMesh& mesh) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const auto n = static_cast<Eigen::Index>(mesh.n_vertices());
  return {n ? mesh.point(mesh.vertex_handle(0)).data() : nullptr, 3, n};
}

Eigen::Map<const Mat3X> vertex_points(const TriMesh& mesh) {
  const auto n = static_cast<Eigen::Index>(mesh.n_vertices());
  return {n ? mesh.points()->data() : nullptr, 3, n};
}

Eigen::Map<Mat3X> as_matrix(TriMesh& mesh, const VProp<Vec3>& property) {
  const auto n = static_cast<Eigen::Index>(mesh.n_vertices());
  auto& storage = mesh.property(property.getRawProperty());
  return {n ? storage.data_vector().data()->data() : nullptr, 3, n};
}

void set_vertex_vectors(TriMesh& mesh, const char* property, const Mat3X& values) {
  as_matrix(mesh, OpenMesh::getOrMakeProperty<OpenMesh::VertexHandle, Vec3>(mesh, property)) = values;
}

std::vector<double> vertex_values(const TriMesh& mesh, const char* property) {
  OpenMesh::VPropHandleT<double> handle;
  if (!mesh.get_property_handle(handle, property))
    throw Error(fmt::format("the mesh has no vertex property '{}'", property));
  return mesh.property(handle).data_vector();
}

void set_vertex_values(TriMesh& mesh, const char* property, double value) {
  auto values = OpenMesh::getOrMakeProperty<OpenMesh::VertexHandle, double>(mesh, property);
  for (const auto v : mesh.vertices()) values[v] = value;
}

void set_vertex_values(TriMesh& mesh, const char* property, const std::vector<double>& values) {
  auto stored = OpenMesh::getOrMakeProperty<OpenMesh::VertexHandle, double>(mesh, property);
  for (const auto v : mesh.vertices()) stored[v] = values[v.idx()];
}

namespace {

OpenMesh::EdgeHandle edge_between(const TriMesh& mesh, int v, int w) {
  return mesh.edge_handle(mesh.find_halfedge(VertexHandle(v), VertexHandle(w)));
}

}  // namespace

std::vector<double> edge_values(const TriMesh& mesh, const char* property, const Permutation& order,
                                const Adjacency& adjacency) {
  OpenMesh::EPropHandleT<double> handle;
  if (!mesh.get_property_handle(handle, property)) return {};
  const MeshIds ids = order.old_ids();
  std::vector<double> values(adjacency.edges.size());
  parallel_for(values.size(), mesh_block, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      const auto& [v, w] = adjacency.edges[e];
      values[e] = mesh.property(handle, edge_between(mesh, ids.vertex(v), ids.vertex(w)));
    }
  });
  return values;
}

void set_edge_values(TriMesh& mesh, const char* property, const Permutation& order,
                     const Adjacency& adjacency, const std::vector<double>& values) {
  auto stored = OpenMesh::getOrMakeProperty<OpenMesh::EdgeHandle, double>(mesh, property);
  const MeshIds ids = order.old_ids();
  for (size_t e = 0; e < values.size(); ++e) {
    const auto& [v, w] = adjacency.edges[e];
    stored[edge_between(mesh, ids.vertex(v), ids.vertex(w))] = values[e];
  }
}

std::vector<Triangle> triangles_of(const TriMesh& mesh) {
  std::vector<Triangle> triangles(mesh.n_faces());
  parallel_for(triangles.size(), mesh_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      auto corner = mesh.cfv_begin(FaceHandle(static_cast<int>(f)));
      for (int& v : triangles[f]) v = (corner++)->idx();
    }
  });
  return triangles;
}

MemoryOrder find_memory_order(int vertex_count, const std::vector<Triangle>& faces) {
  MemoryOrder memory_order{reorder(faces, bfs_cluster_order(vertex_count, faces)), nullptr};
  memory_order.adjacency = std::make_shared<const Adjacency>(
      make_adjacency(vertex_count, std::exchange(memory_order.order.faces, {})));
  return memory_order;
}

MemoryOrder find_memory_order(const TriMesh& mesh) {
  return find_memory_order(static_cast<int>(mesh.n_vertices()), triangles_of(mesh));
}

}  // namespace hooke
