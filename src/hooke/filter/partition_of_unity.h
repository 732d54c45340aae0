// Neighbourhoods on a mesh: the vertices around one vertex, as a surface would see them.
#pragma once

#include <deque>

#include "hooke/core/types.h"
#include "hooke/filter/spline_batch.h"
#include "hooke/filter/thin_plate_spline.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Grows patches over mesh edges within the cone of normals about their centre. One patch at a time: what is
/// asked is about the last one grown.
class PatchGrower {
 public:
  /// `normals` are the unit vertex normals; `unfolded` tells where they mean something: on the outer side of
  /// all faces of the vertex. All arguments must outlive the grower.
  PatchGrower(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency, const Mat3X& normals,
              const std::vector<char>& unfolded);

  /// Finds half as many vertices again as wanted by breadth-first search, keeps the nearest `size` of them
  /// and those that tie. What the search cuts off in the middle of a ring would leave the patch lopsided. The
  /// vertices stay in the order of the search, which knows nothing of coordinates.
  void grow(int centre, int size);

  const std::vector<int>& members() const { return members_; }         // the centre first
  const std::vector<double>& distances() const { return distances_; }  // from the centre
  double farthest() const { return farthest_; }                        // of the distances, ties aside

  /// Whether the patch holds the whole ring of the vertex, as far as the cone admits it.
  bool is_inside(int vertex) const;

 private:
  bool is_admitted(int vertex) const;
  Vec3 axis_at(int centre) const;
  void search(int centre, std::size_t most);

  Eigen::Ref<const Mat3X> points_;
  const Adjacency& adjacency_;
  const Mat3X& normals_;
  const std::vector<char>& unfolded_;
  Vec3 axis_ = Vec3::Zero();  // of the cone
  std::vector<int> met_by_;   // the last round whose search met the vertex
  std::vector<int> held_by_;  // the last round whose patch holds it
  std::vector<int> members_;
  std::vector<double> distances_;
  double farthest_ = 0;
  int round_ = -1;
};

// Overlapping patches that cover a mesh.

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
  PatchCover(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency, const Mat3X& normals,
             const Eigen::VectorXd& edge_lengths, const std::vector<char>& unfolded,
             const PatchCoverOptions& options);

  /// The next patches, so many as long as there are; none at the end. A vertex without faces gets no patch.
  PatchList next(size_t count);

 private:
  bool is_centre(int vertex) const;
  void add_patch(int centre, PatchList& patches);

  const Adjacency& adjacency_;
  const Eigen::VectorXd& edge_lengths_;
  const std::vector<char>& unfolded_;
  PatchCoverOptions options_;
  PatchGrower grower_;
  std::vector<char> covered_;
  bool folded_ = false;  // the turn of the folded vertices: poor centres, only where nothing else covers them
  int vertex_ = 0;       // the next to be looked at
};

// A surface field at every size: local splines on overlapping patches of the mesh, blended by weights.
// R. Franke, G. Nielson, "Smooth interpolation of large sets of scattered data", 1980; H. Wendland,
// "Piecewise polynomial, positive definite and compactly supported radial functions of minimal degree", 1995
// (the weights); Y. Ohtake et al., "Multi-level partition of unity implicits", 2003.

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
  PartitionOfUnity(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency, const Mat3X& normals,
                   const Eigen::VectorXd& edge_lengths, const PartitionOptions& options = {});
  PartitionOfUnity(const PartitionOfUnity&) = delete;
  PartitionOfUnity& operator=(const PartitionOfUnity&) = delete;

  /// Value and gradient at x, blended from the patches that hold the vertex `hint`. The gradient is that of
  /// the splines; it leaves out the slope of the weights, which vanishes on the surface. All zero when no
  /// patch of the hint reaches x.
  FieldSample operator()(const Vec3& x, int hint) const;

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
