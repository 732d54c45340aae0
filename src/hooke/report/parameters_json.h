// The parameters of a run, for its report.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "hooke/remesh/attempts.h"
#include "hooke/remesh/paper_mode.h"

namespace hooke {

/// Every effective value of a run, `null` for what has no effect in it. `effort` is what the options were set
/// for.
nlohmann::ordered_json parameters_json(const RemeshOptions& options, const AttemptOptions& attempts,
                                       Effort effort);
nlohmann::ordered_json parameters_json(const PaperOptions& options);

}  // namespace hooke
