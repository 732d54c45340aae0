// What a run came to, for people: in one line, angles, what holds the worst of them and what would help, and
// how far the surface went; and the measures as a text table with histograms, at most 80 columns wide.
#pragma once

#include <string>

#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"
#include "hooke/remesh/options.h"
#include "hooke/report/report.h"

namespace hooke {

/// Whether a distance in a mesh of this size is no more than rounding makes.
bool is_rounding(double distance, const Deviation& deviation);

/// "minimum angle 1.23 -> 27.8 degrees; 0 faces below 20 degrees (326 before); the worst is held by ...; the
/// surface moved by at most 0.4 % of its size", or "did not move". Pre-condition: the run has a result.
std::string outcome_in_words(const RunRecord& run);

/// The one change of options that would help most, for a run with this connectivity, or an empty text:
/// "--connectivity flip ..." where the neighbours of vertices hold small angles that other edges would not,
/// "--connectivity adapt ..." where creases do.
std::string advice_in_words(const RunRecord& run, ConnectivityMode mode);

/// The table of one mesh.
std::string quality_table(const Quality& mesh);

/// Before and after side by side, followed by the deviation between them.
std::string quality_table(const Quality& before, const Quality& after, const Deviation& deviation);

/// A row of block characters, one per bin, scaled to the fullest bin; a bin that is not empty is never blank.
std::string text_histogram(const Histogram& histogram);

}  // namespace hooke
