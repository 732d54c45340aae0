#include "hooke/filter/patch_cover.h"

namespace hooke {
namespace {

constexpr double reach = .9;  // radius over the distance of the farthest vertex

}  // namespace

PatchCover::PatchCover(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity,
                       const Mat3X& normals, const Eigen::VectorXd& edge_lengths,
                       const std::vector<char>& unfolded, const PatchCoverOptions& options)
    : connectivity_(connectivity),
      edge_lengths_(edge_lengths),
      unfolded_(unfolded),
      options_(options),
      grower_(points, connectivity, normals, unfolded),
      covered_(static_cast<size_t>(connectivity.vertex_count), 0) {}

PatchList PatchCover::next(size_t count) {
  PatchList patches;
  patches.members.first.push_back(0);
  while (patches.size() < count) {
    if (vertex_ == connectivity_.vertex_count) {
      if (folded_) break;
      folded_ = true;
      vertex_ = 0;
      continue;
    }
    if (is_centre(vertex_)) add_patch(vertex_, patches);
    ++vertex_;
  }
  return patches;
}

bool PatchCover::is_centre(int vertex) const {
  const auto v = static_cast<size_t>(vertex);
  return !covered_[v] && (unfolded_[v] == 0) == folded_ && !connectivity_.vertex_faces[vertex].empty();
}

void PatchCover::add_patch(int centre, PatchList& patches) {
  grower_.grow(centre, options_.patch_size);
  const std::vector<int>& members = grower_.members();
  const double radius = grower_.farthest() > 0 ? reach * grower_.farthest() : 2 * edge_lengths_[centre];
  for (size_t i = 0; i < members.size(); ++i)
    if (i == 0 || (grower_.distances()[i] <= options_.coverage * radius && grower_.is_inside(members[i])))
      covered_[static_cast<size_t>(members[i])] = 1;
  patches.centres.push_back(centre);
  patches.radii.push_back(radius);
  patches.members.items.insert(patches.members.items.end(), members.begin(), members.end());
  patches.members.first.push_back(static_cast<int>(patches.members.items.size()));
}

}  // namespace hooke
