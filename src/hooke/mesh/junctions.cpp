#include "hooke/mesh/junctions.h"

#include <fmt/format.h>

#include <algorithm>

#include "hooke/core/error.h"
#include "hooke/mesh/disjoint_sets.h"

namespace hooke {

void set_joined_vertices(TriMesh& mesh, const std::vector<int>& joined) {
  auto stored = OpenMesh::getOrMakeProperty<OpenMesh::VertexHandle, int>(mesh, joined_property);
  for (const auto v : mesh.vertices()) stored[v] = joined[v.idx()];
}

std::vector<int> joined_vertices(const TriMesh& mesh) {
  OpenMesh::VPropHandleT<int> handle;
  if (!mesh.get_property_handle(handle, joined_property)) return {};
  const std::vector<int>& values = mesh.property(handle).data_vector();
  return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(mesh.n_vertices())};
}

std::vector<int> joined_vertices(const TriMesh& mesh, const Permutation& order) {
  const std::vector<int> by_id = joined_vertices(mesh);
  if (by_id.empty()) return {};
  std::vector<int> index(by_id.size()), joined;
  for (std::size_t v = 0; v < index.size(); ++v) index[order.old_vertex[v]] = static_cast<int>(v);
  joined.reserve(by_id.size());
  for (const int id : order.old_vertex) joined.push_back(index[by_id[id]]);
  return joined;
}

std::vector<Triangle> join_faces(std::vector<Triangle> faces, const std::vector<int>& joined) {
  if (!joined.empty())
    for (Triangle& t : faces)
      for (int& v : t) v = joined[v];
  return faces;
}

namespace {

struct JoinedEdge {
  Edge ends;  // of the joined mesh, smaller one first
  int edge;   // of the sheets
  auto operator<=>(const JoinedEdge&) const = default;
};

/// All edges of the sheets, those that are one in the joined mesh side by side.
std::vector<JoinedEdge> joined_edges(const Adjacency& c, const std::vector<int>& joined) {
  std::vector<JoinedEdge> edges(c.edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [low, high] = std::minmax(joined[c.edges[e][0]], joined[c.edges[e][1]]);
    edges[e] = {{low, high}, static_cast<int>(e)};
  }
  std::ranges::sort(edges);
  return edges;
}

/// Calls visit(ends, begin, end) for each edge of the joined mesh, with those of the sheets that it is.
template <typename Visit>
void for_each_joined(const std::vector<JoinedEdge>& edges, const Visit& visit) {
  for (auto begin = edges.begin(), end = begin; begin != edges.end(); begin = end) {
    end = std::find_if(begin, edges.end(), [&](const JoinedEdge& e) { return e.ends != begin->ends; });
    visit(begin->ends, begin, end);
  }
}

int face_count(const Adjacency& c, auto begin, auto end) {
  int faces = 0;
  for (auto e = begin; e != end; ++e) faces += c.is_boundary_edge(e->edge) ? 1 : 2;
  return faces;
}

}  // namespace

std::vector<int> label_shells(const Adjacency& c, const std::vector<int>& joined) {
  DisjointSets shells(c.vertex_count);
  for (const Edge& e : c.edges) shells.join(e);
  for (std::size_t v = 0; v < joined.size(); ++v) shells.join({static_cast<int>(v), joined[v]});
  std::vector<int> number(c.vertex_count, -1), labels;
  int count = 0;
  for (int v = 0; v < c.vertex_count; ++v) {
    int& of_shell = number[shells.root(v)];
    const bool has_faces = !c.vertex_faces[v].empty();
    if (of_shell < 0 && has_faces) of_shell = count++;
    labels.push_back(has_faces ? of_shell : -1);
  }
  return labels;
}

Junctions find_junctions(const Adjacency& c, const std::vector<int>& joined) {
  Junctions junctions;
  if (joined.empty()) return junctions;
  std::vector<int> copies(joined.size(), 0);
  std::vector<char> at_junction(joined.size(), 0);
  for (const int v : joined) ++copies[v];
  for (std::size_t v = 0; v < joined.size(); ++v) at_junction[v] = copies[joined[v]] > 1;
  for_each_joined(joined_edges(c, joined), [&](const Edge&, auto begin, auto end) {
    if (end - begin < 2) return;
    for (auto e = begin; e != end; ++e) {
      const auto [low, high] = std::minmax(c.edges[e->edge][0], c.edges[e->edge][1]);
      junctions.edges.push_back({low, high});
      at_junction[low] = at_junction[high] = 1;
    }
  });
  std::ranges::sort(junctions.edges);
  for (std::size_t v = 0; v < at_junction.size(); ++v)
    if (at_junction[v]) junctions.vertices.push_back(static_cast<int>(v));
  return junctions;
}

Warnings require_valid_sheets(const Mat3X& points, const std::vector<Triangle>& sheets,
                              const std::vector<int>& joined, MeshSource source) {
  Warnings warnings = require_valid(points, join_faces(sheets, joined), source);
  source.keeps_junctions = false;
  if (!joined.empty()) require_valid(points, sheets, source);
  return warnings;
}

std::vector<char> first_of_joined(const Adjacency& c, const std::vector<int>& joined) {
  std::vector<char> first(c.edges.size(), joined.empty() ? 1 : 0);
  if (joined.empty()) return first;
  for_each_joined(joined_edges(c, joined), [&](const Edge&, auto begin, auto) { first[begin->edge] = 1; });
  return first;
}

Topology measure_topology(const Adjacency& c, const std::vector<int>& joined) {
  if (joined.empty()) return measure_topology(c);
  Topology t;
  t.faces = static_cast<int>(c.faces.size());
  DisjointSets components(joined.size()), boundaries(joined.size());
  std::vector<char> is_used(joined.size(), 0), on_boundary(joined.size(), 0);
  for_each_joined(joined_edges(c, joined), [&](const Edge& ends, auto begin, auto end) {
    ++t.edges;
    components.join(ends);
    for (const int v : ends) is_used[v] = 1;
    const int faces = face_count(c, begin, end);
    if (end - begin > 1) ++t.junction_edges;
    if (faces > 1) return;
    ++t.boundary_edges;
    boundaries.join(ends);
    for (const int v : ends) on_boundary[v] = 1;
  });
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const int v = static_cast<int>(i);
    if (joined[i] != v) continue;
    ++t.vertices;
    t.isolated_vertices += !is_used[i];
    t.components += is_used[i] && components.root(v) == v;
    t.boundary_loops += on_boundary[i] && boundaries.root(v) == v;
  }
  t.euler = t.vertices - t.isolated_vertices - t.edges + t.faces;
  return t;
}

Valence count_valences(const Adjacency& c, const std::vector<int>& joined) {
  if (joined.empty()) return count_valences(c);
  std::vector<int> edges(joined.size(), 0);
  std::vector<char> on_boundary(joined.size(), 0);
  for_each_joined(joined_edges(c, joined), [&](const Edge& ends, auto begin, auto end) {
    for (const int v : ends) {
      ++edges[v];
      if (face_count(c, begin, end) == 1) on_boundary[v] = 1;
    }
  });
  Valence valence;
  for (std::size_t v = 0; v < joined.size(); ++v) {
    if (edges[v] == 0) continue;
    std::vector<int>& counts = on_boundary[v] ? valence.boundary : valence.interior;
    const std::size_t n = edges[v];
    if (counts.size() <= n) counts.resize(n + 1, 0);
    ++counts[n];
  }
  return valence;
}

bool JunctionCounts::same_network(const JunctionCounts& other) const {
  const auto occurs = [](const JunctionCounts& counts, std::size_t k) {
    return k < counts.faces.size() && counts.faces[k] > 0;
  };
  for (std::size_t k = 0; k < std::max(faces.size(), other.faces.size()); ++k)
    if (occurs(*this, k) != occurs(other, k)) return false;
  return curves == other.curves && nodes == other.nodes;
}

JunctionCounts count_junctions(const Adjacency& c, const std::vector<int>& joined) {
  JunctionCounts counts;
  if (joined.empty()) return counts;
  struct End {
    int degree = 0, faces = 0;
    bool changes = false;  // in the number of faces
  };
  std::vector<End> ends_at(joined.size());
  std::vector<std::pair<Edge, int>> edges;  // and their faces
  for_each_joined(joined_edges(c, joined), [&](const Edge& ends, auto begin, auto end) {
    if (end - begin < 2) return;
    const int faces = face_count(c, begin, end);
    const std::size_t n = faces;
    if (counts.faces.size() <= n) counts.faces.resize(n + 1, 0);
    ++counts.faces[n];
    edges.emplace_back(ends, faces);
    for (const int v : ends) {
      End& at = ends_at[v];
      at.changes |= at.degree > 0 && at.faces != faces;
      at.faces = faces;
      ++at.degree;
    }
  });
  counts.edges = static_cast<int>(edges.size());
  const auto is_node = [&](int v) { return ends_at[v].degree != 2 || ends_at[v].changes; };
  DisjointSets loops(joined.size());
  int ends_of_curves = 0;
  for (const auto& [ends, faces] : edges) {
    for (const int v : ends) ends_of_curves += is_node(v);
    loops.join(ends);
  }
  std::vector<char> has_node(joined.size(), 0);
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const int v = static_cast<int>(i);
    if (ends_at[i].degree == 0 || !is_node(v)) continue;
    ++counts.nodes;
    has_node[loops.root(v)] = 1;
  }
  counts.curves = ends_of_curves / 2;
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const int v = static_cast<int>(i);
    counts.curves += ends_at[i].degree > 0 && loops.root(v) == v && !has_node[i];
  }
  return counts;
}

Mat3X JoinedMesh::gather(const Eigen::Ref<const Mat3X>& of_sheets) const {
  return of_sheets(Eigen::all, vertices);
}

Mat3X JoinedMesh::scatter(const Mat3X& of_joined) const {
  return of_joined(Eigen::all, id);
}

VertexData JoinedMesh::gather(const VertexData& of_sheets) const {
  VertexData data = of_sheets;
  for (VertexChannel& channel : data) {
    std::vector<double> values;
    for (const int v : vertices) values.push_back(channel.values[v]);
    channel.values = std::move(values);
  }
  if (!has_normals(data)) return data;
  Mat3X normals = Mat3X::Zero(3, std::ssize(vertices)), firsts = normals;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const std::vector<double>& values = find_channel(of_sheets, normal_names[k])->values;
    for (std::size_t v = 0; v < id.size(); ++v) normals(k, id[v]) += values[v];
    for (std::size_t v = 0; v < vertices.size(); ++v)
      firsts(k, static_cast<Eigen::Index>(v)) = values[vertices[v]];
  }
  std::vector<int> copies(vertices.size(), 0);
  for (const int v : id) ++copies[v];
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const auto v = static_cast<Eigen::Index>(i);
    constexpr double opposite = 1e-9;  // then that of the first is as good as any
    if (copies[i] == 1 || normals.col(v).norm() < opposite)
      normals.col(v) = firsts.col(v);
    else
      normals.col(v).normalize();
  }
  set_normals(data, normals);
  return data;
}

std::optional<JoinedMesh> join_sheets(const TriMesh& sheets) {
  const std::vector<int> joined = joined_vertices(sheets);
  if (joined.empty()) return std::nullopt;
  const auto points = vertex_points(sheets);
  JoinedMesh mesh;
  mesh.id.resize(joined.size());
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const int v = static_cast<int>(i);
    if (joined[i] == v) {
      mesh.id[i] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(v);
    } else if (points.col(v) != points.col(joined[i])) {
      throw ResultError(fmt::format(
          "the sheets that meet in vertex {} have come apart, at {:.6g} {:.6g} {:.6g}; expected its "
          "copies in one place; try another --connectivity, or --repair without --keep "
          "non-manifold, which cuts the sheets apart",
          mesh.id[joined[i]], points(0, v), points(1, v), points(2, v)));
    }
  }
  for (std::size_t i = 0; i < joined.size(); ++i) mesh.id[i] = mesh.id[joined[i]];
  mesh.triangles = join_faces(triangles_of(sheets), mesh.id);
  return mesh;
}

}  // namespace hooke
