#include "hooke/mesh/smooth_patches.h"

#include <algorithm>
#include <cstddef>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/disjoint_sets.h"

namespace hooke {
namespace {

constexpr int many = 100;             // patches of more than two faces that are connected
constexpr double little = .1;         // area, over the median of these
constexpr double little_share = .05;  // minimum share of patches that have less
constexpr double large = 20;          // area, over the median, beyond which it is a flat side

/// Faces in one plane, connected; without faces unless the face with its number stands for it.
struct Patch {
  int faces = 0;
  double area = 0;
  bool has_sharp_edge = false;
};

/// Connected patches without sharp edges.
struct Group {
  int polygons = 0;  // of more than two faces
  std::vector<double> areas;

  /// The area up to which patches are part of a smooth surface; 0 if none are.
  double max_area() {
    if (polygons < many) return 0;
    const auto middle = areas.begin() + std::ssize(areas) / 2;
    std::ranges::nth_element(areas, middle);
    const double median = *middle;
    const auto little_ones = std::ranges::count_if(areas, [&](double a) { return a < little * median; });
    const bool differ = static_cast<double>(little_ones) >= little_share * static_cast<double>(areas.size());
    return differ ? large * median : 0;
  }
};

}  // namespace

std::vector<char> faces_in_smooth_patches(const Mat3X& points, const Adjacency& c,
                                          const std::vector<char>& flat, const std::vector<char>& sharp) {
  DisjointSets patch_of(c.faces.size()), group_of(c.faces.size());
  for (std::size_t e = 0; e < flat.size(); ++e)
    if (flat[e] && !c.is_boundary_edge(static_cast<int>(e))) patch_of.join(c.edge_faces[e]);
  std::vector<Patch> patches(c.faces.size());  // by the face that stands for it
  for (std::size_t f = 0; f < patches.size(); ++f) {
    Patch& patch = patches[patch_of.root(static_cast<int>(f))];
    ++patch.faces;
    patch.area += doubled_area_vector(points, c.faces[f]).norm();
    for (int e : c.face_edges[f]) patch.has_sharp_edge = patch.has_sharp_edge || sharp[e] != 0;
  }
  const auto patch_at = [&](int face) -> const Patch& { return patches[patch_of.root(face)]; };
  for (std::size_t e = 0; e < flat.size(); ++e) {
    if (c.is_boundary_edge(static_cast<int>(e))) continue;
    const auto& [left, right] = c.edge_faces[e];
    if (!patch_at(left).has_sharp_edge && !patch_at(right).has_sharp_edge) group_of.join({left, right});
  }
  std::vector<Group> groups(c.faces.size());
  for (std::size_t f = 0; f < patches.size(); ++f) {
    if (patches[f].faces == 0 || patches[f].has_sharp_edge) continue;
    Group& group = groups[group_of.root(static_cast<int>(f))];
    group.polygons += patches[f].faces > 2;
    group.areas.push_back(patches[f].area);
  }
  std::vector<double> max_areas;
  for (Group& group : groups) max_areas.push_back(group.max_area());
  std::vector<char> marks(c.faces.size(), 0);
  for (std::size_t f = 0; f < marks.size(); ++f) {
    const auto face = static_cast<int>(f);
    const Patch& patch = patch_at(face);
    marks[f] = patch.faces > 1 && !patch.has_sharp_edge && patch.area <= max_areas[group_of.root(face)];
  }
  return marks;
}

}  // namespace hooke
