// What the exit status of the command means.
#pragma once

namespace hooke::app {

enum ExitCode {
  done = 0,
  internal_error = 1,
  usage = 2,              // or configuration
  malformed_input = 3,    // missing, unreadable or not a well-formed mesh file
  unacceptable_mesh = 4,  // read, but not an oriented manifold with area
  output_failed = 5,      // an older file is left as it was
  numerical_failure = 7,
  limit_reached = 8,  // of memory, with nothing usable
  interrupted = 130,  // SIGINT; the best mesh so far was written
  terminated = 143,   // SIGTERM; likewise
};

}  // namespace hooke::app
