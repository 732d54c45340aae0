#include "hooke/mesh/vertex_coloring.h"

#include <algorithm>

#include "hooke/core/parallel.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

constexpr size_t fan_block = 1024;  // vertices whose spokes one task finds

/// Small meshes get small blocks, so that a wave has work for several threads.
int block_size(int vertex_count) {
  return std::clamp(vertex_count / 128, 8, 256);
}

size_t corner_of(const Triangle& face, int vertex) {
  return face[0] == vertex ? 0 : face[1] == vertex ? 1 : 2;
}

/// The face on the other side of the edge; -1 without one.
int beyond(const Connectivity& c, int edge, int face) {
  const auto [a, b] = c.edge_faces[static_cast<size_t>(edge)];
  return a == face ? b : a;
}

/// The vertex across the edge k of the face; -1 without one.
int vertex_across(const Connectivity& c, int face, size_t k) {
  const int edge = c.face_edges[static_cast<size_t>(face)][k];
  const int other = beyond(c, edge, face);
  if (other < 0) return -1;
  for (int v : c.faces[static_cast<size_t>(other)])
    if (v != c.edges[static_cast<size_t>(edge)][0] && v != c.edges[static_cast<size_t>(edge)][1]) return v;
  return -1;
}

/// The first face of a fan: the one at the boundary, clockwise, or the face itself.
int first_of_fan(const Connectivity& c, int vertex, int start) {
  for (int face = start;;) {
    const auto f = static_cast<size_t>(face);
    const int before = beyond(c, c.face_edges[f][corner_of(c.faces[f], vertex)], face);
    if (before < 0) return face;
    if (before == start) return start;
    face = before;
  }
}

/// Writes the spokes of one fan, beginning with this face; returns the end.
Spoke* write_fan(const Connectivity& c, int vertex, int start, Spoke* out) {
  for (int face = start;;) {
    const auto f = static_cast<size_t>(face);
    const Triangle& t = c.faces[f];
    const size_t k = corner_of(t, vertex), next = (k + 1) % 3, last = (k + 2) % 3;
    *out++ = {t[next], c.face_edges[f][k], face, vertex_across(c, face, next)};
    const int after = beyond(c, c.face_edges[f][last], face);
    if (after < 0) *out++ = {t[last], c.face_edges[f][last], -1, -1};
    if (after < 0 || after == start) return out;
    face = after;
  }
}

void write_spokes(const Connectivity& c, int vertex, Spoke* out) {
  const auto faces = c.vertex_faces[vertex];
  if (faces.empty()) return;
  const Spoke* begin = out;
  const Spoke* end = begin + c.vertex_edges[vertex].size();
  out = write_fan(c, vertex, first_of_fan(c, vertex, faces[0]), out);
  for (size_t i = 1; out < end && i < faces.size(); ++i) {  // fans that touch in a point
    const int first = first_of_fan(c, vertex, faces[i]);
    const bool written =
        std::any_of(begin, static_cast<const Spoke*>(out), [&](const Spoke& s) { return s.face == first; });
    if (!written) out = write_fan(c, vertex, first, out);
  }
}

Spokes make_spokes(const Connectivity& c) {
  Spokes spokes;
  spokes.first = c.vertex_edges.first;
  spokes.items.resize(c.vertex_edges.items.size());
  parallel_for(static_cast<size_t>(c.vertex_count), fan_block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      write_spokes(c, static_cast<int>(v), spokes.items.data() + spokes.first[v]);
  });
  return spokes;
}

/// Spokes of the mesh cut open at its creases, in terms of the mesh itself.
Spokes make_parted_spokes(const Connectivity& c) {
  const Connectivity cut = cut_open(c);
  Spokes spokes = make_spokes(cut);
  const auto vertex_of = [&](int side) {
    return side < c.vertex_count ? side : c.further_sides[static_cast<size_t>(side - c.vertex_count)];
  };
  for (int s = 0; s < cut.vertex_count; ++s) {
    const int v = vertex_of(s);
    int face = -1;
    spokes.mate.push_back(-1);
    for (int i = spokes.first[static_cast<size_t>(s)]; i < spokes.first[static_cast<size_t>(s) + 1]; ++i) {
      Spoke& spoke = spokes.items[static_cast<size_t>(i)];
      spokes.sides.push_back(spoke.neighbour);
      spoke.neighbour = vertex_of(spoke.neighbour);
      if (spoke.face >= 0) face = spoke.face;
      const auto f = static_cast<size_t>(face);
      const size_t k = corner_of(c.faces[f], v), far = (k + 1) % 3;
      spoke.across = spoke.face >= 0 ? vertex_across(c, face, far) : -1;
      spokes.far_crease.push_back(spoke.face >= 0 && c.is_crease(c.face_edges[f][far]));
      spoke.edge = c.face_edges[f][spoke.face >= 0 ? k : (k + 2) % 3];
      if (i == spokes.first[static_cast<size_t>(s)] && c.is_crease(spoke.edge))
        spokes.mate.back() = vertex_across(c, face, k);
      const auto e = static_cast<size_t>(spoke.edge);
      spokes.owned.push_back(c.side_edges[e][c.edges[e][0] == v ? 0 : 1] == s);
    }
  }
  return spokes;
}

/// The other blocks that the vertices of each block look at, and those that look at them.
std::vector<std::vector<int>> blocks_seen(const Spokes& spokes, const Connectivity& c, int block) {
  const int vertex_count = c.vertex_count;
  const auto blocks = static_cast<size_t>((vertex_count + block - 1) / block);
  std::vector<std::vector<int>> seen(blocks);
  const auto further_side = [&](int vertex) {  // the first of this vertex or a later one
    return static_cast<size_t>(std::ranges::lower_bound(c.further_sides, vertex) - c.further_sides.begin());
  };
  parallel_for(blocks, 8, [&](size_t begin, size_t end) {
    for (size_t b = begin; b < end; ++b) {
      const int first = static_cast<int>(b) * block, last = std::min(first + block, vertex_count);
      const auto from = spokes.items.begin() + spokes.first[static_cast<size_t>(first)];
      const auto to = spokes.items.begin() + spokes.first[static_cast<size_t>(last)];
      const auto look = [&](const Spoke& s) {
        for (int v : {s.neighbour, s.across})
          if (v >= 0 && (v < first || v >= last)) seen[b].push_back(v / block);
      };
      std::for_each(from, to, look);
      for (size_t i = further_side(first); i < further_side(last); ++i)
        for (const Spoke& s : spokes[vertex_count + static_cast<int>(i)]) look(s);
      std::ranges::sort(seen[b]);
      seen[b].erase(std::unique(seen[b].begin(), seen[b].end()), seen[b].end());
    }
  });
  return seen;  // what lies across from a vertex has it across: the relation is symmetric
}

/// First fit in the order of the blocks.
std::vector<std::vector<int>> colour(const std::vector<std::vector<int>>& neighbours) {
  std::vector<int> wave(neighbours.size(), -1);
  std::vector<std::vector<int>> waves;
  std::vector<char> used;
  for (size_t b = 0; b < neighbours.size(); ++b) {
    used.assign(waves.size() + 1, 0);
    for (int n : neighbours[b])
      if (wave[static_cast<size_t>(n)] >= 0) used[static_cast<size_t>(wave[static_cast<size_t>(n)])] = 1;
    const auto free = static_cast<size_t>(std::ranges::find(used, 0) - used.begin());
    if (free == waves.size()) waves.emplace_back();
    waves[free].push_back(static_cast<int>(b));
    wave[b] = static_cast<int>(free);
  }
  return waves;
}

SweepPlan without_waves(const Connectivity& connectivity) {
  SweepPlan plan;
  plan.spokes = connectivity.creases.empty() ? make_spokes(connectivity) : make_parted_spokes(connectivity);
  plan.vertices = connectivity.vertex_count;
  return plan;
}

}  // namespace

SweepPlan plan_sweeps(const Connectivity& connectivity) {
  SweepPlan plan = without_waves(connectivity);
  plan.block = block_size(connectivity.vertex_count);
  plan.waves = colour(blocks_seen(plan.spokes, connectivity, plan.block));
  return plan;
}

SweepPlan plan_one_block(const Connectivity& connectivity) {
  SweepPlan plan = without_waves(connectivity);
  plan.block = std::max(1, plan.vertices);
  plan.waves = {{0}};
  return plan;
}

void for_each_block(const SweepPlan& plan, const std::function<void(int begin, int end)>& body) {
  for (const std::vector<int>& wave : plan.waves)
    parallel_for(wave.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        body(wave[i] * plan.block, std::min(plan.vertices, (wave[i] + 1) * plan.block));
    });
}

}  // namespace hooke
