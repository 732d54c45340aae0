// Ways that end on the surface, taken back where a guard breaks on them or faces come to cross.
#pragma once

#include "hooke/integrator/guards.h"

namespace hooke {

/// Puts vertices back from `to` to where they were in `from`, point and normal, until no guard breaks on the
/// way. Returns these.
std::vector<int> put_back_offenders(const Guards& guards, const Placement& from, Placement& to);

/// The same where no vertices moved but these.
std::vector<int> put_back_offenders(const Guards& guards, const Placement& from,
                                    const std::vector<int>& moved, Placement& to);

/// Puts the vertices of faces that have come to cross each other back to where they were, with them those
/// that a guard then wants back, and in each of a few rounds a ring more about what still crosses. Parts that
/// crossed before go on to cross along the same curve: what is close to it stays. Returns these vertices,
/// ascending.
std::vector<int> put_back_crossings(const Guards& guards, const Connectivity& connectivity,
                                    const Placement& from, Placement& to);

/// to = from with the vertices projected that have drifted, but for those where that would break a guard:
/// they stay drifted.
void settle(const Guards& guards, Retraction& retraction, const Placement& from, Placement& to);

/// The same in place.
void settle(const Guards& guards, Retraction& retraction, Placement& placement);

}  // namespace hooke
