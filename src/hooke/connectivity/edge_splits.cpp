#include "hooke/connectivity/edge_splits.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "hooke/connectivity/edge_flips.h"
#include "hooke/connectivity/edge_queue.h"
#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/local_shape.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {

/// Minimum share of a split face's area in each half.
constexpr double min_half_area = .1;

bool may_split_face(const WorkingMesh& m, int h, int v, int wedge) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.vertices.positions.points;
  const Mat3X& N = m.vertices.positions.normals;
  const Triangle old = {t.from(h), t.to(h), t.opposite_vertex(h)};
  const Triangle wedges = {t.wedge(h), t.wedge(HalfedgeMesh::next(h)), t.wedge(HalfedgeMesh::previous(h))};
  const double min_area = min_half_area * face_shape(X, old).area;
  const double min_alignment = std::min(ShapeLimits().alignment, face_alignment(X, N, old, wedges));
  for (size_t k : {0, 1}) {  // the corner that v replaces
    Triangle half = old, half_wedges = wedges;
    half[k] = v;
    half_wedges[k] = wedge;
    if (face_shape(X, half).area < min_area || face_alignment(X, N, half, half_wedges) < min_alignment)
      return false;
  }
  return true;
}

namespace {

/// Is the edge part of a fixed boundary?
bool is_fixed(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  const auto fixed = [&](int v) { return m.vertices.constraints.freedom[v] == Freedom::fixed; };
  return t.is_feature_edge(h) && fixed(t.from(h)) && fixed(t.to(h)) && curve_of(m, h).curve < 0;
}

/// Would all new edges of a split be shorter than the old one? Otherwise splits might never end where the
/// longest edge of a flat face may not be split.
bool shortens(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.vertices.positions.points;
  const Vec3 a = X.col(t.from(h)), b = X.col(t.to(h)), middle = .5 * a + .5 * b;
  const auto shorter = [&](int half_edge) {
    return (middle - X.col(t.opposite_vertex(half_edge))).squaredNorm() < (b - a).squaredNorm();
  };
  return shorter(h) && (t.twin(h) < 0 || shorter(t.twin(h)));
}

}  // namespace

int split_edge(WorkingMesh& m, int h, const SurfacePosition* middle) {
  HalfedgeMesh& t = m.halfedges;
  if (is_fixed(m, h) || is_junction_edge(m, h) || is_frozen_edge(m, h)) return -1;
  const int v = add_vertex(m, h, middle), twin = t.twin(h), right = t.is_crease(h) ? v + 1 : v;
  if (!may_split_face(m, h, v, v) || (twin >= 0 && !may_split_face(m, twin, v, right))) {
    remove_last_vertex(m);
    return -1;
  }
  t.split(h);
  if (const int curve = m.vertices.constraints.curve[v]; curve >= 0) ++m.curve_edges.present[curve];
  return v;
}

int split_long_edges(WorkingMesh& m, int max_splits) {
  EdgeQueue queue(m.halfedges, [&](int h) { return relative_length(m, h) - max_relative_length; });
  int splits = 0;
  for (int h = queue.pop(); h >= 0 && splits < max_splits; h = queue.pop()) {
    if (!shortens(m, h)) continue;
    const int v = split_edge(m, h);
    if (v < 0) continue;
    queue.push_around(v);
    ++splits;
  }
  m.retraction.count();
  return splits;
}

namespace {

struct EdgeToSplit {
  Edge ends;                              // in the orientation of a face
  std::optional<SurfacePosition> middle;  // midpoint; none for a feature edge
};

/// Each edge once. The midpoints can be found in parallel beforehand, as splits move no vertex.
std::vector<EdgeToSplit> all_edges(const WorkingMesh& m) {
  const HalfedgeMesh& t = m.halfedges;
  std::vector<int> half_edges;
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.twin(h) < h) half_edges.push_back(h);
  std::vector<EdgeToSplit> edges(half_edges.size());
  parallel_for(edges.size(), 64, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int h = half_edges[i];
      edges[i].ends = {t.from(h), t.to(h)};
      if (!t.is_feature_edge(h)) edges[i].middle = project_midpoint(m, h);
    }
  });
  return edges;
}

class Subdivision {
 public:
  explicit Subdivision(WorkingMesh& mesh) : m_(mesh), t_(mesh.halfedges), ends_(ids(), Edge{-1, -1}) {}

  int run() {
    int splits = 0;
    for (const auto& [edge, middle] : all_edges(m_)) {
      const int h = t_.half_edge(edge[0], edge[1]);
      const int v = split_edge(m_, h, middle ? &*middle : nullptr);
      if (v < 0) continue;
      ends_.resize(ids(), Edge{-1, -1});
      ends_[v] = edge;
      ++splits;
    }
    m_.retraction.count();
    join_middles();
    return splits;
  }

 private:
  size_t ids() const { return t_.id_count(); }

  bool is_middle(int v) const { return ends_[v][0] >= 0; }

  /// The first split of a face joins the new vertex to the opposite corner. After all splits that edge lies
  /// between two midpoints, which are to be joined instead.
  bool is_between_middles(int h) const {
    if (t_.twin(h) < 0 || t_.is_crease(h)) return false;
    const int a = t_.from(h), b = t_.to(h);
    const auto& [first, second] = ends_[a];
    return is_middle(a) && !is_middle(b) && b != first && b != second && is_middle(t_.opposite_vertex(h)) &&
           is_middle(t_.opposite_vertex(t_.twin(h)));
  }

  /// Flips these edges, all tested on the faces after the splits. A face that was split three times has only
  /// one of them, so no flip affects another.
  void join_middles() {
    std::vector<char> joins(t_.half_edge_count(), 0);
    parallel_for(joins.size(), 1024, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        if (const int h = static_cast<int>(i); is_between_middles(h)) joins[i] = may_flip(m_, h);
    });
    for (size_t h = 0; h < joins.size(); ++h)
      if (joins[h]) t_.flip(static_cast<int>(h));
  }

  WorkingMesh& m_;
  HalfedgeMesh& t_;
  std::vector<Edge> ends_;  // per id: ends of the edge whose midpoint the vertex is; -1 for others
};

}  // namespace

int subdivide(WorkingMesh& m) {
  return Subdivision(m).run();
}

}  // namespace hooke
