#include "hooke/mesh/smooth_patches.h"

#include <algorithm>
#include <cstddef>

#include "hooke/mesh/disjoint_sets.h"

namespace hooke {
namespace {

constexpr int many = 100;          // polygons of more than two faces
constexpr double many_share = .1;  // and of all small flat patches

struct Patch {
  int faces = 0;
  bool is_facet = false;  // long, or beside a sharp edge

  bool is_smooth() const { return faces > 1 && !is_facet; }
};

bool are_many_polygons(const std::vector<Patch>& patches) {
  const auto smooth = std::ranges::count_if(patches, &Patch::is_smooth);
  const auto polygons =
      std::ranges::count_if(patches, [](const Patch& p) { return p.is_smooth() && p.faces > 2; });
  return polygons >= many && static_cast<double>(polygons) >= many_share * static_cast<double>(smooth);
}

}  // namespace

std::vector<char> faces_in_smooth_patches(const Mat3X& points, const Adjacency& c,
                                          const std::vector<char>& flat, const std::vector<char>& sharp,
                                          const std::vector<double>& vertex_length) {
  DisjointSets sets(c.faces.size());
  for (std::size_t e = 0; e < flat.size(); ++e)
    if (flat[e] && !c.is_boundary_edge(static_cast<int>(e))) sets.join(c.edge_faces[e]);
  std::vector<Patch> patches(c.faces.size());  // by the face that stands for it
  for (std::size_t f = 0; f < patches.size(); ++f) {
    const int root = sets.root(static_cast<int>(f)), origin = c.faces[root][0];
    const auto is_far = [&](int v) {
      return (points.col(v) - points.col(origin)).norm() > longest_patch * vertex_length[origin];
    };
    Patch& patch = patches[root];
    ++patch.faces;
    if (std::ranges::any_of(c.faces[f], is_far) ||
        std::ranges::any_of(c.face_edges[f], [&](int e) { return sharp[e] != 0; }))
      patch.is_facet = true;
  }
  std::vector<char> marks(patches.size(), 0);
  if (!are_many_polygons(patches)) return marks;
  for (std::size_t f = 0; f < marks.size(); ++f)
    marks[f] = patches[sets.root(static_cast<int>(f))].is_smooth();
  return marks;
}

}  // namespace hooke
