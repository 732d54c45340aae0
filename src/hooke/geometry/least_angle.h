// The least corner angle of a face, by its cotangent, which costs no trigonometry and falls as the angle
// grows.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

/// Cotangent of the least angle of a face, which is across from its shortest edge; infinite without area.
double greatest_cotangent(const Mat3X& points, const Triangle& face);

/// The greatest of all faces; infinite without faces.
double greatest_cotangent(const Mat3X& points, const std::vector<Triangle>& faces);

/// The angle, degrees.
double angle_with_cotangent(double cotangent);

/// Least corner angle of all faces, degrees; 0 without faces.
double least_angle(const Mat3X& points, const std::vector<Triangle>& faces);

}  // namespace hooke
