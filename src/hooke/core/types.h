// Basic types of the whole library: points, triangles, edges, scalar fields and warnings.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace hooke {

using Vec3 = Eigen::Vector3d;
using Mat3X = Eigen::Matrix3Xd;  // one column per vertex

using Triangle = std::array<int, 3>;  // vertex ids, counter-clockwise as seen from outside
using Edge = std::array<int, 2>;      // vertex ids

/// Index of the vertex among the corners of the face, or of an edge among its edges. Pre-condition: it is one
/// of them.
inline std::size_t corner_of(const Triangle& face, int vertex) {
  return face[0] == vertex ? 0 : face[1] == vertex ? 1 : 2;
}

inline bool uses_a_vertex_twice(const Triangle& face) {
  return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

/// The same number for both directions of an edge.
inline std::uint64_t edge_key(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

/// The 32-bit float closest to a number, or the number itself beyond the range of floats; of all coordinates.
inline double rounded_to_float(double x) {
  const bool is_in_range = std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max());
  return is_in_range ? static_cast<double>(static_cast<float>(x)) : x;
}
inline Mat3X rounded_to_floats(const Eigen::Ref<const Mat3X>& points) {
  return points.unaryExpr(&rounded_to_float);
}

/// Value and gradient of a scalar field at a point.
struct FieldSample {
  double value = 0;
  Vec3 gradient = Vec3::Zero();
};

/// A field psi whose zero level set is the surface [11]. `hint` is a vertex of the fitted mesh near the
/// point; it distinguishes sheets that are close in space. Fields without sheets ignore it.
using ScalarField = std::function<FieldSample(const Vec3& point, int hint)>;

/// A warning to the user, with a code that scripts can test.
struct Warning {
  std::string code;     // e.g. "polygons_triangulated"
  std::string message;  // one line; names the file and the location in it, if there is one
};
using Warnings = std::vector<Warning>;

/// A change that was made to the input, with a code that scripts can test.
struct Note {
  std::string code;       // e.g. "duplicate_faces_dropped"
  std::size_t count = 0;  // how often
  std::string message;    // one line; names the file, the count and the first places
};
using Notes = std::vector<Note>;

inline void append(Warnings& warnings, const Warnings& more) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

}  // namespace hooke
