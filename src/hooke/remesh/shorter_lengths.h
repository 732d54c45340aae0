// Target lengths that get shorter where an attempt does not keep the input, or is too coarse for its bends
// and walls.
#pragma once

#include <optional>
#include <vector>

#include "hooke/remesh/attempts.h"
#include "hooke/remesh/flaws.h"

namespace hooke {

/// Keeps references to both: `asked` are the lengths that the user asked for, by vertex of the input.
class ShorterLengths {
 public:
  ShorterLengths(const AttemptMaker& maker, const std::vector<double>& asked)
      : maker_(maker), asked_(asked) {}

  /// Shortens `lengths` where something is wrong in this attempt, or was before it was mended. At kept faces
  /// its own are those of the input.
  void shorten_at(const std::vector<FlawPlace>& flaws, const Attempt& last, AskedLengths& lengths) const;

  /// The lengths of an attempt, shortened where the input bends over several edges and the attempt within
  /// one: by more than 45 degrees across an edge that is no crease, or along a crease or boundary at a
  /// vertex, where the input bends by less than .85 of that. So short that it would be 33 degrees or, if
  /// these lengths took more than `max_faces`, 44, 59 or 78, the first with which they do not take twice as
  /// many; if all do, by the target lengths there, though edges are shorter already. None if all take too
  /// many faces, or if hardly an edge bends so.
  std::optional<AskedLengths> resolving_bends(const Attempt& attempt, double max_faces) const;

  /// Those of an attempt, shortened where it is off by more than a fifth of a wall or gap of the input: so
  /// short that it would be a tenth or, if these lengths took more than `max_faces`, .18 or .32. None if all
  /// take too many faces, or if hardly anything is off so much.
  std::optional<AskedLengths> resolving_walls(const Attempt& attempt, double max_faces) const;

  /// The number of faces that these lengths take, or more than `enough`.
  double faces_of(const AskedLengths& lengths, double enough) const;

  /// These lengths at the edges of the input: the longest along each.
  std::vector<double> at_edges(const AskedLengths& lengths) const;

  /// At how many vertices of a result it is places that made the lengths clearly shorter.
  int count_in(const Attempt& run) const;

 private:
  double shortening(double excess) const;
  PlacedLengths placed(const AskedLengths& lengths) const;
  double asked_at(const Vec3& x) const;

  const AttemptMaker& maker_;
  const std::vector<double>& asked_;
};

}  // namespace hooke
