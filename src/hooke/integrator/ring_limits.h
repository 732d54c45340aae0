// The guards' absolute limits on a ring, four faces at a time.
#pragma once

#include "hooke/integrator/guard_rules.h"
#include "hooke/springs/ring_columns.h"

namespace hooke {

/// Whether no absolute limit is broken and no face shrinks too far: the rules have nothing to say then. The
/// two views differ in their place only.
bool within_limits(const RingView& before, const RingView& after, const GuardOptions& options);

}  // namespace hooke
