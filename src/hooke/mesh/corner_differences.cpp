#include "hooke/mesh/corner_differences.h"

namespace hooke {

CornerDifferences::CornerDifferences(const MemoryOrder& memory_order, const CornerValues& values)
    : memory_order_(memory_order), values_(values) {
  constexpr double share_of_range = 1e-6;
  if (values.values.cols() > 0)
    tolerance_ = share_of_range * (values.values.rowwise().maxCoeff() - values.values.rowwise().minCoeff());
}

int CornerDifferences::value_in(int face, int vertex) const {
  const Triangle& values = values_.corners[memory_order_.order.old_face[face]];
  return values[corner_of(memory_order_.adjacency->faces[face], vertex)];
}

bool CornerDifferences::differ_at(int edge, int vertex) const {
  const auto& [left, right] = memory_order_.adjacency->edge_faces[edge];
  const int a = value_in(left, vertex), b = value_in(right, vertex);
  if (a == b) return false;
  if (a < 0 || b < 0) return true;
  return ((values_.values.col(a) - values_.values.col(b)).cwiseAbs().array() > tolerance_.array()).any();
}

std::vector<int> CornerDifferences::find_poles() const {
  constexpr int min_edges = 8;  // fewer leave room for good angles
  constexpr double nearly_all = .75;
  const Adjacency& c = *memory_order_.adjacency;
  std::vector<int> poles;
  for (int v = 0; v < c.vertex_count; ++v) {
    const auto edges = c.vertex_edges[v];
    if (std::ssize(edges) < min_edges) continue;
    int different = 0, here_only = 0;
    for (const int e : edges) {
      if (c.is_boundary_edge(e) || !differ_at(e, v)) continue;
      ++different;
      here_only += !differ_at(e, c.other_end(e, v));
    }
    if (here_only >= min_edges && different >= nearly_all * static_cast<double>(edges.size()))
      poles.push_back(v);
  }
  return poles;
}

}  // namespace hooke
