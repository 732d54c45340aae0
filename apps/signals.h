// Interruption: the first SIGINT or SIGTERM asks the work to stop with what it has; the second ends the
// process.
#pragma once

namespace hooke::app {

void catch_signals();

/// The signal that asked to stop, 0 if none did.
int caught_signal();

}  // namespace hooke::app
