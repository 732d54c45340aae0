// Shells by themselves: where a result of mode `adapt` does not keep some shells of its input, these are
// remeshed each by itself, and the others stay as they are.
#pragma once

#include <functional>

namespace hooke {

class AttemptMaker;
struct Attempt;

/// The best attempt for some shells, with all that mends it. `first`: what the first run has made of them;
/// `max_faces`: the most faces that they may have with shorter lengths; `leaves_it`: all faces of the input
/// stay.
using BestOfPart =
    std::function<Attempt(AttemptMaker& maker, Attempt first, double max_faces, bool leaves_it)>;

/// If only some shells are wrong in `best`, or several are, remeshes each of these by itself; where nothing
/// mends it, it stays as it is in the input. Shells that then cross are remeshed together, and few that are
/// still wrong at last stay as they are. `unmended`: the first run; `max_faces`: the most that the whole may
/// have. Replaces `best` by what is better.
void remesh_shells(AttemptMaker& maker, const Attempt& unmended, double max_faces,
                   const BestOfPart& best_of_part, Attempt& best);

}  // namespace hooke
