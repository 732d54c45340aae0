// The few types that everything speaks in.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <string>
#include <vector>

namespace hooke {

using Vec3 = Eigen::Vector3d;
using Mat3X = Eigen::Matrix3Xd;  // one column per vertex

using Triangle = std::array<int, 3>;  // vertex ids, counter-clockwise seen from outside
using Edge = std::array<int, 2>;      // vertex ids

/// Value and gradient of a scalar field at a point.
struct FieldSample {
  double value = 0;
  Vec3 gradient = Vec3::Zero();
};

/// The surface as the zero level of a field psi [11]. `hint` is the vertex of the fitted mesh near which
/// the point is tracked: it tells sheets apart that are close in space; fields without sheets ignore it.
using ScalarField = std::function<FieldSample(const Vec3& point, int hint)>;

/// Something the user should know, with a code that scripts can test.
struct Warning {
  std::string code;     // e.g. "polygons_triangulated"
  std::string message;  // one line; names file and place where there is one
};
using Warnings = std::vector<Warning>;

}  // namespace hooke
