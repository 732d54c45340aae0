#include "hooke/connectivity.h"

#include <algorithm>

namespace hooke {
namespace {

/// Lists the rows that name each index; `per_row(row)` yields the indices that the row names.
template <typename Rows>
IntLists invert(int count, const Rows& rows) {
  IntLists lists;
  lists.first.assign(static_cast<size_t>(count) + 1, 0);
  for (const auto& row : rows)
    for (int i : row) ++lists.first[static_cast<size_t>(i) + 1];
  for (size_t i = 0; i < static_cast<size_t>(count); ++i) lists.first[i + 1] += lists.first[i];
  lists.items.resize(static_cast<size_t>(lists.first.back()));
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  for (size_t r = 0; r < rows.size(); ++r)
    for (int i : rows[r])
      lists.items[static_cast<size_t>(next[static_cast<size_t>(i)]++)] = static_cast<int>(r);
  return lists;
}

}  // namespace

Connectivity make_connectivity(int vertex_count, std::vector<Triangle> faces) {
  Connectivity c;
  c.vertex_count = vertex_count;
  c.faces = std::move(faces);
  c.face_edges.resize(c.faces.size());
  c.vertex_faces = invert(vertex_count, c.faces);

  for (size_t f = 0; f < c.faces.size(); ++f) {
    for (size_t k = 0; k < 3; ++k) {
      const int a = c.faces[f][k];
      const int b = c.faces[f][(k + 1) % 3];
      int edge = -1;
      for (int g : c.vertex_faces[a]) {  // the face across, if it came before
        if (g >= static_cast<int>(f)) break;
        for (size_t m = 0; m < 3; ++m)
          if (c.faces[static_cast<size_t>(g)][m] == b && c.faces[static_cast<size_t>(g)][(m + 1) % 3] == a)
            edge = c.face_edges[static_cast<size_t>(g)][m];
      }
      if (edge < 0) {
        edge = static_cast<int>(c.edges.size());
        c.edges.push_back({a, b});
        c.edge_faces.push_back({static_cast<int>(f), -1});
      } else {
        c.edge_faces[static_cast<size_t>(edge)][1] = static_cast<int>(f);
      }
      c.face_edges[f][k] = edge;
    }
  }
  c.vertex_edges = invert(vertex_count, c.edges);
  c.vertex_neighbours = c.vertex_edges;
  for (int v = 0; v < vertex_count; ++v) {
    const auto begin = static_cast<size_t>(c.vertex_edges.first[static_cast<size_t>(v)]);
    const auto end = static_cast<size_t>(c.vertex_edges.first[static_cast<size_t>(v) + 1]);
    for (size_t i = begin; i < end; ++i) {
      const Edge& e = c.edges[static_cast<size_t>(c.vertex_edges.items[i])];
      c.vertex_neighbours.items[i] = e[0] == v ? e[1] : e[0];
    }
  }
  return c;
}

}  // namespace hooke
