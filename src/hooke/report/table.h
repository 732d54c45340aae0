// The measured figures as text for people: one table, at most 80 columns wide.
#pragma once

#include <string>

#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"

namespace hooke {

/// One mesh on its own.
std::string quality_table(const Quality& mesh);

/// Before and after side by side, and what the way from one to the other has cost.
std::string quality_table(const Quality& before, const Quality& after, const Deviation& deviation);

/// A row of blocks, one per bin, the fullest eight eighths high; a bin that holds anything is never blank.
std::string text_histogram(const Histogram& histogram);

}  // namespace hooke
