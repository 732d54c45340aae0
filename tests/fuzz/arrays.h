// Small meshes of any kind, valid or not, from bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/core/types.h"

namespace hooke::fuzz {

struct Arrays {
  unsigned choice = 0;  // of options
  Mat3X points;
  std::vector<Triangle> triangles;
};

/// The bytes are: options, number of vertices (4 to 32), three bytes per vertex on a grid of 32^3, three per
/// triangle.
inline Arrays arrays_from(const std::uint8_t* data, std::size_t size) {
  Arrays arrays;
  if (size < 2) return arrays;
  arrays.choice = data[0];
  const int count = 4 + data[1] % 29;
  std::size_t at = 2;
  const auto next = [&] { return at < size ? data[at++] : std::uint8_t(0); };
  arrays.points.resize(3, count);
  for (int v = 0; v < count; ++v)
    for (int k = 0; k < 3; ++k) arrays.points(k, v) = next() % 32 + 1e-3 * v;
  while (at + 3 <= size && arrays.triangles.size() < 128) {
    Triangle t;
    for (int& corner : t) corner = next() % count;
    arrays.triangles.push_back(t);
  }
  return arrays;
}

}  // namespace hooke::fuzz
