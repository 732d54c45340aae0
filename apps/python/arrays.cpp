#include "arrays.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/mesh/junctions.h"

namespace py = pybind11;

namespace hooke::python {
namespace {

/// The names that numpy has for the types, in the order of NumberType.
constexpr std::array number_types = {"int8",  "uint8",  "int16",   "uint16",
                                     "int32", "uint32", "float32", "float64"};

py::object as_type(const py::array_t<double>& values, NumberType type) {
  return values.attr("astype")(number_types[static_cast<size_t>(type)]);
}

NumberType type_of(const std::string& name, const py::array& values) {
  const auto type = py::cast<std::string>(values.dtype().attr("name"));
  const auto* const found = std::ranges::find(number_types, type);
  if (found == number_types.end())
    throw Error("attribute '" + name + "' of type " + type +
                "; expected an integer of at most 32 bits, float32 or float64; convert it with astype()");
  return static_cast<NumberType>(found - number_types.begin());
}

}  // namespace

Mat3X points_of(const PointArray& vertices) {
  return Eigen::Map<const Mat3X>(vertices.data(), 3, vertices.shape(0));
}

std::vector<Triangle> triangles_of(const FaceArray& faces) {
  std::vector<Triangle> triangles(faces.shape(0));
  static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t));
  if (!triangles.empty()) std::memcpy(triangles.data(), faces.data(), triangles.size() * sizeof(Triangle));
  return triangles;
}

PointArray vertex_array(const TriMesh& mesh) {
  const auto array_of = [](const Eigen::Ref<const Mat3X>& points) {
    PointArray array({static_cast<py::ssize_t>(points.cols()), py::ssize_t{3}});
    Eigen::Map<Mat3X>(array.mutable_data(), 3, points.cols()) = points;
    return array;
  };
  if (const auto joined = join_sheets(mesh)) return array_of(joined->gather(vertex_points(mesh)));
  return array_of(vertex_points(mesh));
}

FaceArray face_array(const TriMesh& mesh) {
  const std::optional<JoinedMesh> joined = join_sheets(mesh);
  const std::vector<Triangle> triangles = joined ? joined->triangles : hooke::triangles_of(mesh);
  FaceArray array({std::ssize(triangles), py::ssize_t{3}});
  if (!triangles.empty())
    std::memcpy(array.mutable_data(), triangles.data(), triangles.size() * sizeof(Triangle));
  return array;
}

py::tuple map_arrays(const std::vector<MapEntry>& map) {
  const auto count = std::ssize(map);
  py::array_t<std::int32_t> vertices(count), faces(count);
  PointArray weights({count, py::ssize_t{3}});
  for (py::ssize_t v = 0; v < count; ++v) {
    const MapEntry& entry = map[v];
    vertices.mutable_at(v) = entry.vertex;
    faces.mutable_at(v) = entry.position.face;
    for (py::ssize_t k = 0; k < 3; ++k) weights.mutable_at(v, k) = entry.position.weights[k];
  }
  return py::make_tuple(vertices, faces, weights);
}

py::dict attribute_arrays(const VertexData& data) {
  py::dict attributes;
  for (const VertexChannel& channel : data)
    attributes[py::str(channel.name)] =
        as_type(py::array_t<double>(std::ssize(channel.values), channel.values.data()), channel.type);
  return attributes;
}

VertexData vertex_data_of(const py::dict& attributes, std::size_t count) {
  VertexData data;
  for (const auto& [key, value] : attributes) {
    const auto name = py::cast<std::string>(key);
    const auto array = py::array::ensure(value);
    if (!array || array.ndim() != 1 || std::cmp_not_equal(array.shape(0), count))
      throw Error("attribute '" + name + "'; expected a number for each of the " + std::to_string(count) +
                  " vertices");
    const NumberType type = type_of(name, array);
    const auto numbers = py::cast<py::array_t<double, py::array::c_style | py::array::forcecast>>(array);
    data.push_back({name, type, {numbers.data(), numbers.data() + count}});
  }
  return data;
}

}  // namespace hooke::python
