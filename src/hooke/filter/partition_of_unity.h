// A surface field at every size: local splines on overlapping patches of the mesh, blended by weights.
// R. Franke, G. Nielson, "Smooth interpolation of large sets of scattered data", 1980; H. Wendland,
// "Piecewise polynomial, positive definite and compactly supported radial functions of minimal degree", 1995
// (the weights); Y. Ohtake et al., "Multi-level partition of unity implicits", 2003.
#pragma once

#include <deque>

#include "hooke/filter/patch_cover.h"
#include "hooke/filter/spline_group.h"
#include "hooke/filter/stored_spline.h"

namespace hooke {

struct PartitionOptions {
  Kernel kernel = Kernel::r3;
  PatchCoverOptions cover = {};
  double offset = .3;  // rho of [13], in mean edge lengths at the vertex
};

/// Which polynomial part a patch's spline got.
enum class PatchFit : unsigned char {
  as_wanted,  // quadratic; affine in a patch of few vertices
  affine,     // where the quadratic one is not determined
  failed,     // no spline: the patch holds no vertices
};

/// The field is zero at every vertex, to 2^-30 of a patch's radius, a distance near them, and grows along the
/// normals. Patches are grown over the edges of the mesh, never through space, so two sheets of a thin body
/// do not see each other. Which patches there are depends on vertex order, topology and shape only: moving,
/// turning or scaling the mesh takes the field along.
class PartitionOfUnity {
 public:
  /// `normals` are the unit vertex normals, `edge_lengths` the mean edge length at each vertex (see
  /// normals.h). A vertex without faces gets no patch.
  PartitionOfUnity(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity,
                   const Mat3X& normals, const Eigen::VectorXd& edge_lengths,
                   const PartitionOptions& options = {});
  PartitionOfUnity(const PartitionOfUnity&) = delete;
  PartitionOfUnity& operator=(const PartitionOfUnity&) = delete;

  /// Value and gradient at x, blended from the patches that hold the vertex `anchor`. The gradient is that of
  /// the splines; it leaves out the slope of the weights, which vanishes on the surface. All zero when no
  /// patch of the anchor reaches x.
  FieldSample operator()(const Vec3& x, int anchor) const;

  std::size_t patch_count() const { return patches_.size(); }
  std::size_t count(PatchFit fit) const;
  std::size_t memory_bytes() const;

 private:
  struct Patch {
    Vec3 centre;
    double radius = 0;
    StoredSpline<SnappedCoordinate> spline = {};
    PatchFit fit = PatchFit::as_wanted;
  };
  /// Memory of the splines of some patches.
  struct Storage {
    std::vector<SnappedCoordinate> coordinates;
    std::vector<double> coefficients;
  };
  /// Patches that are fitted by one thread.
  struct Batch {
    PatchList list;
    std::vector<Patch> patches;
    Storage storage;
  };
  /// What all fits look at.
  struct Samples {
    const Eigen::Ref<const Mat3X>& points;
    const Mat3X& normals;
    const Eigen::VectorXd& edge_lengths;
    const std::vector<char>& unfolded;
    double offset;
  };

  /// What the spline of a patch is fitted to.
  static void gather(const Samples& samples, const PatchList& list, std::size_t patch, SplineData& data);
  void fit(const Samples& samples, Batch& batch) const;
  void index_patches(int vertex_count, const std::deque<Batch>& batches);

  Kernel kernel_;
  std::vector<Storage> storage_;
  std::vector<Patch> patches_;
  IntLists vertex_patches_;
};

}  // namespace hooke
