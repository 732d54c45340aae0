#include "hooke/connectivity/face_collapses.h"

#include "hooke/integrator/guards.h"

namespace hooke {
namespace {

/// Collapses the first edge that may, of the face or at its corners.
bool collapse_about(AdaptingMesh& m, int face, const CollapseOptions& options) {
  const Triangulation& t = m.triangulation;
  for (int h = 3 * face; h < 3 * face + 3; ++h)
    if (collapse_edge(m, h, options) >= 0) return true;
  for (int corner : t.faces()[static_cast<size_t>(face)])
    for (int h : t.outgoing(corner))
      if (collapse_edge(m, h, options) >= 0) return true;
  return false;
}

}  // namespace

int collapse_folded_faces(AdaptingMesh& m, const CollapseOptions& options) {
  const Triangulation& t = m.triangulation;
  const auto is_folded = [&](int f) {
    const auto face = static_cast<size_t>(f);
    return face_alignment(m.placement.points, m.placement.normals, t.faces()[face], t.sides()[face]) <
           options.alignment;
  };
  const int count = t.half_edge_count() / 3;
  int collapses = 0;
  for (int f = 0; f < count; ++f) collapses += !t.is_gone(f) && is_folded(f) && collapse_about(m, f, options);
  m.retraction.count();
  return collapses;
}

}  // namespace hooke
