// Narrow regions of a surface, strips and gaps between its creases and boundaries, and target lengths that
// fit into them.
#pragma once

#include <vector>

#include "hooke/geometry/aabb_tree.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// A region is narrow where two stretches of creases or boundaries face each other across a smooth part of
/// the surface, closer than the target length; stretches that lead into each other nearby, as at a corner or
/// around a disc, make none. A round crease or boundary whose radius is less than that counts as such a
/// region, as wide as the radius. Lengths and distances are in the unit of the points; distances are in
/// space, so that lengths on other sheets close by get shorter too.
class NarrowRegions {
 public:
  /// None.
  NarrowRegions() = default;

  /// `vertex_length`: target length per vertex; `shortest`: widths below that count as that; `gradation`: by
  /// how much lengths grow away from the regions, over the distance. Both are positive and finite; time and
  /// memory grow with the length of narrow regions over `shortest`. `with_creases`: see split_wedges().
  NarrowRegions(const Mat3X& points, const Adjacency& with_creases, const std::vector<double>& vertex_length,
                double shortest, double gradation);

  bool empty() const { return widths_.empty(); }

  /// The number of equilateral triangles that cover these faces with the lengths that length_at() makes of
  /// those of the vertices. Ends early with more than `enough`.
  double covering_faces(const Mat3X& points, const std::vector<Triangle>& faces,
                        const std::vector<double>& vertex_length, double enough) const;

  /// The target length at x: the width of the region there, and away from it longer as the gradation says,
  /// but no longer than `asked`. Widths are rounded down by up to a fifth. Const calls are thread-safe.
  double length_at(const Vec3& x, double asked) const;

 private:
  struct Width {
    double width;
    AabbTree segments;  // across the regions of that width, and along them
  };
  std::vector<Width> widths_;  // ascending
  double gradation_ = 1;
};

}  // namespace hooke
