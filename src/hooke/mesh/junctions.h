// Junctions: edges with three faces or more and vertices in which sheets only touch, as in surfaces of
// several materials. Such a mesh is worked on as manifold sheets of their own (see sheets.h), with copies of
// the vertices of the junctions, and is written with the copies joined again.
//
// In a list `joined`, entry v is the vertex that stands for v: the same one for all copies of a vertex, and v
// itself for a vertex without copies. An empty list stands for a mesh without junctions.
#pragma once

#include <optional>
#include <vector>

#include "hooke/mesh/attributes.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/topology.h"
#include "hooke/mesh/validation.h"

namespace hooke {

/// Name of the vertex property (int, optional) with the list `joined`, by vertex id; the vertex that stands
/// for copies is the first of them. All steps that take a mesh keep its junctions where it has the property.
inline constexpr char joined_property[] = "v:joined";

/// Sets v:joined. Pre-condition: one entry per vertex.
void set_joined_vertices(TriMesh& mesh, const std::vector<int>& joined);

/// The list of the mesh, by vertex id; empty without the property.
std::vector<int> joined_vertices(const TriMesh& mesh);

/// The same for the vertices in this order.
std::vector<int> joined_vertices(const TriMesh& mesh, const Permutation& order);

/// The faces with the copies of each vertex joined.
std::vector<Triangle> join_faces(std::vector<Triangle> faces, const std::vector<int>& joined);

/// Per vertex: the number of its shell, in the order of their first vertices; -1 for a vertex without faces.
/// A shell is a connected part of the joined mesh, with all its sheets.
std::vector<int> label_shells(const Adjacency& sheets, const std::vector<int>& joined);

struct Junctions {
  std::vector<Edge> edges;    // of the sheets, of which several are the same edge of the joined mesh; sorted,
                              // smaller end first
  std::vector<int> vertices;  // that have copies or are ends of these edges, ascending
};

/// The junctions of sheets. The joined mesh has the same edge in several sheets only there.
Junctions find_junctions(const Adjacency& sheets, const std::vector<int>& joined);

/// require_valid() for sheets, with places in the joined mesh, of which `source` tells.
Warnings require_valid_sheets(const Mat3X& points, const std::vector<Triangle>& sheets,
                              const std::vector<int>& joined, MeshSource source);

/// For each edge of the sheets whether it is the first of those that are the same edge of the joined mesh.
std::vector<char> first_of_joined(const Adjacency& sheets, const std::vector<int>& joined);

/// Topology and valences of the joined mesh. Vertices on no boundary edge count as interior.
Topology measure_topology(const Adjacency& sheets, const std::vector<int>& joined);
Valence count_valences(const Adjacency& sheets, const std::vector<int>& joined);

/// What of its junctions a result must keep: the edges and the number of their faces.
struct JunctionCounts {
  int edges = 0;   // of the joined mesh
  int curves = 0;  // from node to node, or closed
  int nodes = 0;   // vertices where other than two junction edges meet, or the number of faces changes
  std::vector<int> faces;  // entry k: the number of junction edges with k faces
  bool operator==(const JunctionCounts&) const = default;

  /// Are they the same curves, with as many faces, though their edges may be others?
  bool same_network(const JunctionCounts& other) const;
};

JunctionCounts count_junctions(const Adjacency& sheets, const std::vector<int>& joined);

/// The joined mesh of a mesh of sheets.
struct JoinedMesh {
  std::vector<int> vertices;        // ids in the sheets of the vertices that are left, ascending
  std::vector<int> id;              // per vertex of the sheets: its id in the joined mesh
  std::vector<Triangle> triangles;  // in ids of the joined mesh, in the order of the faces

  Mat3X gather(const Eigen::Ref<const Mat3X>& of_sheets) const;
  Mat3X scatter(const Mat3X& of_joined) const;

  /// Of normals the mean of the copies.
  VertexData gather(const VertexData& of_sheets) const;
};

/// Joins the sheets of the mesh; none if it has no v:joined. Throws ResultError if copies of a vertex lie in
/// different places.
std::optional<JoinedMesh> join_sheets(const TriMesh& sheets);

}  // namespace hooke
