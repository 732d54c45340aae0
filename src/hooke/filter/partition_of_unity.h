// A surface field for meshes of any size: local splines on overlapping patches of the mesh, blended by a
// partition of unity.
// R. Franke, G. Nielson, "Smooth interpolation of large sets of scattered data", 1980; H. Wendland,
// "Piecewise polynomial, positive definite and compactly supported radial functions of minimal degree", 1995
// (the weights); Y. Ohtake et al., "Multi-level partition of unity implicits", 2003.
#pragma once

#include <deque>

#include "hooke/core/types.h"
#include "hooke/filter/spline_batch.h"
#include "hooke/filter/thin_plate_spline.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Grows one patch at a time over mesh edges, within a cone of normals about its centre. Results refer to the
/// last patch grown.
class PatchGrower {
 public:
  /// `normals` are the unit vertex normals; `unfolded` marks the vertices where they are meaningful: on the
  /// outer side of all faces of the vertex. All arguments must outlive the grower.
  PatchGrower(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency, const Mat3X& normals,
              const std::vector<char>& unfolded);

  /// Collects 3/2 `size` vertices by breadth-first search and keeps the nearest `size` of them, including
  /// ties: a search that stops in the middle of a ring would leave the patch lopsided. The vertices stay in
  /// the order of the search, which does not depend on coordinates.
  void grow(int centre, int size);

  const std::vector<int>& members() const { return members_; }         // the centre first
  const std::vector<double>& distances() const { return distances_; }  // from the centre
  double farthest() const { return farthest_; }                        // maximum of the distances, ties aside

  /// Whether the patch contains the whole one-ring of the vertex, as far as the cone admits it.
  bool is_inside(int vertex) const;

 private:
  bool is_admitted(int vertex) const;
  Vec3 axis_at(int centre) const;
  void search(int centre, std::size_t max_size);

  Eigen::Ref<const Mat3X> points_;
  const Adjacency& adjacency_;
  const Mat3X& normals_;
  const std::vector<char>& unfolded_;
  Vec3 axis_ = Vec3::Zero();     // of the cone
  std::vector<int> visited_in_;  // last round whose search visited the vertex
  std::vector<int> member_in_;   // last round whose patch contains the vertex
  std::vector<int> members_;
  std::vector<double> distances_;
  double farthest_ = 0;
  int round_ = -1;
};

/// A batch of the patches of a cover.
struct PatchList {
  std::vector<int> centres;   // vertices
  std::vector<double> radii;  // a length
  IntLists members;           // vertices of each patch, its centre first

  size_t size() const { return centres.size(); }
};

/// Every vertex is within this fraction of a patch's radius from its centre.
inline constexpr double patch_coverage = .75;

/// Covers a mesh with overlapping patches, created one by one at the first vertex that is not yet well inside
/// one.
class PatchCover {
 public:
  /// `normals` and `edge_lengths` are those of the vertices (see mesh/normals.h), `unfolded` as for
  /// PatchGrower. All arguments must outlive the cover.
  PatchCover(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency, const Mat3X& normals,
             const Eigen::VectorXd& edge_lengths, const std::vector<char>& unfolded);

  /// The next `count` patches, fewer at the end, none when the mesh is covered. A vertex without faces gets
  /// no patch.
  PatchList next(size_t count);

 private:
  bool is_centre(int vertex) const;
  void add_patch(int centre, PatchList& patches);

  const Adjacency& adjacency_;
  const Eigen::VectorXd& edge_lengths_;
  const std::vector<char>& unfolded_;
  PatchGrower grower_;
  std::vector<char> covered_;
  bool folded_ = false;  // second pass: folded vertices as centres, only where nothing else covers them
  int vertex_ = 0;       // next candidate for a centre
};

struct PartitionOptions {
  Kernel kernel = Kernel::r3;
  double offset = .3;  // rho of [13], in mean edge lengths at the vertex
};

/// The polynomial part of a patch's spline.
enum class PatchFit : unsigned char {
  as_requested,  // quadratic; affine in a patch of few vertices
  affine,        // the quadratic part is not determined
  failed,        // no spline: no vertex refers to the patch
};

/// The field is zero at every vertex, to 2^-30 of a patch's radius, approximately the distance near them, and
/// increases along the normals. Patches are grown over the edges of the mesh, never through space, so that
/// the two sheets of a thin body do not affect each other. The choice of patches depends on vertex order,
/// topology and shape only: the field moves, rotates and scales with the mesh.
class PartitionOfUnity {
 public:
  /// `normals` are the unit vertex normals, `edge_lengths` the mean edge length at each vertex (see
  /// mesh/normals.h). A vertex without faces gets no patch.
  PartitionOfUnity(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency, const Mat3X& normals,
                   const Eigen::VectorXd& edge_lengths, const PartitionOptions& options = {});
  PartitionOfUnity(const PartitionOfUnity&) = delete;
  PartitionOfUnity& operator=(const PartitionOfUnity&) = delete;

  /// Value and gradient at x, blended from the patches that contain the vertex `hint`. The gradient is that
  /// of the splines; it omits the derivative of the weights, which vanishes on the surface. Both are zero if
  /// no patch of the hint covers x.
  FieldSample operator()(const Vec3& x, int hint) const;

  std::size_t patch_count() const { return patches_.size(); }
  std::size_t count(PatchFit fit) const;
  std::size_t memory_bytes() const;

 private:
  struct Patch {
    Vec3 centre;
    double radius = 0;
    StoredSpline<SnappedCoordinate> spline = {};
    PatchFit fit = PatchFit::as_requested;
  };
  /// Memory of the splines of a batch.
  struct Storage {
    std::vector<SnappedCoordinate> coordinates;
    std::vector<double> coefficients;
  };
  /// Patches fitted by one thread.
  struct Batch {
    PatchList list;
    std::vector<Patch> patches;
    Storage storage;
  };
  /// Input of all fits.
  struct Samples {
    const Eigen::Ref<const Mat3X>& points;
    const Mat3X& normals;
    const Eigen::VectorXd& edge_lengths;
    const std::vector<char>& unfolded;
    double offset;
  };

  /// Collects the data that the spline of a patch is fitted to.
  static void gather(const Samples& samples, const PatchList& list, std::size_t patch, SplineData& data);
  void fit(const Samples& samples, Batch& batch) const;
  void index_patches(const Eigen::Ref<const Mat3X>& points, const std::deque<Batch>& batches);
  void drop_shallow_patches(const Eigen::Ref<const Mat3X>& points);

  Kernel kernel_;
  std::vector<Storage> storage_;
  std::vector<Patch> patches_;
  IntLists vertex_patches_;
};

}  // namespace hooke
