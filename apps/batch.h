// A run on several inputs: each mesh in a process of its own, so that its failure is no one else's.
#pragma once

#include "options.h"

namespace hooke::app {

/// Runs the command for each input, as many at the same time as processors and memory allow; what it writes
/// is what single runs write. Writes the table, and prints messages, a line for each mesh and one for all.
/// Hands the first signal on, and then starts no other mesh. Returns the exit code of the first input, in
/// their order, that was not done; done if there is none. Throws Error for what plan_batch() refuses,
/// OutputError for a folder or a table that cannot be written.
int run_batch(const Settings& settings);

}  // namespace hooke::app
