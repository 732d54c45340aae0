#include "hooke/flip_patch.h"

#include <algorithm>

#include "hooke/face_shape.h"
#include "hooke/guards.h"

namespace hooke {
namespace {

class PatchCutter {
 public:
  PatchCutter(const FlippingMesh& mesh, FlipPatch& patch) : m_(mesh), patch_(patch) {}

  void cut_pair(int half_edge) {
    for (int h : {half_edge, m_.triangulation.twin(half_edge)}) {
      Triangle t = {h, Triangulation::next(h), Triangulation::previous(h)};
      for (int& v : t) v = add(m_.triangulation.side(v));
      patch_.faces.push_back(t);
    }
    copy_vertices();
  }

  /// False where more than `most` vertices would move.
  bool cut(int half_edge, int rings, size_t most) {
    add(m_.triangulation.side(half_edge));
    add(m_.triangulation.side(Triangulation::next(half_edge)));
    for (size_t begin = 0; rings > 0; --rings)
      for (const size_t end = patch_.sides.size(); begin < end; ++begin) {
        if (has_more_edges(patch_.sides[begin], most)) return false;
        add_neighbours(patch_.sides[begin]);
        if (patch_.sides.size() > most) return false;
      }
    patch_.movable = patch_.sides.size();
    if (std::ranges::any_of(patch_.sides, [&](int side) { return has_more_edges(side, most); })) return false;
    const std::vector<int> faces = add_faces();
    copy_vertices();
    add_rim(faces);
    return true;
  }

 private:
  bool has_more_edges(int side, size_t most) const {
    return m_.triangulation.valence(vertex_of_side(m_, side)) > static_cast<int>(most);
  }

  /// Half-edges that leave the vertex within the sector of its side.
  std::vector<int> outgoing(int side) const {
    std::vector<int> spokes = m_.triangulation.outgoing(vertex_of_side(m_, side));
    std::erase_if(spokes, [&](int h) { return m_.triangulation.side(h) != side; });
    return spokes;
  }

  /// Its id in the patch. Patches are small: looking through them is the fastest.
  int add(int side) {
    const auto found = std::ranges::find(patch_.sides, side);
    const auto id = static_cast<int>(found - patch_.sides.begin());
    if (found == patch_.sides.end()) patch_.sides.push_back(side);
    return id;
  }

  void add_neighbours(int side) {
    for (int h : outgoing(side)) {
      add(m_.triangulation.side(Triangulation::next(h)));
      const int last = Triangulation::previous(h);  // the next half-edge out begins there, if there is one
      if (m_.triangulation.is_border(last)) add(m_.triangulation.side(last));
    }
  }

  /// Returns the ids that they have in the mesh.
  std::vector<int> add_faces() {
    std::vector<int> faces;
    for (size_t i = 0; i < patch_.movable; ++i)
      for (int h : outgoing(patch_.sides[i])) {
        if (std::ranges::find(faces, h / 3) != faces.end()) continue;
        faces.push_back(h / 3);
        Triangle t = m_.triangulation.sides()[static_cast<size_t>(h / 3)];
        for (int& v : t) v = add(v);
        patch_.faces.push_back(t);
      }
    return faces;
  }

  void add_rim(const std::vector<int>& faces) {
    const Triangulation& t = m_.triangulation;
    for (size_t f = 0; f < faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k) {
        const int h = 3 * faces[f] + static_cast<int>(k);
        if (t.twin(h) < 0 || std::ranges::find(faces, t.twin(h) / 3) != faces.end()) continue;
        const Triangle& face = patch_.faces[f];
        patch_.rim.push_back({h, face[k], face[(k + 1) % 3]});
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
    const int side = patch_.sides[id], vertex = vertex_of_side(m_, side);
    const auto v = static_cast<size_t>(vertex);
    VertexPlace place(m_.placement, vertex);
    place.normal = m_.placement.normals.col(side);
    place.anchor = m_.placement.anchors[static_cast<size_t>(side)];
    place.other_side = -1;
    place.write_to(patch_.placement, static_cast<int>(id));
    const bool free = m_.constraints.freedom[v] == Freedom::surface &&
                      (m_.constraints.creases.empty() || !m_.triangulation.on_crease(vertex));
    patch_.vertex_length.push_back(m_.vertex_length[v]);
    patch_.constraints.freedom.push_back(free ? Freedom::surface : Freedom::fixed);
    patch_.constraints.segment.push_back(0);
    patch_.constraints.curve.push_back(-1);
  }

  const FlippingMesh& m_;
  FlipPatch& patch_;
};

const Triangle& face_along(const std::vector<Triangle>& faces, int from, int to) {
  return *std::ranges::find_if(faces, [&](const Triangle& t) {
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
  });
}

}  // namespace

std::optional<FlipPatch> cut_patch(const FlippingMesh& mesh, int half_edge, int rings, size_t most) {
  std::optional<FlipPatch> patch(std::in_place);
  if (!PatchCutter(mesh, *patch).cut(half_edge, rings, most)) patch.reset();
  return patch;
}

FlipPatch cut_pair(const FlippingMesh& mesh, int half_edge) {
  FlipPatch pair;
  PatchCutter(mesh, pair).cut_pair(half_edge);
  return pair;
}

std::vector<Triangle> flipped_faces(const FlipPatch& patch) {
  std::vector<Triangle> faces = patch.faces;
  std::array<int, 2> face = {-1, -1}, apex = {-1, -1};  // of the face that runs from 0 to 1, and from 1 to 0
  for (size_t f = 0; f < faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const int from = faces[f][k], to = faces[f][(k + 1) % 3];
      if (from + to != 1) continue;
      face[static_cast<size_t>(from)] = static_cast<int>(f);
      apex[static_cast<size_t>(from)] = faces[f][(k + 2) % 3];
    }
  faces[static_cast<size_t>(face[0])] = {apex[0], 0, apex[1]};
  faces[static_cast<size_t>(face[1])] = {apex[1], 1, apex[0]};
  return faces;
}

bool folds_at_rim(const FlipPatch& patch, const FlippingMesh& m, const GuardOptions& guards) {
  const Triangulation& t = m.triangulation;
  const Mat3X& X = m.placement.points;
  const std::vector<Triangle> flipped = flipped_faces(patch);
  return std::ranges::any_of(patch.rim, [&](const PatchRim& rim) {
    const Triangle& face = t.faces()[static_cast<size_t>(rim.half_edge / 3)];
    const Triangle& beyond = t.faces()[static_cast<size_t>(t.twin(rim.half_edge) / 3)];
    const double before = cosine_between(X, face, beyond);
    const Triangle& changed = face_along(flipped, rim.from, rim.to);
    const double after =
        cosine_between(doubled_area_vector(patch.placement.points, changed), doubled_area_vector(X, beyond));
    return t.is_constrained(rim.half_edge) ? crease_fold_breaks(guards, before, after)
                                           : fold_breaks(guards, before, after);
  });
}

int vertex_of_side(const FlippingMesh& m, int side) {
  const auto vertices = static_cast<int>(m.vertex_length.size());
  return side < vertices ? side : m.constraints.further_sides[static_cast<size_t>(side - vertices)];
}

void move_vertices(const FlipPatch& patch, FlippingMesh& m) {
  for (size_t i = 0; i < patch.movable; ++i)
    if (patch.constraints.freedom[i] != Freedom::fixed)
      VertexPlace(patch.placement, static_cast<int>(i)).write_to(m.placement, patch.sides[i]);
}

}  // namespace hooke
