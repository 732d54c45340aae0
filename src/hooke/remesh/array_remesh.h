// Remeshing of plain arrays, one row per vertex and one per face, as many libraries have them.
#pragma once

#include "hooke/mesh/valid_mesh.h"
#include "hooke/remesh/preserving_remesh.h"
#include "hooke/springs/sizing.h"

namespace hooke {

/// The result of remeshing arrays.
struct RemeshedArrays {
  Eigen::MatrixX3d vertices;  // n x 3: coordinates, in the unit of the input
  Eigen::MatrixX3i faces;     // m x 3: vertex ids, 0-based, counter-clockwise as seen from outside
  RemeshResult result;        // with the measures of input and result, and where vertices come from
  Warnings warnings;          // of the input, see require_valid()
};

/// The mesh of a matrix of points and a matrix of faces, shaped as in RemeshedArrays. Throws MeshError as
/// make_valid_mesh() does.
ValidMesh mesh_from_arrays(const Eigen::MatrixX3d& vertices, const Eigen::MatrixX3i& faces);

/// Remeshes n x 3 points and m x 3 faces, see RemeshedArrays, as preserving_remesh() does with a mesh: with
/// the default options vertices and faces keep their number and order, and the faces themselves. `length` is
/// the target edge length, in the unit of the points unless it is a multiple of the natural length (the
/// default: the edges of as many equilateral triangles of the same area, of each part of the mesh; in mode
/// `adapt` never longer than that of the whole mesh) or a percentage of the box's diagonal. The result may
/// break promises only in mode `adapt`: see result.measures->preservation. The observer is called on this
/// thread; it stops the run by returning false, which leaves the mesh reached so far. Throws MeshError if the
/// arrays are no oriented manifold mesh with area, LimitError or NumericalError if the surface cannot be
/// fitted.
RemeshedArrays preserving_remesh(const Eigen::MatrixX3d& vertices, const Eigen::MatrixX3i& faces,
                                 const RemeshOptions& options = {}, LengthSpec length = {},
                                 const PreservationOptions& preservation = {},
                                 const Observer& observer = nullptr);

}  // namespace hooke
