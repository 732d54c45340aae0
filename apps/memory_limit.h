// How much memory the work may take, and its way back.
#pragma once

#include <cstddef>

namespace hooke::app {

/// Bytes: 80 % of what the system says is available, or of what the machine has where it does not say, but of
/// no more than the process may take (ulimit -v).
std::size_t memory_limit();

/// Gives memory that is free back to the system, where its library can: before work that takes large pieces.
void return_free_memory();

}  // namespace hooke::app
