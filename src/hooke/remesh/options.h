// What an effort stands for.
#pragma once

#include "hooke/remesh/remesh.h"

namespace hooke {

/// Sets the counts and limits that an effort stands for, in the connectivity mode of the options. `standard`
/// is what the options are by default.
void set_effort(RemeshOptions& options, Effort effort);

}  // namespace hooke
