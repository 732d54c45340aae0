#include "hooke/mesh/layout.h"

#include <utility>

namespace hooke {

Layout lay_out(const TriMesh& mesh) {
  const int n = static_cast<int>(mesh.n_vertices());
  const std::vector<Triangle> faces = triangles_of(mesh);
  Layout layout{reorder(faces, locality_order(n, faces)), nullptr};
  layout.connectivity =
      std::make_shared<const Connectivity>(make_connectivity(n, std::exchange(layout.order.faces, {})));
  return layout;
}

}  // namespace hooke
