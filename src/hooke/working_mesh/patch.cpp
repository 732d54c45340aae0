#include "hooke/working_mesh/patch.h"

#include <algorithm>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/mesh/halfedge_mesh.h"

namespace hooke {
namespace {

class PatchCutter {
 public:
  PatchCutter(const FlippingMesh& mesh, EdgePatch& patch) : m_(mesh), patch_(patch) {}

  void cut_pair(int half_edge) {
    for (int h : {half_edge, m_.triangulation.twin(half_edge)}) {
      Triangle t = {h, Triangulation::next(h), Triangulation::previous(h)};
      for (int& v : t) v = add(v);
      patch_.faces.push_back(t);
    }
    copy_vertices();
  }

  /// False where more than `most` vertices would move.
  bool cut(int half_edge, int rings, size_t most) {
    add(half_edge);
    add(Triangulation::next(half_edge));
    for (size_t begin = 0; rings > 0; --rings)
      for (const size_t end = patch_.sides.size(); begin < end; ++begin) {
        if (has_more_edges(patch_.vertices[begin], most)) return false;
        add_neighbours(begin);
        if (patch_.sides.size() > most) return false;
      }
    patch_.movable = patch_.sides.size();
    if (std::ranges::any_of(patch_.vertices, [&](int v) { return has_more_edges(v, most); })) return false;
    const std::vector<int> faces = add_faces();
    copy_vertices();
    add_rim(faces);
    return true;
  }

 private:
  bool has_more_edges(int vertex, size_t most) const {
    return m_.triangulation.valence(vertex) > static_cast<int>(most);
  }

  /// Half-edges that leave the vertex within the sector of its side.
  ShortList outgoing(size_t id) const {
    ShortList spokes;
    for (int h : m_.triangulation.outgoing(patch_.vertices[id]))
      if (m_.triangulation.side(h) == patch_.sides[id]) spokes.push_back(h);
    return spokes;
  }

  /// The id in the patch of the corner where the half-edge leaves. Patches are small: looking through them is
  /// the fastest.
  int add(int half_edge) {
    const int side = m_.triangulation.side(half_edge);
    const auto found = std::ranges::find(patch_.sides, side);
    const auto id = static_cast<int>(found - patch_.sides.begin());
    if (found == patch_.sides.end()) {
      patch_.sides.push_back(side);
      patch_.vertices.push_back(m_.triangulation.from(half_edge));
    }
    return id;
  }

  void add_neighbours(size_t id) {
    for (int h : outgoing(id)) {
      add(Triangulation::next(h));
      const int last = Triangulation::previous(h);  // the next half-edge out begins there, if there is one
      if (m_.triangulation.is_border(last)) add(last);
    }
  }

  /// Those of the movable vertices, each once: at its corner of the least id. Returns their ids in the mesh.
  std::vector<int> add_faces() {
    std::vector<int> faces;
    const int movable = static_cast<int>(patch_.movable);
    for (int id = 0; id < movable; ++id)
      for (int h : outgoing(static_cast<size_t>(id))) {
        const int second = add(Triangulation::next(h)), third = add(Triangulation::previous(h));
        if (second < id || third < id) continue;
        Triangle face = {id, second, third};
        std::ranges::rotate(face, face.begin() + (3 - h % 3) % 3);
        patch_.faces.push_back(face);
        faces.push_back(h / 3);
      }
    return faces;
  }

  /// All faces about a movable vertex are in the patch, as far as creases: it ends with other edges.
  void add_rim(const std::vector<int>& faces) {
    const Triangulation& t = m_.triangulation;
    const int movable = static_cast<int>(patch_.movable);
    for (size_t f = 0; f < faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k) {
        const int h = 3 * faces[f] + static_cast<int>(k);
        const Triangle& face = patch_.faces[f];
        const int from = face[k], to = face[(k + 1) % 3];
        if (t.twin(h) < 0 || (std::min(from, to) < movable && !t.is_constrained(h))) continue;
        const auto across = std::ranges::find(faces, t.twin(h) / 3);
        const bool inside = across != faces.end();
        if (inside && !t.is_constrained(h)) continue;
        PatchRim rim = {h, from, to, {-1, -1}};
        if (inside) {
          const Triangle& other = patch_.faces[static_cast<size_t>(across - faces.begin())];
          const auto i = static_cast<size_t>(t.twin(h) % 3);
          rim.beyond = {other[i], other[(i + 1) % 3]};
        }
        patch_.rim.push_back(rim);
      }
  }

  void copy_vertices() {
    const size_t n = patch_.sides.size();
    Placement& p = patch_.placement;
    p.points.resize(3, static_cast<Eigen::Index>(n));
    p.normals.resize(3, static_cast<Eigen::Index>(n));
    p.anchors.resize(n);
    p.segments.resize(n);
    p.drift.resize(n);
    for (size_t i = 0; i < n; ++i) copy_vertex(i);
  }

  void copy_vertex(size_t id) {
    const int side = patch_.sides[id], vertex = patch_.vertices[id];
    const auto v = static_cast<size_t>(vertex);
    VertexPlace place(m_.placement, vertex);
    place.normal = m_.placement.normals.col(side);
    place.anchor = m_.placement.anchors[static_cast<size_t>(side)];
    place.other_side = -1;
    place.write_to(patch_.placement, static_cast<int>(id));
    const bool free = id < patch_.movable && m_.constraints.freedom[v] == Freedom::surface &&
                      (m_.constraints.creases.empty() || !m_.triangulation.on_crease(vertex));
    patch_.vertex_length.push_back(m_.vertex_length[v]);
    patch_.constraints.freedom.push_back(free ? Freedom::surface : Freedom::fixed);
    patch_.constraints.segment.push_back(0);
    patch_.constraints.curve.push_back(-1);
  }

  const FlippingMesh& m_;
  EdgePatch& patch_;
};

/// A face of the patch's edge, and its corner across.
struct FaceOfEdge {
  size_t face;
  int apex;
};

/// The one that runs from 0 to 1, then that from 1 to 0.
std::array<FaceOfEdge, 2> faces_of_edge(const std::vector<Triangle>& faces) {
  std::array<FaceOfEdge, 2> found{};
  for (size_t f = 0; f < faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const int from = faces[f][k], to = faces[f][(k + 1) % 3];
      if (from + to == 1) found[static_cast<size_t>(from)] = {f, faces[f][(k + 2) % 3]};
    }
  return found;
}

}  // namespace

std::optional<EdgePatch> cut_patch(const FlippingMesh& mesh, int half_edge, int rings, size_t most) {
  std::optional<EdgePatch> patch(std::in_place);
  if (!PatchCutter(mesh, *patch).cut(half_edge, rings, most)) patch.reset();
  return patch;
}

EdgePatch cut_pair(const FlippingMesh& mesh, int half_edge) {
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
  const int apex_left = left.apex, apex_right = right.apex;
  faces[left.face] = {apex_left, 0, apex_right};
  faces[right.face] = {apex_right, 1, apex_left};
  return faces;
}

std::vector<Triangle> halved_faces(const EdgePatch& patch, int vertex) {
  std::vector<Triangle> faces = patch.faces;
  const auto [left, right] = faces_of_edge(faces);
  faces[left.face] = {0, vertex, left.apex};
  faces[right.face] = {1, vertex, right.apex};
  faces.push_back({vertex, 1, left.apex});
  faces.push_back({vertex, 0, right.apex});
  return faces;
}

std::vector<Triangle> merged_faces(const EdgePatch& patch, int stays) {
  std::vector<Triangle> faces;
  for (Triangle t : patch.faces) {
    std::ranges::replace(t, 1 - stays, stays);
    if (std::ranges::count(t, stays) < 2) faces.push_back(t);
  }
  return faces;
}

int append_vertex(EdgePatch& patch, int like) {
  const int v = static_cast<int>(patch.sides.size());
  patch.vertices.push_back(-1);
  patch.sides.push_back(-1);
  patch.vertex_length.push_back(.5 * (patch.vertex_length[0] + patch.vertex_length[1]));
  patch.constraints.freedom.push_back(Freedom::surface);
  patch.constraints.segment.push_back(0);
  patch.constraints.curve.push_back(-1);
  Placement& p = patch.placement;
  const VertexPlace place(p, like);
  p.points.conservativeResize(3, v + 1);
  p.normals.conservativeResize(3, v + 1);
  p.anchors.push_back(0);
  p.segments.push_back(0);
  p.drift.push_back(0);
  place.write_to(p, v);
  return v;
}

void move_vertices(const EdgePatch& patch, Placement& placement) {
  for (size_t i = 0; i < patch.sides.size(); ++i)
    if (patch.constraints.freedom[i] != Freedom::fixed)
      VertexPlace(patch.placement, static_cast<int>(i)).write_to(placement, patch.vertices[i]);
}

}  // namespace hooke
