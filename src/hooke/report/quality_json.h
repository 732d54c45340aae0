// The measured figures as JSON, for the report. Degrees, file units, 0-based ids; `null` for what does not
// exist.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"

namespace hooke {

/// {min, p01, p05, median, mean, p95, max, std, histogram: {edges, counts}, non_finite}; the figures and the
/// histogram are null when there was no finite number.
nlohmann::ordered_json to_json(const Statistics& statistics);

/// The blocks `before` and `after`.
nlohmann::ordered_json to_json(const Quality& quality);

/// The block `geometry`.
nlohmann::ordered_json to_json(const Deviation& deviation);

/// The figures of the mesh itself in the blocks `input` and `output`, from `vertices` to `volume`.
nlohmann::ordered_json to_json(const Topology& topology, const Extent& extent);

}  // namespace hooke
