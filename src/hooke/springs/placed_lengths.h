// Target lengths that are given at single places of a surface, and grow away from these.
#pragma once

#include <vector>

#include "hooke/geometry/aabb_tree.h"

namespace hooke {

/// Along a segment, whose ends may be the same.
struct PlacedLength {
  Vec3 from, to;
  double length;  // positive
};

/// So lengths can be shorter within a facet than at its corners. Lengths and distances are in the unit of the
/// points; distances are in space, so that lengths on other sheets close by get shorter too.
class PlacedLengths {
 public:
  /// None.
  PlacedLengths() = default;

  /// `unit`: lengths are rounded down to it times a power of 2^(1/8); `gradation`: by how much they grow away
  /// from their places, over the distance. Both are positive and finite.
  PlacedLengths(const std::vector<PlacedLength>& places, double unit, double gradation);

  /// The power of 2^(1/8) that a length, over the unit, is rounded down to.
  static int power_of(double length, double unit);

  bool empty() const { return groups_.empty(); }

  /// The target length at x: that of the places there, and away from these longer as the gradation says, but
  /// no longer than `asked`. Const calls are thread-safe.
  double length_at(const Vec3& x, double asked) const;

  /// The number of equilateral triangles that cover these faces with the lengths that length_at() makes of
  /// those of the vertices. Ends early with more than `enough`.
  double covering_faces(const Mat3X& points, const std::vector<Triangle>& faces,
                        const std::vector<double>& vertex_length, double enough) const;

 private:
  struct Group {
    double length;
    AabbTree segments;  // with that length
  };
  std::vector<Group> groups_;  // ascending
  double gradation_ = 1;
};

}  // namespace hooke
