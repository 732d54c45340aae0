#include "hooke/measure/crease_bound.h"

#include <algorithm>

#include "hooke/mesh/creases.h"

namespace hooke {
namespace {

constexpr int rings = 2;  // about the face, within which its bound is found

/// All faces about the vertices of those rings, as a mesh of its own.
struct Patch {
  std::vector<int> vertices;  // in the mesh, ascending
  std::vector<Triangle> faces;
  int face = 0;  // the one in question

  int place_of(int vertex) const {
    const auto found = std::ranges::lower_bound(vertices, vertex);
    return found != vertices.end() && *found == vertex ? static_cast<int>(found - vertices.begin()) : -1;
  }
};

Patch patch_about(const Connectivity& c, int face) {
  const Triangle& t = c.faces[static_cast<size_t>(face)];
  const std::vector<int> faces = united(c.vertex_faces, with_rings(c, {t.begin(), t.end()}, rings));
  Patch patch;
  patch.face = static_cast<int>(std::ranges::lower_bound(faces, face) - faces.begin());
  for (int f : faces) patch.faces.push_back(c.faces[static_cast<size_t>(f)]);
  for (const Triangle& corners : patch.faces)
    patch.vertices.insert(patch.vertices.end(), corners.begin(), corners.end());
  std::ranges::sort(patch.vertices);
  const auto others = std::ranges::unique(patch.vertices);
  patch.vertices.erase(others.begin(), others.end());
  for (Triangle& corners : patch.faces)
    for (int& v : corners) v = patch.place_of(v);
  return patch;
}

AngleBound bound_in_pieces(const MeasuredSurface& surface, int face, const std::vector<Edge>& creases) {
  const Patch patch = patch_about(surface.connectivity, face);
  std::vector<Edge> here;
  for (const Edge& crease : creases) {
    const Edge e = {patch.place_of(crease[0]), patch.place_of(crease[1])};
    if (std::min(e[0], e[1]) >= 0) here.push_back(e);
  }
  Connectivity c = make_connectivity(static_cast<int>(patch.vertices.size()), patch.faces);
  part_at_creases(c, here);
  const Mat3X points = surface.points(Eigen::all, patch.vertices);
  AngleBound bound = bound_least_angle(side_points(points, c), cut_open(c), patch.face, rings);
  for (int& v : bound.vertices)
    v = surface.ids.vertex(patch.vertices[static_cast<size_t>(c.vertex_of_side(v))]);
  std::ranges::sort(bound.vertices);
  const auto rest = std::ranges::unique(bound.vertices);
  bound.vertices.erase(rest.begin(), rest.end());
  return bound;
}

/// Where an id stands in a list of all of them.
std::vector<int> places(std::span<const int> ids, size_t count) {
  std::vector<int> places(count);
  for (size_t i = 0; i < count; ++i)
    places[ids.empty() ? i : static_cast<size_t>(ids[i])] = static_cast<int>(i);
  return places;
}

}  // namespace

void bound_between_creases(std::vector<WorstFace>& faces, const MeasuredSurface& surface,
                           const std::vector<Edge>& creases) {
  if (creases.empty()) return;
  const Connectivity& c = surface.connectivity;
  const std::vector<int> vertex_at = places(surface.ids.vertices, static_cast<size_t>(c.vertex_count));
  const std::vector<int> face_at = places(surface.ids.faces, c.faces.size());
  std::vector<Edge> edges = creases;
  for (Edge& e : edges)
    for (int& v : e) v = vertex_at[static_cast<size_t>(v)];
  for (WorstFace& f : faces) f.bound = bound_in_pieces(surface, face_at[static_cast<size_t>(f.face)], edges);
}

}  // namespace hooke
