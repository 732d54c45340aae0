// The mesh: an OpenMesh TriMesh in double precision with Eigen points, viewed as matrices for computations.
//
// OpenMesh's are the mesh that is read, handed to remesh() and back, and its properties: target lengths, and
// after remesh() forces and velocities; and the mesh that the damped integrator steps. What is done to all
// vertices over and over reads flat arrays (mesh/adjacency.h) in memory order instead of circulators: string
// forces take a fifth of their time in the order of a file, half of it in memory order
// (tests/bench/kernels.cpp: forces_by_circulators, forces_by_arrays).
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
inline constexpr char velocity_property[] = "v:velocity";  // Vec3, u of [17]; zero where nothing has one
inline constexpr char force_property[] = "v:force";  // Vec3, of [17] in motion, see set_residual_forces()
inline constexpr char target_length_property[] =
    "v:target_length";  // double; the target of an edge is the mean of its ends
inline constexpr char edge_length_property[] =
    "e:target_length";  // double, optional; the targets of the edges, each by itself
inline constexpr char rest_ratio_property[] =
    "e:rest_ratio";  // double, optional; by which the targets of the vertices are multiplied, fixed faces
                     // only

/// Builds a mesh from points, by vertex id, and an adjacency, whose vertices and faces get these ids; edges
/// keep theirs.
TriMesh build_mesh(const Mat3X& points, const Adjacency& adjacency, const MeshIds& ids = {});

/// Builds a mesh from triangles that need not be valid. Throws MeshError unless they are manifold and
/// consistently oriented (mesh/validation.h tells more).
TriMesh build_mesh(const Mat3X& points, const std::vector<Triangle>& triangles);

/// Replaces the faces of the mesh. Vertices keep their ids, points and properties; the properties of edges
/// and faces are reset. `ids` as for build_mesh(). Pre-condition: the adjacency has as many vertices.
void replace_faces(TriMesh& mesh, const Adjacency& adjacency, const MeshIds& ids = {});

/// The points as a 3 x |V| matrix over the storage of the mesh. Invalidated when vertices are added or
/// removed.
Eigen::Map<Mat3X> vertex_points(TriMesh& mesh);
Eigen::Map<const Mat3X> vertex_points(const TriMesh& mesh);

/// A Vec3 vertex property as a 3 x |V| matrix over the storage of the mesh. Invalidated as above.
Eigen::Map<Mat3X> as_matrix(TriMesh& mesh, const VProp<Vec3>& property);

/// Sets a Vec3 vertex property to these values, by vertex id, 3 x |V|; it is added if missing.
void set_vertex_vectors(TriMesh& mesh, const char* property, const Mat3X& values);

/// The values of a vertex property of doubles, by vertex id. Throws Error if the mesh does not have it.
std::vector<double> vertex_values(const TriMesh& mesh, const char* property);

/// Sets a vertex property of doubles to the same value everywhere; it is added if missing.
void set_vertex_values(TriMesh& mesh, const char* property, double value);

/// Sets a vertex property of doubles to these values, by vertex id; it is added if missing.
void set_vertex_values(TriMesh& mesh, const char* property, const std::vector<double>& values);

/// The values of an edge property of doubles, by the edges of the adjacency, whose vertices are in this
/// order; empty if the mesh does not have it.
std::vector<double> edge_values(const TriMesh& mesh, const char* property, const Permutation& order,
                                const Adjacency& adjacency);

/// Sets an edge property of doubles to these values; it is added if missing. As above.
void set_edge_values(TriMesh& mesh, const char* property, const Permutation& order,
                     const Adjacency& adjacency, const std::vector<double>& values);

/// Vertex ids of every face, in face order.
std::vector<Triangle> triangles_of(const TriMesh& mesh);

/// The order in which a mesh is stored while it is optimized and measured, whatever the order of its file.
struct MemoryOrder {
  Permutation order;  // relative to the mesh; its faces are moved to the adjacency
  std::shared_ptr<const Adjacency> adjacency;
};

/// The memory order of a mesh, and its adjacency in that order. Pre-condition as for make_adjacency().
MemoryOrder find_memory_order(int vertex_count, const std::vector<Triangle>& faces);
MemoryOrder find_memory_order(const TriMesh& mesh);

}  // namespace hooke
