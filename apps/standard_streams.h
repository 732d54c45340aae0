// Standard input, output and error as the process meets them.
#pragma once

namespace hooke::app {

/// Gives a stream that the caller has closed a place where nothing can be written: else the next file that is
/// opened would become that stream, and get what is meant for it. To be called first of all.
void occupy_standard_streams();

}  // namespace hooke::app
