#include "hooke/remesh/shells.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hooke/connectivity/face_count.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/wedges.h"
#include "hooke/remesh/result.h"

namespace hooke {
namespace {

/// The list `joined` for vertices of which `copies_of` names those that are copies of each other.
std::vector<int> first_copies(const std::vector<int>& copies_of) {
  std::vector<int> first(copies_of.size(), -1), joined;
  for (std::size_t v = 0; v < copies_of.size(); ++v) {
    int& known = first[copies_of[v]];
    if (known < 0) known = static_cast<int>(v);
    joined.push_back(known);
  }
  return joined;
}

/// What of a result goes into another one. `map`: per vertex of the result, in ids of the input of the other.
struct Piece {
  const TriMesh& mesh;
  const RemeshResult& result;
  std::vector<MapEntry> map;
  std::vector<int> vertices = {};  // ids in the mesh, ascending
  std::vector<int> id = {};        // per vertex of the mesh: its id in the other one, or -1
};

Piece piece_of(const PartOfMesh& part, const RemeshedMesh& remeshed) {
  Piece piece{remeshed.mesh, remeshed.result, remeshed.result.map};
  for (MapEntry& e : piece.map) {
    if (e.vertex >= 0) e.vertex = part.vertices[e.vertex];
    if (e.position.face >= 0) e.position.face = part.faces[e.position.face];
  }
  piece.vertices.resize(piece.map.size());
  std::iota(piece.vertices.begin(), piece.vertices.end(), 0);
  return piece;
}

/// The components of a result that do not lie on these faces of the input, which are sorted.
Piece piece_beside(const RemeshedMesh& remeshed, const std::vector<int>& faces) {
  Piece piece{remeshed.mesh, remeshed.result, remeshed.result.map};
  const MemoryOrder& order = piece.result.memory_order;
  const std::vector<int> components = label_components(*order.adjacency);
  std::vector<char> is_on(components.size(), 0);
  for (std::size_t v = 0; v < components.size(); ++v)
    if (std::ranges::binary_search(faces, piece.map[order.order.old_vertex[v]].position.face))
      is_on[components[v]] = 1;
  for (std::size_t v = 0; v < components.size(); ++v)
    if (!is_on[components[v]]) piece.vertices.push_back(order.order.old_vertex[v]);
  std::ranges::sort(piece.vertices);
  return piece;
}

/// Numbers the vertices of the pieces: those of the input in their order, then the new ones. Returns how many
/// there are.
int number_vertices(std::vector<Piece>& pieces) {
  struct Vertex {
    int origin;
    std::size_t piece;
    int id;
  };
  std::vector<Vertex> old, fresh;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (int v : pieces[p].vertices) {
      const int origin = pieces[p].map[v].vertex;
      (origin >= 0 ? old : fresh).push_back({origin, p, v});
    }
  std::ranges::sort(old, {}, &Vertex::origin);
  for (Piece& piece : pieces) piece.id.assign(piece.map.size(), -1);
  int count = 0;
  for (const auto* vertices : {&old, &fresh})
    for (const Vertex& v : *vertices) pieces[v.piece].id[v.id] = count++;
  return count;
}

/// Builds the mesh of a result, and completes what the result tells of it. `joined`: empty without junctions.
TriMesh build_result(const Mat3X& points, const std::vector<Triangle>& faces,
                     const std::vector<double>& lengths, const std::vector<int>& joined,
                     RemeshResult& result) {
  result.memory_order = find_memory_order(static_cast<int>(points.cols()), faces);
  const Permutation& order = result.memory_order.order;
  Adjacency creased = *result.memory_order.adjacency;
  split_wedges(creased, order.new_edges(result.crease_edges));
  const CreaseCounts of_input = result.creases;
  result.creases = count_creases(creased, order, result.vertex_limits);
  result.creases.sharp = of_input.sharp;
  result.creases.dropped = of_input.dropped;
  TriMesh mesh = build_mesh(points, *result.memory_order.adjacency, order.old_ids());
  set_vertex_values(mesh, target_length_property, lengths);
  if (!joined.empty()) set_joined_vertices(mesh, joined);
  return mesh;
}

/// Makes a mesh of the pieces, and sets what the result tells of its vertices, faces and edges.
TriMesh assemble(std::vector<Piece> pieces, RemeshResult& result) {
  const int count = number_vertices(pieces);
  Mat3X points(3, count);
  std::vector<double> lengths(count);
  std::vector<int> copies_of(count);
  std::vector<Triangle> faces;
  std::vector<MapEntry> map(count);
  std::vector<unsigned char> limits(count);
  std::vector<Edge> creases;
  bool has_junctions = false;
  for (const Piece& piece : pieces) {
    const auto piece_points = vertex_points(piece.mesh);
    const std::vector<double> piece_lengths = vertex_values(piece.mesh, target_length_property);
    const std::vector<int> joined = joined_vertices(piece.mesh);
    has_junctions = has_junctions || !joined.empty();
    for (int v : piece.vertices) {
      const int id = piece.id[v];
      points.col(id) = piece_points.col(v);
      lengths[id] = piece_lengths[v];
      copies_of[id] = joined.empty() ? id : piece.id[joined[v]];
      map[id] = piece.map[v];
      limits[id] = piece.result.vertex_limits[v];
    }
    const std::vector<Triangle> triangles = triangles_of(piece.mesh);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      if (piece.id[triangles[f][0]] < 0) continue;
      faces.push_back(triangles[f]);
      for (int& v : faces.back()) v = piece.id[v];
    }
    for (const auto& [a, b] : piece.result.crease_edges)
      if (piece.id[a] >= 0) creases.push_back({piece.id[a], piece.id[b]});
  }
  result.map = std::move(map);
  result.vertex_limits = std::move(limits);
  result.crease_edges = std::move(creases);
  return build_result(points, faces, lengths, has_junctions ? first_copies(copies_of) : std::vector<int>(),
                      result);
}

/// Gives each part the constraints that are about it. Per vertex of the whole: `part_of_vertex`, as in
/// parts_of_mesh(), and its id in the part.
void share_constraints(const ConstraintOptions& whole, const std::vector<int>& part_of_vertex,
                       const std::vector<int>& id, std::vector<PartOfMesh>& parts) {
  const auto vertex_lists = {&ConstraintOptions::fixed_vertices, &ConstraintOptions::frozen_vertices};
  const auto edge_lists = {&ConstraintOptions::seams, &ConstraintOptions::junction_edges,
                           &ConstraintOptions::hard_edges, &ConstraintOptions::rounded_edges};
  ConstraintOptions of_each = whole;
  for (const auto list : vertex_lists) (of_each.*list).clear();
  for (const auto list : edge_lists) (of_each.*list).clear();
  for (PartOfMesh& part : parts) part.constraints = of_each;
  for (const auto list : vertex_lists)
    for (int v : whole.*list)
      if (part_of_vertex[v] >= 0) (parts[part_of_vertex[v]].constraints.*list).push_back(id[v]);
  for (const auto list : edge_lists)
    for (const auto& [a, b] : whole.*list)
      if (part_of_vertex[a] >= 0 && part_of_vertex[a] == part_of_vertex[b])
        (parts[part_of_vertex[a]].constraints.*list).push_back({id[a], id[b]});
}

void add_counts(const RemeshResult& part, RemeshResult& result) {
  result.folded_before += part.folded_before;
  result.flips.flow_rounds += part.flips.flow_rounds;
  result.flips.spring_rounds += part.flips.spring_rounds;
  result.flips.flips += part.flips.flips;
  result.flips.passes += part.flips.passes;
  result.flips.evaluations += part.flips.evaluations;
  result.flips.folded_before += part.flips.folded_before;
  result.adaptation.folded_before += part.adaptation.folded_before;
  result.adaptation.levels = std::max(result.adaptation.levels, part.adaptation.levels);
  result.adaptation.rounds += part.adaptation.rounds;
  result.adaptation.count_rounds += part.adaptation.count_rounds;
  result.adaptation.splits += part.adaptation.splits;
  result.adaptation.collapses += part.adaptation.collapses;
  result.adaptation.flips += part.adaptation.flips;
  result.unprojected += part.unprojected;
  result.projection += part.projection;
  result.limited_steps += part.limited_steps;
}

}  // namespace

std::vector<PartOfMesh> parts_of_mesh(const TriMesh& whole, const ConstraintOptions& constraints,
                                      const std::vector<int>& part_of_vertex) {
  std::vector<PartOfMesh> parts;
  std::vector<int> id;  // in its part
  for (std::size_t v = 0; v < part_of_vertex.size(); ++v) {
    const int number = part_of_vertex[v];
    if (number >= std::ssize(parts)) parts.resize(number + 1);
    id.push_back(number < 0 ? -1 : static_cast<int>(parts[number].vertices.size()));
    if (number >= 0) parts[number].vertices.push_back(static_cast<int>(v));
  }
  std::vector<std::vector<Triangle>> triangles(parts.size());
  const std::vector<Triangle> all = triangles_of(whole);
  for (std::size_t f = 0; f < all.size(); ++f) {
    const int number = part_of_vertex[all[f][0]];
    if (number < 0) continue;
    parts[number].faces.push_back(static_cast<int>(f));
    triangles[number].push_back({id[all[f][0]], id[all[f][1]], id[all[f][2]]});
  }
  const auto points = vertex_points(whole);
  const std::vector<double> lengths = vertex_values(whole, target_length_property);
  const std::vector<int> joined = joined_vertices(whole);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    PartOfMesh& part = parts[p];
    const MemoryOrder order = find_memory_order(static_cast<int>(part.vertices.size()), triangles[p]);
    part.mesh = build_mesh(points(Eigen::all, part.vertices), *order.adjacency, order.order.old_ids());
    std::vector<double> part_lengths;
    std::vector<int> part_joined;
    for (int v : part.vertices) {
      part_lengths.push_back(lengths[v]);
      if (!joined.empty()) part_joined.push_back(id[joined[v]]);
    }
    set_vertex_values(part.mesh, target_length_property, part_lengths);
    if (!joined.empty()) set_joined_vertices(part.mesh, part_joined);
  }
  share_constraints(constraints, part_of_vertex, id, parts);
  return parts;
}

std::vector<PartOfResult> parts_of_result(const std::vector<PartOfMesh>& parts, const TriMesh& mesh,
                                          const RemeshResult& result) {
  std::vector<int> part_of_face, id_of_face, part_of_origin(result.input_points.cols(), -1),
      id_of_origin(part_of_origin);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t count = parts[p].faces.empty() ? 0 : parts[p].faces.back() + 1;
    part_of_face.resize(std::max(part_of_face.size(), count), -1);
    id_of_face.resize(part_of_face.size(), -1);
    for (std::size_t f = 0; f < parts[p].faces.size(); ++f) {
      part_of_face[parts[p].faces[f]] = static_cast<int>(p);
      id_of_face[parts[p].faces[f]] = static_cast<int>(f);
    }
    for (std::size_t v = 0; v < parts[p].vertices.size(); ++v) {
      part_of_origin[parts[p].vertices[v]] = static_cast<int>(p);
      id_of_origin[parts[p].vertices[v]] = static_cast<int>(v);
    }
  }
  const MemoryOrder& order = result.memory_order;
  const std::vector<int> components = label_components(*order.adjacency);
  std::vector<int> part_of_component(components.size(), -1), part_of(components.size()),
      id(components.size(), -1);
  for (std::size_t v = 0; v < components.size(); ++v) {
    const int face = result.map[order.order.old_vertex[v]].position.face;
    if (face >= 0 && face < std::ssize(part_of_face) && part_of_face[face] >= 0)
      part_of_component[components[v]] = part_of_face[face];
  }
  for (std::size_t v = 0; v < components.size(); ++v)
    part_of[order.order.old_vertex[v]] = part_of_component[components[v]];

  struct Lists {
    std::vector<int> vertices;
    std::vector<Triangle> faces;
    std::vector<double> lengths;
    std::vector<int> joined;
  };
  std::vector<Lists> lists(parts.size());
  std::vector<PartOfResult> results(parts.size());
  const std::vector<double> lengths = vertex_values(mesh, target_length_property);
  const std::vector<int> joined = joined_vertices(mesh);
  for (std::size_t v = 0; v < part_of.size(); ++v) {
    if (part_of[v] < 0) continue;
    Lists& list = lists[part_of[v]];
    RemeshResult& of_part = results[part_of[v]].result;
    id[v] = static_cast<int>(list.vertices.size());
    list.vertices.push_back(static_cast<int>(v));
    list.lengths.push_back(lengths[v]);
    if (!joined.empty()) list.joined.push_back(id[joined[v]]);  // an earlier one, or itself
    MapEntry entry = result.map[v];
    if (entry.vertex >= 0) entry.vertex = id_of_origin[entry.vertex];
    if (entry.position.face >= 0) entry.position.face = id_of_face[entry.position.face];
    of_part.map.push_back(entry);
    of_part.vertex_limits.push_back(result.vertex_limits[v]);
  }
  const std::vector<Triangle> triangles = triangles_of(mesh);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto& [a, b, c] = triangles[f];
    if (part_of[a] < 0) continue;
    std::vector<Triangle>& faces = lists[part_of[a]].faces;
    faces.push_back({id[a], id[b], id[c]});
  }
  for (const auto& [a, b] : result.crease_edges)
    if (part_of[a] >= 0) results[part_of[a]].result.crease_edges.push_back({id[a], id[b]});
  for (const auto& [a, b] : result.input_creases)
    if (part_of_origin[a] >= 0)
      results[part_of_origin[a]].result.input_creases.push_back({id_of_origin[a], id_of_origin[b]});
  const auto points = vertex_points(mesh);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    RemeshResult& of_part = results[p].result;
    of_part.reason = result.reason;
    of_part.rescue = result.rescue;
    of_part.input_points = result.input_points(Eigen::all, parts[p].vertices);
    const Mat3X part_points = points(Eigen::all, lists[p].vertices);
    of_part.adaptation.target_faces = target_face_count(part_points, lists[p].lengths, lists[p].faces);
    results[p].mesh = build_result(part_points, lists[p].faces, lists[p].lengths, lists[p].joined, of_part);
  }
  return results;
}

void replace_parts(const std::vector<PartOfMesh>& parts, const std::vector<RemeshedMesh>& of_parts,
                   TriMesh& mesh, RemeshResult& result) {
  std::vector<int> replaced;                                     // faces of the input
  std::vector<char> is_replaced(result.input_points.cols(), 0);  // by vertex of the input
  for (const PartOfMesh& part : parts) {
    replaced.insert(replaced.end(), part.faces.begin(), part.faces.end());
    for (int v : part.vertices) is_replaced[v] = 1;
  }
  std::ranges::sort(replaced);
  RemeshResult all = result;
  std::erase_if(all.input_creases, [&](const Edge& e) { return is_replaced[e[0]] != 0; });
  std::vector<Piece> pieces = {piece_beside({mesh, result}, replaced)};
  for (std::size_t p = 0; p < parts.size(); ++p) {
    pieces.push_back(piece_of(parts[p], of_parts[p]));
    for (const auto& [a, b] : of_parts[p].result.input_creases)
      all.input_creases.push_back({parts[p].vertices[a], parts[p].vertices[b]});
    add_counts(of_parts[p].result, all);
  }
  TriMesh assembled = assemble(std::move(pieces), all);
  mesh = std::move(assembled);
  result = std::move(all);
}

}  // namespace hooke
