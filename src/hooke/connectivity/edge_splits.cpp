#include "hooke/connectivity/edge_splits.h"

#include <optional>

#include "hooke/connectivity/edge_flips.h"
#include "hooke/connectivity/edge_queue.h"
#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

/// May vertex v, of which the face of h sees `side`, halve that face?
bool may_split_edge(const WorkingMesh& m, int h, int v, int wedge, const SplitOptions& o) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.positions.points;
  const Mat3X& N = m.positions.normals;
  const Triangle old = {t.from(h), t.to(h), t.opposite_vertex(h)};
  const Triangle seen = {t.wedge(h), t.wedge(HalfedgeMesh::next(h)), t.wedge(HalfedgeMesh::previous(h))};
  const double min_area = o.area_share * face_shape(X, old).area;
  const double min_alignment = std::min(o.alignment, face_alignment(X, N, old, seen));
  for (size_t k : {0, 1}) {  // the corner that the vertex replaces
    Triangle half = old, half_seen = seen;
    half[k] = v;
    half_seen[k] = wedge;
    if (face_shape(X, half).area < min_area || face_alignment(X, N, half, half_seen) < min_alignment)
      return false;
  }
  return true;
}

/// The ends of an edge that stands still, because its boundary does.
bool stands_still(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  const auto fixed = [&](int v) { return m.constraints.freedom[static_cast<size_t>(v)] == Freedom::fixed; };
  return is_feature_edge(t, h) && fixed(t.from(h)) && fixed(t.to(h)) && curve_of(m, h).curve < 0;
}

/// Would a split leave all new edges shorter than the old one? Else splits might go on for ever where the
/// longest edge of a flat face may not be split.
bool shortens(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.positions.points;
  const Vec3 a = X.col(t.from(h)), b = X.col(t.to(h)), middle = .5 * a + .5 * b;
  const auto shorter = [&](int wedge) {
    return (middle - X.col(t.opposite_vertex(wedge))).squaredNorm() < (b - a).squaredNorm();
  };
  return shorter(h) && (t.twin(h) < 0 || shorter(t.twin(h)));
}

}  // namespace

int split_edge(WorkingMesh& m, int h, const SplitOptions& options, const SurfacePosition* middle) {
  HalfedgeMesh& t = m.halfedges;
  if (stands_still(m, h)) return -1;
  const int v = add_vertex(m, h, middle), twin = t.twin(h), right = t.is_crease(h) ? v + 1 : v;
  if (!may_split_edge(m, h, v, v, options) || (twin >= 0 && !may_split_edge(m, twin, v, right, options))) {
    drop_vertex(m);
    return -1;
  }
  t.split(h);
  if (const int curve = m.constraints.curve[static_cast<size_t>(v)]; curve >= 0)
    ++m.curve_edges.present[static_cast<size_t>(curve)];
  return v;
}

int split_long_edges(WorkingMesh& m, const SplitOptions& options) {
  EdgeQueue queue(m.halfedges, [&](int h) { return relative_length(m, h) - options.longest; });
  int splits = 0;
  for (int h = queue.pop(); h >= 0; h = queue.pop()) {
    if (!shortens(m, h)) continue;
    const int v = split_edge(m, h, options);
    if (v < 0) continue;
    queue.push_about(v);
    ++splits;
  }
  m.retraction.count();
  return splits;
}

namespace {

/// The half-edge that runs from one vertex to the other, -1 if there is none.
int half_edge_between(const HalfedgeMesh& t, int from, int to) {
  for (int h : t.outgoing(from))
    if (t.to(h) == to) return h;
  return -1;
}

struct EdgeToSplit {
  Edge ends;                              // as a face runs through it
  std::optional<SurfacePosition> middle;  // of an edge that is no rim
};

/// Each edge once. The middles are looked for at the same time: no split moves a vertex.
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
      if (!is_feature_edge(t, h)) edges[i].middle = middle_of(m, h);
    }
  });
  return edges;
}

class Subdivision {
 public:
  Subdivision(WorkingMesh& mesh, const SplitOptions& options, const FlipGuardOptions& flip_guard)
      : m_(mesh), t_(mesh.halfedges), options_(options), guard_(flip_guard), ends_(ids(), Edge{-1, -1}) {}

  int run() {
    int splits = 0;
    for (const auto& [edge, middle] : all_edges(m_)) {
      const int h = half_edge_between(t_, edge[0], edge[1]);
      const int v = split_edge(m_, h, options_, middle ? &*middle : nullptr);
      if (v < 0) continue;
      ends_.resize(ids(), Edge{-1, -1});
      ends_[static_cast<size_t>(v)] = edge;
      ++splits;
    }
    m_.retraction.count();
    join_middles();
    return splits;
  }

 private:
  size_t ids() const { return static_cast<size_t>(t_.id_count()); }

  bool is_middle(int v) const { return ends_[static_cast<size_t>(v)][0] >= 0; }

  /// The first split of a face joins the new vertex to the corner across. That edge has a middle on either
  /// side in the end, which are to be joined instead.
  bool is_between_middles(int h) const {
    if (t_.twin(h) < 0 || t_.is_crease(h)) return false;
    const int a = t_.from(h), b = t_.to(h);
    const auto& [first, second] = ends_[static_cast<size_t>(a)];
    return is_middle(a) && !is_middle(b) && b != first && b != second && is_middle(t_.opposite_vertex(h)) &&
           is_middle(t_.opposite_vertex(t_.twin(h)));
  }

  /// All are judged by the faces as the splits have left them. No face that was quartered has more than one
  /// such edge: a flip leaves the other edges in their places.
  void join_middles() {
    const FlippableMesh flipping = m_.flipping();
    std::vector<char> joins(static_cast<size_t>(t_.half_edge_count()), 0);
    parallel_for(joins.size(), 1024, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        if (const int h = static_cast<int>(i); is_between_middles(h))
          joins[i] = may_flip(flipping, h, guard_);
    });
    for (size_t h = 0; h < joins.size(); ++h)
      if (joins[h]) t_.flip(static_cast<int>(h));
  }

  WorkingMesh& m_;
  HalfedgeMesh& t_;
  const SplitOptions& options_;
  const FlipGuardOptions& guard_;
  std::vector<Edge> ends_;  // per id: of the edge in whose middle the vertex is; -1 for all others
};

}  // namespace

int subdivide(WorkingMesh& m, const SplitOptions& options, const FlipGuardOptions& flip_guard) {
  return Subdivision(m, options, flip_guard).run();
}

}  // namespace hooke
