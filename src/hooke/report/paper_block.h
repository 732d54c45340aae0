// The block `paper` of a report: the columns of the paper's tables 1 to 3, the energies, and the course of
// --paper.
// "Hooke's Optimization for 3D triangular mesh", section 5.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

#include "hooke/core/uniform_vector.h"
#include "hooke/measure/quality.h"

namespace hooke {

struct RunRecord;
struct TimeStepRecord;

/// What the paper tells of a mesh beyond its Quality.
struct PaperFigures {
  std::optional<Range> fitted_mean_curvature, fitted_gaussian_curvature;  // see fitted_curvature()
  double string_energy = 0;                                               // sum of U(l; L) / L^2
  double altitude_energy = 0;  // sum of U(h; h0) / L_f^2, each face in its own plane
};

/// `edge_targets`: one target length per edge. Fitting curvatures takes several microseconds per vertex.
PaperFigures measure_paper_figures(const Mat3X& points, const Adjacency& adjacency,
                                   const UniformVector& edge_targets, bool with_fitted_curvature);

/// The block `paper`: figures before and after, the greatest displacement, and what each outer iteration of
/// paper_remesh() came to.
nlohmann::ordered_json paper_block(const RunRecord& run);

/// The time steps as CSV, one a line, in the units of the evolution: lengths are mean target lengths. `bound`
/// names the tests of [26] that limited the step, joined by +.
std::string time_steps_csv(const std::vector<TimeStepRecord>& steps);

}  // namespace hooke
