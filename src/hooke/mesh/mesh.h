// The mesh: an OpenMesh TriMesh in double precision with Eigen points, seen as matrices where we compute.
#pragma once

#include <memory>

// vector_traits.hh must come before EigenVectorT.hh, which specialises what it declares.
#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>
//
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/memory_order.h"

namespace hooke {

struct MeshTraits : OpenMesh::DefaultTraitsDouble {
  using Point = Vec3;
  using Normal = Vec3;
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

template <typename T>
using VProp = OpenMesh::PropertyManager<OpenMesh::VPropHandleT<T>>;

/// Names of the vertex properties that live on the mesh.
inline constexpr char velocity_property[] = "v:velocity";  // Vec3, u of [17]
inline constexpr char force_property[] = "v:force";        // Vec3, lambda F_string + mu F_torque
inline constexpr char target_length_property[] =
    "v:target_length";  // double; an edge wants the mean of its ends

/// Mesh from points, by vertex id, and a connectivity, of which vertices and faces have these ids in the mesh
/// and edges their own.
TriMesh build_mesh(const Mat3X& points, const Adjacency& adjacency, const MeshIds& ids = {});

/// The same from triangles, which need not have been looked at before. Throws MeshError unless they are
/// manifold and consistently oriented (validation.h tells more).
TriMesh build_mesh(const Mat3X& points, const std::vector<Triangle>& triangles);

/// Gives the mesh other faces on the same vertices, which keep their ids, points and properties. Properties
/// of edges and faces start anew. `ids` as for build_mesh(). Pre-condition: as many vertices.
void replace_faces(TriMesh& mesh, const Adjacency& adjacency, const MeshIds& ids = {});

/// The points as a 3 x |V| matrix over the mesh's own storage. Dies when vertices are added or removed.
Eigen::Map<Mat3X> vertex_points(TriMesh& mesh);
Eigen::Map<const Mat3X> vertex_points(const TriMesh& mesh);

/// A Vec3 vertex property as a 3 x |V| matrix over the mesh's own storage. Same life as above.
Eigen::Map<Mat3X> as_matrix(TriMesh& mesh, const VProp<Vec3>& property);

/// A vertex property of doubles, by vertex id. Pre-condition: the mesh has it.
std::vector<double> vertex_values(const TriMesh& mesh, const char* property);

/// Gives every vertex the same value of a property of doubles, which is added where it is missing.
void set_vertex_values(TriMesh& mesh, const char* property, double value);

/// Gives every vertex its own value of a property of doubles, by vertex id; it is added where it is missing.
void set_vertex_values(TriMesh& mesh, const char* property, const std::vector<double>& values);

/// Vertex ids of every face, in face order.
std::vector<Triangle> triangles_of(const TriMesh& mesh);

// How a mesh lies in memory while we work on it and measure it, however its file has it.

struct MemoryOrder {
  Permutation order;  // against the mesh; without its faces, which the connectivity has
  std::shared_ptr<const Adjacency> adjacency;
};

/// In memory order.
MemoryOrder find_memory_order(const TriMesh& mesh);

}  // namespace hooke
