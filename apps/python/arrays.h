// Meshes as numpy arrays, and their vertex data.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>

#include "hooke/mesh/attributes.h"
#include "hooke/mesh/valid_mesh.h"

namespace hooke::python {

/// n x 3 coordinates and m x 3 vertex ids, row by row.
using PointArray = pybind11::array_t<double, pybind11::array::c_style>;
using FaceArray = pybind11::array_t<std::int32_t, pybind11::array::c_style>;

/// Copies of the rows.
Mat3X points_of(const PointArray& vertices);
std::vector<Triangle> triangles_of(const FaceArray& faces);

/// Arrays of a mesh, in the order of its ids; sheets are joined, see mesh/junctions.h.
PointArray vertex_array(const TriMesh& mesh);
FaceArray face_array(const TriMesh& mesh);

/// Where vertices lie on the input: old ids (n), faces (n) and weights (n x 3).
pybind11::tuple map_arrays(const std::vector<MapEntry>& map);

/// Vertex data as a dict from names to arrays of their types, and the way back. Throws Error for arrays that
/// do not have one number for each of `count` vertices, or a type that no file has.
pybind11::dict attribute_arrays(const VertexData& data);
VertexData vertex_data_of(const pybind11::dict& attributes, std::size_t count);

}  // namespace hooke::python
