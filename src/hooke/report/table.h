// The measures as a text table, at most 80 columns wide.
#pragma once

#include <string>

#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"

namespace hooke {

/// The table of one mesh.
std::string quality_table(const Quality& mesh);

/// Before and after side by side, followed by the deviation between them.
std::string quality_table(const Quality& before, const Quality& after, const Deviation& deviation);

/// A row of block characters, one per bin, scaled to the fullest bin; a bin that is not empty is never blank.
std::string text_histogram(const Histogram& histogram);

}  // namespace hooke
