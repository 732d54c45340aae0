// How much memory the work may take.
#pragma once

#include <cstddef>

namespace hooke::app {

/// Bytes: 80 % of what the system says is available, or of what the machine has where it does not say, but of
/// no more than the process may take (ulimit -v).
std::size_t memory_limit();

}  // namespace hooke::app
