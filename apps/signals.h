// Signal handling: the first SIGINT or SIGTERM requests a stop with the best mesh so far, the second
// terminates the process.
#pragma once

namespace hooke::app {

/// Installs the signal handlers.
void catch_signals();

/// From now on the first signal is answered at once, by a line on standard error: to measure and write the
/// best mesh so far takes a while. A line that is shown already, as that of the progress, stays above it.
void answer_signals();

/// The signal that requested a stop; 0 if none did.
int caught_signal();

}  // namespace hooke::app
