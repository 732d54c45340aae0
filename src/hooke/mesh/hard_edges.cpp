#include "hooke/mesh/hard_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/mesh/corner_differences.h"

namespace hooke {
namespace {

constexpr double hard_degrees = 1;       // between normals, for an edge to be hard
constexpr double equal_degrees = .5;     // up to which normals are the same, in a file with few digits
constexpr double nearly_all = .9;        // share of hard edges between facets in a flat-shaded mesh
constexpr double third_of_all = 1. / 3;  // least share of these in all edges; fewer are a shape's own

class NormalsOfEdges {
 public:
  NormalsOfEdges(const MemoryOrder& memory_order, const CornerValues& normals)
      : c_(*memory_order.adjacency),
        values_(normals.values),
        differences_(memory_order, normals),
        poles_(differences_.find_poles()) {}

  bool have_normals(int edge) const {
    const auto& [left, right] = c_.edge_faces[edge];
    return right >= 0 && normal_in(left, c_.edges[edge][0]) >= 0 && normal_in(right, c_.edges[edge][0]) >= 0;
  }

  /// Do the normals differ by more than that at an end that is no pole?
  bool are_apart(int edge, double degrees) const {
    const auto& [left, right] = c_.edge_faces[edge];
    return std::ranges::any_of(c_.edges[edge], [&, l = left, r = right](int v) {
      const int end = std::ranges::binary_search(poles_, v) ? c_.other_end(edge, v) : v;
      return !are_parallel(normal_in(l, end), normal_in(r, end), degrees);
    });
  }

  /// Do both faces have the same normal at all corners, as those of a polygon with a normal of its own?
  bool is_in_facet(int edge) const {
    const auto& [left, right] = c_.edge_faces[edge];
    const int first = normal_in(left, c_.faces[left][0]);
    const auto are_all_first = [&](int face) {
      return std::ranges::all_of(
          c_.faces[face], [&](int v) { return are_parallel(normal_in(face, v), first, equal_degrees); });
    };
    return are_all_first(left) && are_all_first(right);
  }

 private:
  int normal_in(int face, int vertex) const { return differences_.value_in(face, vertex); }

  bool are_parallel(int a, int b, double degrees) const {
    if (a == b) return true;
    const Vec3 x = values_.col(a), y = values_.col(b);
    return std::atan2(x.cross(y).norm(), x.dot(y)) <= degrees * std::numbers::pi / 180;
  }

  const Adjacency& c_;
  const Mat3X& values_;
  CornerDifferences differences_;
  std::vector<int> poles_;
};

}  // namespace

HardEdges find_hard_edges(const MemoryOrder& memory_order, const CornerValues& normals) {
  HardEdges result;
  if (normals.empty()) return result;
  const Adjacency& c = *memory_order.adjacency;
  const NormalsOfEdges at_edges(memory_order, normals);
  std::size_t all = 0, between_facets = 0, apart = 0;
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    const int edge = static_cast<int>(e);
    if (!at_edges.have_normals(edge)) continue;
    ++all;
    between_facets += !at_edges.is_in_facet(edge);
    apart += at_edges.are_apart(edge, equal_degrees);
    if (at_edges.are_apart(edge, hard_degrees)) result.edges.push_back(edge);
  }
  const auto share = [apart](std::size_t of) { return static_cast<double>(apart) / static_cast<double>(of); };
  result.is_flat_shaded = apart > 0 && share(between_facets) >= nearly_all && share(all) > third_of_all;
  if (result.is_flat_shaded) result.edges.clear();
  for (const int e : result.edges) {
    const auto& [a, b] = c.edges[e];
    result.ends.push_back({memory_order.order.old_vertex[a], memory_order.order.old_vertex[b]});
  }
  return result;
}

}  // namespace hooke
