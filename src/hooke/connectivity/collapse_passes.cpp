#include "hooke/connectivity/collapse_passes.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include "hooke/connectivity/edge_queue.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

/// Partition of the vertices into blocks of consecutive ids, equal in size except for the first and the last.
struct Blocks {
  std::vector<int> of;     // per id: its block
  std::vector<int> first;  // first id of each block, and one past the last id
};

Blocks cut_into_blocks(const HalfedgeMesh& t, int vertices, int offset) {
  Blocks blocks{std::vector<int>(static_cast<size_t>(t.id_count())), {0}};
  int in_block = offset;
  for (int v = 0; v < t.id_count(); ++v) {
    if (t.valence(v) > 0 && ++in_block > vertices) {
      blocks.first.push_back(v);
      in_block = 1;
    }
    blocks.of[static_cast<size_t>(v)] = static_cast<int>(blocks.first.size()) - 1;
  }
  blocks.first.push_back(t.id_count());
  return blocks;
}

/// Distance of each vertex from the other blocks: 0 if a neighbour is in another block, 1 if a neighbour has
/// depth 0, else 2. The collapse of an inner edge between vertices of depth 2 reads and writes its own block
/// only and preserves these depths. Feature edges are excluded: their collapse changes the edge count of a
/// curve, which blocks share.
std::vector<char> depths_in(const Blocks& blocks, const HalfedgeMesh& t) {
  std::vector<char> depths(static_cast<size_t>(t.id_count()), 2);
  const auto lower = [&](char depth, const auto& is_so_deep) {
    for (const Triangle& face : t.faces()) {
      if (face[0] < 0 || !is_so_deep(face)) continue;
      for (int v : face) depths[static_cast<size_t>(v)] = std::min(depths[static_cast<size_t>(v)], depth);
    }
  };
  lower(0, [&](const Triangle& face) {
    return std::ranges::any_of(face, [&](int v) {
      return blocks.of[static_cast<size_t>(v)] != blocks.of[static_cast<size_t>(face[0])];
    });
  });
  lower(1, [&](const Triangle& face) {
    return std::ranges::any_of(face, [&](int v) { return depths[static_cast<size_t>(v)] == 0; });
  });
  return depths;
}

class BlockCollapses {
 public:
  BlockCollapses(WorkingMesh& mesh, const CollapseOptions& options, double shortest,
                 const std::vector<char>& depths)
      : m_(mesh), t_(mesh.halfedges), options_(options), shortest_(shortest), depths_(depths) {}

  int run(int first_vertex, int end_vertex) {
    for (int v = first_vertex; v < end_vertex; ++v) {
      if (!is_deep(v)) continue;
      for (int h : t_.outgoing(v))
        if (h > t_.twin(h)) push(h);
    }
    int collapses = 0;
    for (int h = pop(); h >= 0; h = pop()) {
      const int stays = collapse_edge(m_, h, options_);
      if (stays < 0) continue;
      ++collapses;
      for (int outgoing : t_.outgoing(stays)) push(outgoing);
    }
    return collapses;
  }

 private:
  bool is_deep(int v) const { return depths_[static_cast<size_t>(v)] == 2; }

  void push(int h) {
    if (!is_deep(t_.from(h)) || !is_deep(t_.to(h)) || t_.is_feature_edge(h)) return;
    if (const double length = relative_length(m_, h); length < shortest_) waiting_.emplace(length, h);
  }

  /// The shortest waiting edge whose entry is up to date: the half-edge may represent another edge by now, or
  /// have another length. -1 if there is none.
  int pop() {
    while (!waiting_.empty()) {
      const auto [length, h] = waiting_.top();
      waiting_.pop();
      if (!t_.is_removed(h / 3) && !t_.is_feature_edge(h) && relative_length(m_, h) == length) return h;
    }
    return -1;
  }

  WorkingMesh& m_;
  const HalfedgeMesh& t_;
  const CollapseOptions& options_;
  double shortest_;
  const std::vector<char>& depths_;
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> waiting_;
};

int vertex_count(const HalfedgeMesh& t) {
  int count = 0;
  for (int v = 0; v < t.id_count(); ++v) count += t.valence(v) > 0;
  return count;
}

/// Share of all half-edges whose relative length is less than this.
double share_of_shorter(const WorkingMesh& m, double length) {
  const HalfedgeMesh& t = m.halfedges;
  const auto count = [&](const auto& counts) {
    return parallel_sum(static_cast<size_t>(t.half_edge_count()), 4096, [&](size_t begin, size_t end) {
      double sum = 0;
      for (size_t i = begin; i < end; ++i) {
        const int h = static_cast<int>(i);
        sum += !t.is_removed(h / 3) && counts(h);
      }
      return sum;
    });
  };
  return count([&](int h) { return relative_length(m, h) < length; }) / count([](int) { return true; });
}

int collapse_in(const Blocks& blocks, WorkingMesh& m, const CollapseOptions& options, double shortest) {
  const std::vector<char> depths = depths_in(blocks, m.halfedges);
  std::vector<int> collapses(blocks.first.size() - 1, 0);
  parallel_for(collapses.size(), 1, [&](size_t begin, size_t end) {
    for (size_t b = begin; b < end; ++b)
      collapses[b] = BlockCollapses(m, options, shortest, depths).run(blocks.first[b], blocks.first[b + 1]);
  });
  return std::accumulate(collapses.begin(), collapses.end(), 0);
}

}  // namespace

int collapse_in_blocks(WorkingMesh& m, const CollapseOptions& options, const BlockOptions& o) {
  const HalfedgeMesh& t = m.halfedges;
  const double shortest = o.length_factor * options.shortest;
  if (t.id_count() < 2 * o.vertices || share_of_shorter(m, shortest) < o.min_share) return 0;
  int collapses = 0;
  for (int pass = 0; pass < o.passes; ++pass) {
    const int size = std::min(o.vertices, vertex_count(t) / 2);
    collapses += collapse_in(cut_into_blocks(t, size, pass * size / o.passes), m, options, shortest);
  }
  return collapses;
}

namespace {

/// Maximum number of edges tested in parallel, all against the mesh before their collapses.
constexpr size_t collapse_batch_size = 1024;

std::vector<std::optional<Collapse>> find_collapses(const WorkingMesh& m, const std::vector<int>& edges,
                                                    const CollapseOptions& options) {
  std::vector<std::optional<Collapse>> collapses(edges.size());
  parallel_for(edges.size(), 16, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) collapses[i] = find_collapse(m, edges[i], options);
  });
  return collapses;
}

}  // namespace

int collapse_short_edges(WorkingMesh& m, const CollapseOptions& options) {
  int collapses = collapse_in_blocks(m, options, {});
  EdgeQueue queue(m.halfedges, [&](int h) { return options.shortest - relative_length(m, h); });
  const auto next_edges = [&] {
    return queue.pop_apart(collapse_batch_size,
                           [&](int h) { return valence_after(m, h) <= options.valence; });
  };
  for (std::vector<int> edges = next_edges(); !edges.empty(); edges = next_edges())
    for (const std::optional<Collapse>& collapse : find_collapses(m, edges, options)) {
      // Other edges of its curve may have collapsed.
      if (!collapse || !may_remove_curve_edge(m, collapse->half_edge)) continue;
      make_collapse(m, *collapse);
      queue.push_around(collapse->stays);
      ++collapses;
    }
  m.retraction.count();
  return collapses;
}

namespace {

/// Collapses the first edge for which it is allowed, of the face or at its corners.
bool collapse_about(WorkingMesh& m, int face, const CollapseOptions& options) {
  const HalfedgeMesh& t = m.halfedges;
  for (int h = 3 * face; h < 3 * face + 3; ++h)
    if (collapse_edge(m, h, options) >= 0) return true;
  for (int corner : t.faces()[static_cast<size_t>(face)])
    for (int h : t.outgoing(corner))
      if (collapse_edge(m, h, options) >= 0) return true;
  return false;
}

}  // namespace

int collapse_folded_faces(WorkingMesh& m, const CollapseOptions& options) {
  const HalfedgeMesh& t = m.halfedges;
  const auto is_folded = [&](int f) {
    const auto face = static_cast<size_t>(f);
    return face_alignment(m.positions.points, m.positions.normals, t.faces()[face], t.wedges()[face]) <
           options.alignment;
  };
  const int count = t.half_edge_count() / 3;
  int collapses = 0;
  for (int f = 0; f < count; ++f)
    collapses += !t.is_removed(f) && is_folded(f) && collapse_about(m, f, options);
  m.retraction.count();
  return collapses;
}

}  // namespace hooke
