// What has become of the creases.
#pragma once

#include "hooke/working_mesh/workspace.h"

namespace hooke {

/// What was found of creases, and what of it is left. Mode `adapt` gives creases other edges: then the edges
/// are those of the result.
struct CreaseCounts {
  int curves = 0;  // from corner to corner, or closed
  int edges = 0;
  int kept = 0;            // of them, still there
  int corners = 0;         // vertices where curves end; they stand still
  int curve_vertices = 0;  // between them: they slide along the crease, or stay at its bends
  int charts = 1;          // smooth pieces between creases
};

/// Of the creases of the work.
CreaseCounts count_creases(const Workspace& work);

}  // namespace hooke
