// Vertices of a result, in the modes `fixed` and `flip`, that go back to where they were in the input.
#pragma once

namespace hooke {

class AttemptMaker;
struct Attempt;

/// Puts vertices back, ring by ring around what is wrong with promises and polygons, until nothing is or so
/// many rings are.
void put_back_around_flaws(const AttemptMaker& maker, Attempt& run, int max_rings);

/// Puts all vertices back. Pre-condition: the result has the faces of the input.
void put_all_back(const AttemptMaker& maker, Attempt& run);

/// Puts back those that moved by rounding only, without another judgement.
void leave_what_hardly_moved(const AttemptMaker& maker, Attempt& run);

}  // namespace hooke
