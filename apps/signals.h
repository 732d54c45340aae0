// Signal handling: the first SIGINT or SIGTERM requests a stop with the best mesh so far, the second
// terminates the process.
#pragma once

namespace hooke::app {

/// Installs the signal handlers.
void catch_signals();

/// The signal that requested a stop; 0 if none did.
int caught_signal();

}  // namespace hooke::app
