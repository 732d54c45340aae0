// A symmetric 3 x 3 matrix in single precision, compact storage for per-vertex data that need not be exact.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct SymmetricMatrix {
  float xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;

  SymmetricMatrix() = default;
  explicit SymmetricMatrix(const Eigen::Matrix3d& m)
      : xx(static_cast<float>(m(0, 0))),
        yy(static_cast<float>(m(1, 1))),
        zz(static_cast<float>(m(2, 2))),
        xy(static_cast<float>(m(0, 1))),
        yz(static_cast<float>(m(1, 2))),
        zx(static_cast<float>(m(2, 0))) {}

  Vec3 operator*(const Vec3& v) const {
    return {xx * v[0] + xy * v[1] + zx * v[2], xy * v[0] + yy * v[1] + yz * v[2],
            zx * v[0] + yz * v[1] + zz * v[2]};
  }
};

}  // namespace hooke
