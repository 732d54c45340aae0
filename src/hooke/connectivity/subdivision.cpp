#include "hooke/connectivity/subdivision.h"

#include <optional>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

/// The half-edge that runs from one vertex to the other, -1 if there is none.
int half_edge_between(const Triangulation& t, int from, int to) {
  for (int h : t.outgoing(from))
    if (t.to(h) == to) return h;
  return -1;
}

struct EdgeToSplit {
  Edge ends;                          // as a face runs through it
  std::optional<VertexPlace> middle;  // of an edge that is no rim
};

/// Each edge once. The middles are looked for at the same time: no split moves a vertex.
std::vector<EdgeToSplit> all_edges(const AdaptingMesh& m) {
  const Triangulation& t = m.triangulation;
  std::vector<int> half_edges;
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.twin(h) < h) half_edges.push_back(h);
  std::vector<EdgeToSplit> edges(half_edges.size());
  parallel_for(edges.size(), 64, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int h = half_edges[i];
      edges[i].ends = {t.from(h), t.to(h)};
      if (!is_rim(t, h)) edges[i].middle = middle_of(m, h);
    }
  });
  return edges;
}

class Subdivision {
 public:
  Subdivision(AdaptingMesh& mesh, const SplitOptions& options, const FlipGuardOptions& flip_guard)
      : m_(mesh), t_(mesh.triangulation), options_(options), guard_(flip_guard), ends_(ids(), Edge{-1, -1}) {}

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
    if (t_.twin(h) < 0 || t_.is_constrained(h)) return false;
    const int a = t_.from(h), b = t_.to(h);
    const auto& [first, second] = ends_[static_cast<size_t>(a)];
    return is_middle(a) && !is_middle(b) && b != first && b != second && is_middle(t_.apex(h)) &&
           is_middle(t_.apex(t_.twin(h)));
  }

  /// All are judged by the faces as the splits have left them. No face that was quartered has more than one
  /// such edge: a flip leaves the other edges in their places.
  void join_middles() {
    const FlippingMesh flipping = m_.flipping();
    std::vector<char> joins(static_cast<size_t>(t_.half_edge_count()), 0);
    parallel_for(joins.size(), 1024, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        if (const int h = static_cast<int>(i); is_between_middles(h))
          joins[i] = may_flip(flipping, h, guard_);
    });
    for (size_t h = 0; h < joins.size(); ++h)
      if (joins[h]) t_.flip(static_cast<int>(h));
  }

  AdaptingMesh& m_;
  Triangulation& t_;
  const SplitOptions& options_;
  const FlipGuardOptions& guard_;
  std::vector<Edge> ends_;  // per id: of the edge in whose middle the vertex is; -1 for all others
};

}  // namespace

int subdivide(AdaptingMesh& m, const SplitOptions& options, const FlipGuardOptions& flip_guard) {
  return Subdivision(m, options, flip_guard).run();
}

}  // namespace hooke
