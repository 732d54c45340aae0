#include "hooke/working_mesh/patch.h"

#include <algorithm>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/mesh/halfedge_mesh.h"

namespace hooke {
namespace {

class PatchCutter {
 public:
  PatchCutter(const WorkingMesh& mesh, EdgePatch& patch) : m_(mesh), patch_(patch) {}

  void cut_pair(int half_edge) {
    for (int h : {half_edge, m_.halfedges.twin(half_edge)}) {
      Triangle t = {h, HalfedgeMesh::next(h), HalfedgeMesh::previous(h)};
      for (int& v : t) v = add(v);
      patch_.faces.push_back(t);
    }
    copy_vertices();
  }

  /// False if there would be more than `max_vertices` movable vertices, or one with a larger valence.
  bool cut(int half_edge, int rings, size_t max_vertices) {
    add(half_edge);
    add(HalfedgeMesh::next(half_edge));
    for (size_t begin = 0; rings > 0; --rings)
      for (const size_t end = patch_.wedge_ids.size(); begin < end; ++begin) {
        if (has_more_edges(patch_.vertex_ids[begin], max_vertices)) return false;
        add_neighbours(begin);
        if (patch_.wedge_ids.size() > max_vertices) return false;
      }
    patch_.movable = patch_.wedge_ids.size();
    if (std::ranges::any_of(patch_.vertex_ids, [&](int v) { return has_more_edges(v, max_vertices); }))
      return false;
    const std::vector<int> faces = add_faces();
    copy_vertices();
    add_boundary(faces);
    return true;
  }

 private:
  bool has_more_edges(int vertex, size_t limit) const {
    return m_.halfedges.valence(vertex) > static_cast<int>(limit);
  }

  /// Half-edges that leave the vertex within its wedge.
  SmallIntList outgoing(size_t id) const {
    SmallIntList halfedges;
    for (int h : m_.halfedges.outgoing(patch_.vertex_ids[id]))
      if (m_.halfedges.wedge(h) == patch_.wedge_ids[id]) halfedges.push_back(h);
    return halfedges;
  }

  /// The id in the patch of the corner at the origin of the half-edge. Patches are small, so that a linear
  /// search is fastest.
  int add(int half_edge) {
    const int wedge = m_.halfedges.wedge(half_edge);
    const auto found = std::ranges::find(patch_.wedge_ids, wedge);
    const auto id = static_cast<int>(found - patch_.wedge_ids.begin());
    if (found == patch_.wedge_ids.end()) {
      patch_.wedge_ids.push_back(wedge);
      patch_.vertex_ids.push_back(m_.halfedges.from(half_edge));
    }
    return id;
  }

  void add_neighbours(size_t id) {
    for (int h : outgoing(id)) {
      add(HalfedgeMesh::next(h));
      const int last = HalfedgeMesh::previous(h);  // where the next outgoing half-edge, if any, begins
      if (m_.halfedges.is_feature_edge(last)) add(last);
    }
  }

  /// Adds the faces of the movable vertices, each at its corner with the smallest id. Returns their ids in
  /// the mesh.
  std::vector<int> add_faces() {
    std::vector<int> faces;
    const int movable = static_cast<int>(patch_.movable);
    for (int id = 0; id < movable; ++id)
      for (int h : outgoing(id)) {
        const int second = add(HalfedgeMesh::next(h)), third = add(HalfedgeMesh::previous(h));
        if (second < id || third < id) continue;
        Triangle face = {id, second, third};
        std::rotate(face.begin(), face.begin() + (3 - h % 3) % 3, face.end());
        patch_.faces.push_back(face);
        faces.push_back(h / 3);
      }
    return faces;
  }

  /// The patch holds all faces around a movable vertex up to creases; at all other edges it ends.
  void add_boundary(const std::vector<int>& faces) {
    const HalfedgeMesh& t = m_.halfedges;
    const int movable = static_cast<int>(patch_.movable);
    for (size_t f = 0; f < faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k) {
        const int h = 3 * faces[f] + static_cast<int>(k);
        const Triangle& face = patch_.faces[f];
        const int from = face[k], to = face[(k + 1) % 3];
        if (t.twin(h) < 0 || (std::min(from, to) < movable && !t.is_crease(h))) continue;
        const auto across = std::ranges::find(faces, t.twin(h) / 3);
        const bool inside = across != faces.end();
        if (inside && !t.is_crease(h)) continue;
        PatchBoundary edge = {h, from, to, {-1, -1}};
        if (inside) {
          const Triangle& other = patch_.faces[across - faces.begin()];
          const size_t i = t.twin(h) % 3;
          edge.twin_ends = {other[i], other[(i + 1) % 3]};
        }
        patch_.boundary.push_back(edge);
      }
  }

  /// Copies the rows of the vertices, each with the wedge in the patch alone.
  void copy_vertices() {
    VertexTable& vertices = patch_.vertices;
    const bool has_no_creases = m_.vertices.constraints.creases.empty();
    vertices = m_.vertices.rows(patch_.vertex_ids, patch_.wedge_ids);
    vertices.constraints.junction.clear();  // their vertices stand still
    for (size_t id = 0; id < patch_.vertex_ids.size(); ++id) {
      Freedom& freedom = vertices.constraints.freedom[id];
      const bool free = id < patch_.movable && freedom == Freedom::surface &&
                        (has_no_creases || !m_.halfedges.on_crease(patch_.vertex_ids[id]));
      freedom = free ? Freedom::surface : Freedom::fixed;
      vertices.constraints.curve[id] = -1;
    }
  }

  const WorkingMesh& m_;
  EdgePatch& patch_;
};

/// A face of the patch's edge, and the vertex opposite the edge.
struct FaceOfEdge {
  size_t face;
  int opposite_vertex;
};

/// The face with the half-edge 0 -> 1, then that with 1 -> 0.
std::array<FaceOfEdge, 2> faces_of_edge(const std::vector<Triangle>& faces) {
  std::array<FaceOfEdge, 2> found{};
  for (size_t f = 0; f < faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const int from = faces[f][k], to = faces[f][(k + 1) % 3];
      if (from + to == 1) found[from] = {f, faces[f][(k + 2) % 3]};
    }
  return found;
}

}  // namespace

std::optional<EdgePatch> cut_patch(const WorkingMesh& mesh, int half_edge, int rings, size_t max_vertices) {
  std::optional<EdgePatch> patch(std::in_place);
  if (!PatchCutter(mesh, *patch).cut(half_edge, rings, max_vertices)) patch.reset();
  return patch;
}

EdgePatch cut_pair(const WorkingMesh& mesh, int half_edge) {
  EdgePatch pair;
  PatchCutter(mesh, pair).cut_pair(half_edge);
  return pair;
}

const Triangle& face_along(const std::vector<Triangle>& faces, int from, int to) {
  return *std::ranges::find_if(faces, [&](const Triangle& t) {
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
  });
}

std::vector<Triangle> flipped_faces(const EdgePatch& patch) {
  std::vector<Triangle> faces = patch.faces;
  const auto [left, right] = faces_of_edge(faces);
  const int opposite_left = left.opposite_vertex, opposite_right = right.opposite_vertex;
  faces[left.face] = {opposite_left, 0, opposite_right};
  faces[right.face] = {opposite_right, 1, opposite_left};
  return faces;
}

std::vector<Triangle> split_faces(const EdgePatch& patch, int vertex) {
  std::vector<Triangle> faces = patch.faces;
  const auto [left, right] = faces_of_edge(faces);
  faces[left.face] = {0, vertex, left.opposite_vertex};
  faces[right.face] = {1, vertex, right.opposite_vertex};
  faces.push_back({vertex, 1, left.opposite_vertex});
  faces.push_back({vertex, 0, right.opposite_vertex});
  return faces;
}

std::vector<Triangle> collapsed_faces(const EdgePatch& patch, int stays) {
  std::vector<Triangle> faces;
  for (Triangle t : patch.faces) {
    std::ranges::replace(t, 1 - stays, stays);
    if (std::ranges::count(t, stays) < 2) faces.push_back(t);
  }
  return faces;
}

int append_vertex(EdgePatch& patch, int source) {
  const int v = static_cast<int>(patch.wedge_ids.size());
  patch.vertex_ids.push_back(-1);
  patch.wedge_ids.push_back(-1);
  VertexTable& vertices = patch.vertices;
  vertices.resize(v + 1);
  vertices.vertex_length[v] = .5 * (vertices.vertex_length[0] + vertices.vertex_length[1]);
  vertices.constraints.freedom[v] = Freedom::surface;
  SurfacePosition(vertices.positions, source).write_to(vertices.positions, v);
  return v;
}

void move_vertices(const EdgePatch& patch, SurfacePositions& positions) {
  for (size_t i = 0; i < patch.wedge_ids.size(); ++i)
    if (patch.vertices.constraints.freedom[i] != Freedom::fixed)
      SurfacePosition(patch.vertices.positions, static_cast<int>(i)).write_to(positions, patch.vertex_ids[i]);
}

}  // namespace hooke
