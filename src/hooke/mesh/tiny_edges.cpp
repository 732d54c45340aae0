#include "hooke/mesh/tiny_edges.h"

#include <algorithm>
#include <numeric>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/validation.h"

namespace hooke {
namespace {

/// An edge of some length is one of rounding only if it is no longer than this share of another one at an
/// end.
constexpr double rounding_beside = 1e-3;

class TinyEdgeCollapses {
 public:
  TinyEdgeCollapses(const Mat3X& points, const std::vector<Triangle>& triangles, double longest)
      : points_(points),
        longest_(longest),
        halfedges_(make_adjacency(static_cast<int>(points.cols()), triangles)) {}

  TinyEdges make() {
    TinyEdges result;
    std::vector<int>& into = result.into;
    into.resize(points_.cols());
    std::iota(into.begin(), into.end(), 0);
    std::vector<double> moved(into.size(), 0);  // of those merged into the vertex, at most
    size_t before;
    do {  // a collapse may allow another one before it
      before = result.collapsed.size();
      for (int h = 0; h < halfedges_.half_edge_count(); ++h) {
        if (halfedges_.is_removed(h / 3)) continue;
        const int from = halfedges_.from(h), to = halfedges_.to(h);
        const int stays = std::min(from, to), goes = std::max(from, to);
        const double moves = distance(from, to) + moved[goes];
        if (moves > longest_ || !halfedges_.keeps_topology(h)) continue;
        if (distance(from, to) > 0 && (!is_rounding(h) || turns_faces(goes, stays))) continue;
        moved[stays] = std::max(moved[stays], moves);
        halfedges_.collapse(h, stays);
        into[goes] = stays;
        result.collapsed.push_back({stays, goes});
      }
    } while (result.collapsed.size() > before);
    for (int& v : into) v = into[v];  // of a smaller id, which is known
    result.triangles = halfedges_.faces();
    for (int f = 0; f < halfedges_.half_edge_count() / 3; ++f)
      if (halfedges_.is_removed(f)) result.removed.push_back(f);
    return result;
  }

 private:
  double distance(int v, int w) const { return (points_.col(v) - points_.col(w)).norm(); }

  /// Is an edge no longer than that one of rounding? Other edges at its ends show that it is no detail of a
  /// shape of that size, and faces that it is not the thickness of a foil.
  bool is_rounding(int h) const {
    const double length = distance(halfedges_.from(h), halfedges_.to(h));
    bool is_long_beside = false;
    std::vector<Vec3> normals;  // of the faces at its ends that are no slivers
    for (const int v : {halfedges_.from(h), halfedges_.to(h)}) {
      for (const int w : halfedges_.neighbours(v))
        is_long_beside = is_long_beside || length <= rounding_beside * distance(v, w);
      for (const int out : halfedges_.outgoing(v)) {
        const Triangle& t = halfedges_.faces()[out / 3];
        const Vec3 normal = doubled_area_vector(points_, t);
        const double side = std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
        if (normal.norm() > side * longest_) normals.push_back(normal.normalized());
      }
    }
    constexpr double opposite = -.98;
    const auto faces_back = [&](const Vec3& n) {
      return std::ranges::any_of(normals, [&](const Vec3& other) { return n.dot(other) < opposite; });
    };
    return is_long_beside && std::ranges::none_of(normals, faces_back);
  }

  /// Would a face that stays turn over or lose its area when the vertex goes where the other is?
  bool turns_faces(int goes, int stays) const {
    return std::ranges::any_of(halfedges_.outgoing(goes), [&](int out) {
      const Triangle& t = halfedges_.faces()[out / 3];
      if (std::ranges::find(t, stays) != t.end()) return false;
      Triangle moved = t;
      std::ranges::replace(moved, goes, stays);
      const FaceShape before = face_shape(points_, t);
      return !before.degenerate() && before.normal.dot(face_shape(points_, moved).normal) <= 0;
    });
  }

  const Mat3X& points_;
  const double longest_;
  HalfedgeMesh halfedges_;
};

}  // namespace

TinyEdges collapse_tiny_edges(const Mat3X& points, const std::vector<Triangle>& triangles, double longest) {
  const auto is_short = [&](int v, int w) { return (points.col(v) - points.col(w)).norm() <= longest; };
  const bool has_any = std::ranges::any_of(triangles, [&](const Triangle& t) {
    return is_short(t[0], t[1]) || is_short(t[1], t[2]) || is_short(t[2], t[0]);
  });
  if (!has_any || !std::ranges::all_of(find_problems(points, triangles), is_acceptable, &Problem::kind))
    return {};
  return TinyEdgeCollapses(points, triangles, longest).make();
}

}  // namespace hooke
