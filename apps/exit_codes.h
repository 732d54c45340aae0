// Exit codes of the command.
#pragma once

namespace hooke::app {

enum ExitCode {
  done = 0,
  internal_error = 1,
  usage = 2,              // invalid command line
  malformed_input = 3,    // missing, unreadable or not a well-formed mesh file
  unacceptable_mesh = 4,  // well-formed, but not an oriented manifold with area
  output_failed = 5,      // an existing file is unchanged
  gate_failed = 6,        // a condition of --require, or worse than --compare; the result was written
  numerical_failure = 7,
  limit_reached = 8,   // memory limit, without a usable result
  promise_broken = 9,  // the result does not keep what it must keep of the input; it was not written
  interrupted = 130,   // SIGINT; the best mesh so far was written
  terminated = 143,    // SIGTERM; the best mesh so far was written
};

}  // namespace hooke::app
