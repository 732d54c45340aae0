#include "hooke/mesh.h"

#include <fmt/format.h>

#include "hooke/error.h"

namespace hooke {

namespace {

void add_faces(TriMesh& mesh, const std::vector<Triangle>& triangles) {
  for (size_t f = 0; f < triangles.size(); ++f) {
    const auto& [a, b, c] = triangles[f];
    const auto face = mesh.add_face(mesh.vertex_handle(static_cast<unsigned>(a)),
                                    mesh.vertex_handle(static_cast<unsigned>(b)),
                                    mesh.vertex_handle(static_cast<unsigned>(c)));
    if (!face.is_valid() || face.idx() != static_cast<int>(f))
      throw MeshError(fmt::format("face {} ({} {} {}) does not fit a manifold mesh", f, a, b, c));
  }
}

}  // namespace

TriMesh build_mesh(const Mat3X& points, const std::vector<Triangle>& triangles) {
  TriMesh mesh;
  const auto vertices = static_cast<size_t>(points.cols());
  mesh.reserve(vertices, vertices + triangles.size() + 2, triangles.size());
  for (Eigen::Index i = 0; i < points.cols(); ++i) mesh.add_vertex(points.col(i));
  add_faces(mesh, triangles);
  return mesh;
}

void replace_faces(TriMesh& mesh, const std::vector<Triangle>& triangles) {
  mesh.resize(mesh.n_vertices(), 0, 0);
  for (const auto v : mesh.vertices()) mesh.set_isolated(v);
  add_faces(mesh, triangles);
}

Eigen::Map<Mat3X> positions(TriMesh& mesh) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const auto n = static_cast<Eigen::Index>(mesh.n_vertices());
  return {n ? mesh.point(mesh.vertex_handle(0)).data() : nullptr, 3, n};
}

Eigen::Map<const Mat3X> positions(const TriMesh& mesh) {
  const auto n = static_cast<Eigen::Index>(mesh.n_vertices());
  return {n ? mesh.points()->data() : nullptr, 3, n};
}

Eigen::Map<Mat3X> as_matrix(TriMesh& mesh, const VProp<Vec3>& property) {
  const auto n = static_cast<Eigen::Index>(mesh.n_vertices());
  auto& storage = mesh.property(property.getRawProperty());
  return {n ? storage.data_vector().data()->data() : nullptr, 3, n};
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
  for (const auto v : mesh.vertices()) stored[v] = values[static_cast<size_t>(v.idx())];
}

std::vector<Triangle> triangles_of(const TriMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.n_faces());
  for (const auto face : mesh.faces()) {
    auto corner = mesh.cfv_begin(face);
    const int a = (corner++)->idx();
    const int b = (corner++)->idx();
    triangles.push_back({a, b, corner->idx()});
  }
  return triangles;
}

}  // namespace hooke
