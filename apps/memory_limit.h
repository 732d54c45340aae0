// The memory limit of a run, and the return of free memory to the system.
#pragma once

#include <cstddef>

namespace hooke::app {

/// The memory limit in bytes: 80 % of the minimum of the available memory and the process limit (ulimit -v).
/// If the system does not report the available memory, the physical memory is used instead.
std::size_t memory_limit();

/// Returns free heap memory to the system, if the C library can. To be called before large allocations.
void return_free_memory();

}  // namespace hooke::app
