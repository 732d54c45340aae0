// Overlapping patches that cover a mesh.
#pragma once

#include "hooke/filter/patch_grower.h"

namespace hooke {

/// Some of the patches of a cover.
struct PatchList {
  std::vector<int> centres;   // vertices
  std::vector<double> radii;  // in the unit of the points
  IntLists members;           // the vertices of each, its centre first

  size_t size() const { return centres.size(); }
};

struct PatchCoverOptions {
  int patch_size = 30;    // vertices of a patch
  double coverage = .75;  // every vertex is closer to some centre than this share of the patch's radius
};

/// Places patches one by one, each at the first vertex that is not yet well inside one.
class PatchCover {
 public:
  /// `normals`, `edge_lengths`: at the vertices (see normals.h); for `unfolded` see patch_grower.h. All
  /// but the options must outlive the cover.
  PatchCover(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity, const Mat3X& normals,
             const Eigen::VectorXd& edge_lengths, const std::vector<char>& unfolded,
             const PatchCoverOptions& options);

  /// The next patches, so many as long as there are; none at the end. A vertex without faces gets no patch.
  PatchList next(size_t count);

 private:
  bool is_centre(int vertex) const;
  void add_patch(int centre, PatchList& patches);

  const Connectivity& connectivity_;
  const Eigen::VectorXd& edge_lengths_;
  const std::vector<char>& unfolded_;
  PatchCoverOptions options_;
  PatchGrower grower_;
  std::vector<char> covered_;
  bool folded_ = false;  // the turn of the folded vertices: poor centres, only where nothing else covers them
  int vertex_ = 0;       // the next to be looked at
};

}  // namespace hooke
