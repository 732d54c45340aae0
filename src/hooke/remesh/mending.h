// Mends a result that does not keep all of its input by moving single vertices, without another run.
#pragma once

namespace hooke {

class AttemptMaker;
struct Attempt;

/// Moves vertices of the result to the input while that leaves fewer flaws, or fewer chords: those that are
/// too far, the corners of faces that are turned over or intersect, and those about lost vertices of the
/// input. Moves that make no fewer flaws about them are taken back. Of an interrupted run only flaws count,
/// and it does not take long.
void mend(const AttemptMaker& maker, Attempt& run);

}  // namespace hooke
