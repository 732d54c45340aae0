// Parts of a mesh that can be remeshed by themselves: some of its shells (see mesh/junctions.h).
#pragma once

#include <vector>

#include "hooke/constraints/constraint_options.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/result.h"

namespace hooke {

/// Some shells of a mesh, as a mesh of their own.
struct PartOfMesh {
  std::vector<int> vertices, faces;  // their ids in the whole mesh, ascending
  TriMesh mesh;                      // with target lengths and junctions
  ConstraintOptions constraints;     // those of the whole that are about the part
};

/// The parts of a mesh. `part_of_vertex`: by id the number of its part, from 0, or -1 for none; the same for
/// all vertices of a shell.
std::vector<PartOfMesh> parts_of_mesh(const TriMesh& whole, const ConstraintOptions& constraints,
                                      const std::vector<int>& part_of_vertex);

/// A result of mode `adapt`, without its measures.
struct RemeshedMesh {
  const TriMesh& mesh;
  const RemeshResult& result;  // with its map
};

/// A result of a part, with ids of its vertices and faces, without counts of what was done.
struct PartOfResult {
  TriMesh mesh;
  RemeshResult result;
};

/// What a result of the whole mesh, which has a map, tells of each part.
std::vector<PartOfResult> parts_of_result(const std::vector<PartOfMesh>& parts, const TriMesh& mesh,
                                          const RemeshResult& result);

/// Puts the results of some parts in the places of these in a result of the whole mesh. Vertices of the input
/// come in their order, new ones follow. What was done is counted together; the records of iterations, the
/// rescue and the target number of faces stay those of the whole.
/// Pre-conditions: both have maps; no two parts have a vertex in common.
void replace_parts(const std::vector<PartOfMesh>& parts, const std::vector<RemeshedMesh>& of_parts,
                   TriMesh& mesh, RemeshResult& result);

}  // namespace hooke
