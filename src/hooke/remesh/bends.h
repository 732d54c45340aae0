// Where a result turns sharply within an edge though its input is smooth there, as narrow parts of long edges
// do.
#pragma once

#include <vector>

#include "hooke/core/types.h"

namespace hooke {

class AttemptMaker;
struct Attempt;

/// A place where a result bends by an angle in degrees.
struct Bend {
  Vec3 from, to;
  double angle;
  double target;  // length there
  double width;   // within which it bends: of its edges or faces there, at most that length
  bool across_crease;
};

/// The bends of a result by more than `max_bend` degrees, across an edge, or along a crease or boundary at a
/// vertex, where the input bends by less than .85 of that, and by less than `smooth` degrees or half.
std::vector<Bend> unresolved_bends(const AttemptMaker& maker, const Attempt& attempt, double max_bend,
                                   double smooth = 180);

/// The bends by more than 60 degrees where the input bends by less than 40 or half.
std::vector<Bend> sharp_bends(const AttemptMaker& maker, const Attempt& attempt);

/// Notes these in the result.
void note_bends(const AttemptMaker& maker, Attempt& attempt);

}  // namespace hooke
