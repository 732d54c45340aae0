#include "hooke/mesh/vertex_coloring.h"

#include <algorithm>

#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

constexpr size_t fan_block = 1024;  // vertices per parallel task

/// Small meshes get small blocks, so that a colour has work for several threads.
int block_size(int vertex_count) {
  return std::clamp(vertex_count / 128, 8, 256);
}

/// The face on the other side of the edge; -1 without one.
int face_across(const Adjacency& c, int edge, int face) {
  const auto [a, b] = c.edge_faces[edge];
  return a == face ? b : a;
}

/// The opposite vertex across edge k of the face; -1 without one.
int vertex_across(const Adjacency& c, int face, size_t k) {
  const int edge = c.face_edges[face][k];
  const int other = face_across(c, edge, face);
  if (other < 0) return -1;
  for (int v : c.faces[other])
    if (v != c.edges[edge][0] && v != c.edges[edge][1]) return v;
  return -1;
}

/// The first face of a fan: the clockwise one at the boundary, or the given face of a closed fan.
int first_of_fan(const Adjacency& c, int vertex, int start) {
  for (int face = start;;) {
    const size_t f = face;
    const int before = face_across(c, c.face_edges[f][corner_of(c.faces[f], vertex)], face);
    if (before < 0) return face;
    if (before == start) return start;
    face = before;
  }
}

/// Writes the ring entries of one fan, beginning with this face; returns the end.
RingEntry* write_fan(const Adjacency& c, int vertex, int start, RingEntry* out) {
  for (int face = start;;) {
    const size_t f = face;
    const Triangle& t = c.faces[f];
    const size_t k = corner_of(t, vertex), next = (k + 1) % 3, last = (k + 2) % 3;
    *out++ = {t[next], c.face_edges[f][k], face, vertex_across(c, face, next)};
    const int after = face_across(c, c.face_edges[f][last], face);
    if (after < 0) *out++ = {t[last], c.face_edges[f][last], -1, -1};
    if (after < 0 || after == start) return out;
    face = after;
  }
}

void write_ring(const Adjacency& c, int vertex, RingEntry* out) {
  const auto faces = c.vertex_faces[vertex];
  if (faces.empty()) return;
  const RingEntry* begin = out;
  const RingEntry* end = begin + c.vertex_edges[vertex].size();
  out = write_fan(c, vertex, first_of_fan(c, vertex, faces[0]), out);
  for (size_t i = 1; out < end && i < faces.size(); ++i) {  // fans that touch only at the vertex
    const int first = first_of_fan(c, vertex, faces[i]);
    const bool written = std::any_of(begin, static_cast<const RingEntry*>(out),
                                     [&](const RingEntry& s) { return s.face == first; });
    if (!written) out = write_fan(c, vertex, first, out);
  }
}

VertexRings make_rings_of_mesh(const Adjacency& c) {
  VertexRings rings;
  rings.first = c.vertex_edges.first;
  rings.items.resize(c.vertex_edges.items.size());
  parallel_for(c.vertex_count, fan_block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      write_ring(c, static_cast<int>(v), rings.items.data() + rings.first[v]);
  });
  return rings;
}

/// Rings of the mesh cut open at its creases, in vertices of the mesh itself.
VertexRings make_wedge_rings(const Adjacency& c) {
  const Adjacency cut = cut_open(c);
  VertexRings rings = make_rings_of_mesh(cut);
  const auto vertex_of = [&](int wedge) {
    return wedge < c.vertex_count ? wedge : c.extra_wedges[wedge - c.vertex_count];
  };
  for (int s = 0; s < cut.vertex_count; ++s) {
    const int v = vertex_of(s);
    int face = -1;
    rings.crease_opposite.push_back(-1);
    for (int i = rings.first[s]; i < rings.first[s + 1]; ++i) {
      RingEntry& entry = rings.items[i];
      rings.wedges.push_back(entry.neighbour);
      entry.neighbour = vertex_of(entry.neighbour);
      if (entry.face >= 0) face = entry.face;
      const size_t f = face;
      const size_t k = corner_of(c.faces[f], v), far = (k + 1) % 3;
      entry.across = entry.face >= 0 ? vertex_across(c, face, far) : -1;
      rings.far_crease.push_back(entry.face >= 0 && c.is_crease(c.face_edges[f][far]));
      entry.edge = c.face_edges[f][entry.face >= 0 ? k : (k + 2) % 3];
      if (i == rings.first[s] && c.is_crease(entry.edge))
        rings.crease_opposite.back() = vertex_across(c, face, k);
      const size_t e = entry.edge;
      rings.owned.push_back(c.wedge_edges[e][c.edges[e][0] == v ? 0 : 1] == s);
    }
  }
  return rings;
}

/// Block adjacency: the other blocks on which the vertices of each block depend, which is symmetric.
std::vector<std::vector<int>> block_adjacency(const VertexRings& rings, const Adjacency& c, int block) {
  const int vertex_count = c.vertex_count;
  const size_t blocks = (vertex_count + block - 1) / block;
  std::vector<std::vector<int>> adjacent(blocks);
  const auto extra_wedge = [&](int vertex) -> size_t {  // first one of this vertex or a later one
    return std::ranges::lower_bound(c.extra_wedges, vertex) - c.extra_wedges.begin();
  };
  parallel_for(blocks, 8, [&](size_t begin, size_t end) {
    for (size_t b = begin; b < end; ++b) {
      const int first = static_cast<int>(b) * block, last = std::min(first + block, vertex_count);
      const auto from = rings.items.begin() + rings.first[first];
      const auto to = rings.items.begin() + rings.first[last];
      const auto visit = [&](const RingEntry& s) {
        for (int v : {s.neighbour, s.across})
          if (v >= 0 && (v < first || v >= last)) adjacent[b].push_back(v / block);
      };
      std::for_each(from, to, visit);
      for (size_t i = extra_wedge(first); i < extra_wedge(last); ++i)
        for (const RingEntry& s : rings[vertex_count + static_cast<int>(i)]) visit(s);
      sort_unique(adjacent[b]);
    }
  });
  return adjacent;  // symmetric: each vertex is opposite to its opposite vertices
}

/// First-fit colouring in the order of the blocks.
std::vector<std::vector<int>> first_fit_coloring(const std::vector<std::vector<int>>& neighbours) {
  std::vector<int> color(neighbours.size(), -1);
  std::vector<std::vector<int>> colors;
  std::vector<char> used;
  for (size_t b = 0; b < neighbours.size(); ++b) {
    used.assign(colors.size() + 1, 0);
    for (int n : neighbours[b])
      if (color[n] >= 0) used[color[n]] = 1;
    const size_t free = std::ranges::find(used, 0) - used.begin();
    if (free == colors.size()) colors.emplace_back();
    colors[free].push_back(static_cast<int>(b));
    color[b] = static_cast<int>(free);
  }
  return colors;
}

VertexColoring make_rings(const Adjacency& adjacency) {
  VertexColoring coloring;
  coloring.rings = adjacency.creases.empty() ? make_rings_of_mesh(adjacency) : make_wedge_rings(adjacency);
  coloring.vertices = adjacency.vertex_count;
  return coloring;
}

}  // namespace

VertexColoring color_vertices(const Adjacency& adjacency) {
  VertexColoring coloring = make_rings(adjacency);
  coloring.block = block_size(adjacency.vertex_count);
  coloring.colors = first_fit_coloring(block_adjacency(coloring.rings, adjacency, coloring.block));
  return coloring;
}

VertexColoring color_as_one_block(const Adjacency& adjacency) {
  VertexColoring coloring = make_rings(adjacency);
  coloring.block = std::max(1, coloring.vertices);
  coloring.colors = {{0}};
  return coloring;
}

void for_each_block(const VertexColoring& coloring, const std::function<void(int begin, int end)>& body) {
  for (const std::vector<int>& color : coloring.colors)
    parallel_for(color.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        body(color[i] * coloring.block, std::min(coloring.vertices, (color[i] + 1) * coloring.block));
    });
}

}  // namespace hooke
