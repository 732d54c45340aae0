// Mends a result that does not keep all of its input by moving single vertices, without another run.
#pragma once

namespace hooke {

class AttemptMaker;
struct Attempt;

/// Faces with a smaller minimum angle, degrees, are slivers.
inline constexpr double sliver_angle = 20;

/// Moves vertices of the result in rounds so that fewer flaws, or else fewer chords, are left: those that are
/// too far towards the closest points of the input, those about lost vertices of the input towards these, and
/// the corners of faces that are turned over, folded or intersecting to better places on the input; none that
/// is fixed, at a junction or on the boundary or, for faces, on a crease. A round may make more flaws at
/// first. Where not everything is mended and flaws are few, each place keeps what the best round has made of
/// it. If nothing gets better, the result stays as it was. Of an interrupted run only flaws count, in two
/// rounds; a run during whose mending the observer asks to stop is interrupted.
void mend(const AttemptMaker& maker, Attempt& run);

/// In mode `fixed`, where faces are those of the input: moves single corners of faces that have become
/// slivers back to where they were, or part of the way on the input, as long as the least angle around each
/// gets larger and no more are small. Vertices on creases and boundaries go all the way or stay. All is
/// undone if it breaks a promise. If the observer asks to stop it ends early, and the run is interrupted.
void take_back_slivers(const AttemptMaker& maker, Attempt& run);

}  // namespace hooke
