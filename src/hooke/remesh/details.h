// Details of a part that are fine for the length asked for: fillets, rods, walls and gaps.
#pragma once

#include <functional>

#include "hooke/remesh/attempts.h"

namespace hooke {

class ShorterLengths;

/// In mode `adapt`, where the facets of the input are meant, as in CAD parts: makes up to three more attempts
/// from a result that keeps its promises, and keeps each if it is closer to the input for it. One has shorter
/// lengths where smooth parts bend too much within an edge; one keeps edges along the middle of the rounded
/// edges that are too narrow even so, where chords from side to side would cut them to saw teeth; and one has
/// shorter lengths where walls or gaps do not keep their thickness. Attempts are made by `attempt`, with the
/// options and lengths of the maker at that time: with `start` but for what is said here.
void resolve_details(AttemptMaker& maker, const ShorterLengths& shorter, const RemeshOptions& start,
                     const std::function<Attempt()>& attempt, Attempt& best);

/// Notes in the result which of them are lost.
void note_lost_details(const AttemptMaker& maker, Attempt& attempt);

}  // namespace hooke
