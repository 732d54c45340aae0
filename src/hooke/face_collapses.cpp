#include "hooke/face_collapses.h"

#include "hooke/guards.h"
#include "hooke/least_angle.h"

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

/// Calls collapse(f) for each face that is there when its turn comes; returns how often that was true.
template <typename Collapse>
int for_each_face(AdaptingMesh& m, const Collapse& collapse) {
  int collapses = 0;
  const int count = m.triangulation.half_edge_count() / 3;
  for (int f = 0; f < count; ++f) collapses += !m.triangulation.is_gone(f) && collapse(f);
  m.retraction.count();
  return collapses;
}

}  // namespace

int collapse_folded_faces(AdaptingMesh& m, const FaceCollapseOptions& options) {
  CollapseOptions collapse = options.folded;
  collapse.insist = Insist::on_alignment;
  return for_each_face(m, [&](int f) {
    const auto face = static_cast<size_t>(f);
    return face_alignment(m.placement.points, m.placement.normals, m.triangulation.faces()[face],
                          m.triangulation.sides()[face]) < collapse.alignment &&
           collapse_about(m, f, collapse);
  });
}

int collapse_slivers(AdaptingMesh& m, const FaceCollapseOptions& options, double least_faces) {
  CollapseOptions collapse = options.sliver;
  collapse.insist = Insist::on_angle;
  const auto& faces = m.triangulation.faces();
  double left = static_cast<double>(faces.size());
  const auto give_way = [&](int f) {
    const double cotangent = greatest_cotangent(m.placement.points, faces[static_cast<size_t>(f)]);
    collapse.angle = angle_with_cotangent(cotangent) + options.angle_gain;
    if (left - 2 < least_faces || angle_with_cotangent(cotangent) >= options.sliver_angle ||
        !collapse_about(m, f, collapse))
      return false;
    left -= 2;
    return true;
  };
  int collapses = 0;
  for (int round = 0, last = 1; round < options.rounds && last > 0; ++round)
    collapses += last = for_each_face(m, give_way);
  return collapses;
}

}  // namespace hooke
