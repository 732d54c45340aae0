// How a mesh lies in memory while we work on it and measure it, however its file has it.
#pragma once

#include <memory>

#include "hooke/mesh/mesh.h"
#include "hooke/mesh/ordering.h"

namespace hooke {

struct Layout {
  Reordered order;  // against the mesh; without its faces, which the connectivity has
  std::shared_ptr<const Connectivity> connectivity;
};

/// In memory order.
Layout lay_out(const TriMesh& mesh);

}  // namespace hooke
