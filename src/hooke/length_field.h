// Target lengths as a field on the surface of the input: a vertex that travels takes up those of its new
// place.
#pragma once

#include <memory>

#include "hooke/connectivity.h"

namespace hooke {

class LengthField {
 public:
  /// Uniform.
  LengthField() = default;

  /// Of a mesh whose vertices have these target lengths; linear on its faces.
  LengthField(const Mat3X& points, std::shared_ptr<const Connectivity> connectivity,
              const std::vector<double>& vertex_length);

  /// All lengths are the same.
  bool uniform() const { return vertex_length_.empty(); }

  /// The length at the point of the mesh that is reached from x by going to closer and closer faces, from
  /// those about the vertex `anchor`, which becomes one next to that point. Pre-condition: not uniform.
  double at(const Vec3& x, int& anchor) const;

 private:
  Mat3X points_;  // nothing is kept of a uniform field
  std::shared_ptr<const Connectivity> connectivity_;
  std::vector<double> vertex_length_;
};

}  // namespace hooke
