// Protection against closed standard streams.
#pragma once

namespace hooke::app {

/// Opens /dev/null, read-only, for each standard stream that is closed. Otherwise the next file to be opened
/// would take its descriptor and receive its output. To be called before any file is opened.
void occupy_standard_streams();

}  // namespace hooke::app
