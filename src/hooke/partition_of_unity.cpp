#include "hooke/partition_of_unity.h"

#include <algorithm>

#include "hooke/normals.h"
#include "hooke/parallel.h"
#include "hooke/patch_grower.h"
#include "hooke/spline_group.h"

namespace hooke {
namespace {

constexpr double least_fold_agreement = .3;  // of a vertex normal with its faces: else the ring is folded
constexpr double reach = .9;                 // radius over the distance of the farthest vertex
constexpr std::size_t least_quadratic_size = 15;  // vertices of a patch that get a quadratic part
constexpr double coincidence = 1e-6;              // in radii: two centres closer than this count once
constexpr std::size_t patches_per_task = 32;

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

/// Wendland's C2 function of the squared distance over the squared radius, for r2 < 1.
double weight(double r2) {
  const double r = std::sqrt(r2), s = (1 - r) * (1 - r);
  return s * s * (4 * r + 1);
}

/// Vertices whose normal is on the outer side of all their faces.
std::vector<char> unfolded_vertices(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity,
                                    const Mat3X& normals) {
  const Mat3X of_faces = face_normals(points, connectivity);
  std::vector<char> unfolded(idx(connectivity.vertex_count), 0);
  parallel_for(unfolded.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
      double least = normals.col(v).squaredNorm();
      for (int f : connectivity.vertex_faces[v]) least = std::min(least, of_faces.col(f).dot(normals.col(v)));
      unfolded[idx(v)] = least >= least_fold_agreement;
    }
  });
  return unfolded;
}

/// Every third vertex of a patch has an offset point, outside and inside in turn. (All of them: no better.)
constexpr std::size_t offset_stride = 3;

/// Vertices and offsets of a patch: at most this many.
std::size_t most_centres(std::size_t vertices) {
  return vertices + (vertices + offset_stride - 1) / offset_stride;
}

/// The way for patches that the group has no spline for.
PatchFit fit_patch(SplineData& data, Kernel kernel, std::size_t vertices, SplineWorkspace& workspace,
                   double* storage) {
  data.drop_repeated(coincidence);
  const auto centres = data.centres.leftCols(data.count);
  const auto values = data.values.head(data.count);
  if (values.isZero(0)) return PatchFit::failed;  // no offset says where outside is
  const bool quadratic = vertices >= least_quadratic_size;
  if (quadratic && fit_spline(centres, values, kernel, 2, workspace, storage)) return PatchFit::as_wanted;
  if (fit_spline(centres, values, kernel, 1, workspace, storage))
    return quadratic ? PatchFit::affine : PatchFit::as_wanted;
  return PatchFit::failed;
}

}  // namespace

PartitionOfUnity::PartitionOfUnity(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity,
                                   const Mat3X& normals, const Eigen::VectorXd& edge_lengths,
                                   const PartitionOptions& options)
    : kernel_(options.kernel) {
  const std::vector<char> unfolded = unfolded_vertices(points, connectivity, normals);
  const IntLists members = cover(points, connectivity, normals, edge_lengths, unfolded, options);
  fit(points, normals, edge_lengths, unfolded, members, options);
  index_patches(connectivity.vertex_count, members);
}

IntLists PartitionOfUnity::cover(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity,
                                 const Mat3X& normals, const Eigen::VectorXd& edge_lengths,
                                 const std::vector<char>& unfolded, const PartitionOptions& options) {
  IntLists members;
  members.first.push_back(0);
  std::vector<char> covered(idx(connectivity.vertex_count), 0);
  PatchGrower grower(points, connectivity, normals, unfolded);
  std::size_t storage = 0;
  const auto add_patch = [&](int v) {
    grower.grow(v, options.patch_size);
    const auto& grown = grower.members();
    const double radius = grower.farthest() > 0 ? reach * grower.farthest() : 2 * edge_lengths[v];
    patches_.push_back({points.col(v), radius, storage, 0, PatchFit::as_wanted});
    storage += spline_storage_size(most_centres(grown.size()));
    for (std::size_t i = 0; i < grown.size(); ++i)
      if (i == 0 || (grower.distances()[i] <= options.coverage * radius && grower.is_inside(grown[i])))
        covered[idx(grown[i])] = 1;
    members.items.insert(members.items.end(), grown.begin(), grown.end());
    members.first.push_back(static_cast<int>(members.items.size()));
  };
  for (const bool wanted :
       {true, false})  // a folded vertex is a poor centre: only where nothing else covers it
    for (int v = 0; v < connectivity.vertex_count; ++v)
      if (!covered[idx(v)] && bool(unfolded[idx(v)]) == wanted && !connectivity.vertex_faces[v].empty())
        add_patch(v);
  storage_.resize(storage);
  return members;
}

void PartitionOfUnity::fit(const Eigen::Ref<const Mat3X>& points, const Mat3X& normals,
                           const Eigen::VectorXd& edge_lengths, const std::vector<char>& unfolded,
                           const IntLists& members, const PartitionOptions& options) {
  const auto gather = [&](std::size_t p, SplineData& data) {
    const Patch& patch = patches_[p];
    const auto vertices = members[static_cast<int>(p)];
    data.clear(most_centres(vertices.size()));
    for (int v : vertices) data.add((points.col(v) - patch.centre) / patch.radius, 0);
    for (std::size_t i = 0; i < vertices.size(); i += offset_stride) {  // [11] [13]
      const int v = vertices[i];
      if (!unfolded[idx(v)]) continue;
      const double rho = (i % (2 * offset_stride) == 0 ? 1 : -1) * options.offset * edge_lengths[v];
      data.add((points.col(v) + rho * normals.col(v) - patch.centre) / patch.radius, rho / patch.radius);
    }
  };
  parallel_for(patches_.size(), patches_per_task, [&](std::size_t begin, std::size_t end) {
    SplineWorkspace workspace;
    SplineGroup group;
    SplineGroup::Data data;
    for (std::size_t first = begin; first < end; first += lane_count) {
      SplineGroup::Flags wanted{};
      const std::size_t count = std::min(lane_count, end - first);
      for (std::size_t k = 0; k < count; ++k) {
        gather(first + k, data[k]);
        const std::size_t vertices = members[static_cast<int>(first + k)].size();
        wanted[k] = vertices >= least_quadratic_size && idx(static_cast<int>(data[k].count)) > vertices;
      }
      const SplineGroup::Flags fitted = group.fit(data, wanted, kernel_, coincidence);
      for (std::size_t k = 0; k < count; ++k) {
        Patch& patch = patches_[first + k];
        double* const storage = &storage_[patch.storage];
        if (fitted[k])
          group.store(data, k, storage);
        else
          patch.fit =
              fit_patch(data[k], kernel_, members[static_cast<int>(first + k)].size(), workspace, storage);
        patch.centres = static_cast<int>(data[k].count);
      }
    }
  });
}

void PartitionOfUnity::index_patches(int vertex_count, const IntLists& members) {
  const auto for_each_pair = [&](const auto& visit) {
    for (int p = 0; p < static_cast<int>(patches_.size()); ++p)
      if (patches_[idx(p)].fit != PatchFit::failed)
        for (int v : members[p]) visit(idx(v), p);
  };
  auto& [first, items] = vertex_patches_;
  first.assign(idx(vertex_count) + 1, 0);
  for_each_pair([&](std::size_t v, int) { ++first[v + 1]; });
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  items.resize(idx(first.back()));
  std::vector<int> next = first;
  for_each_pair([&](std::size_t v, int p) { items[idx(next[v]++)] = p; });
}

FieldSample PartitionOfUnity::operator()(const Vec3& x, int anchor) const {
  FieldSample sum;
  double total = 0;
  for (int p : vertex_patches_[anchor]) {
    const Patch& patch = patches_[idx(p)];
    const Vec3 local = (x - patch.centre) / patch.radius;
    const double r2 = local.squaredNorm();
    if (!(r2 < 1)) continue;
    const double w = weight(r2);
    const FieldSample s = evaluate_spline(&storage_[patch.storage], idx(patch.centres), kernel_, local);
    sum.value += w * patch.radius * s.value;
    sum.gradient += w * s.gradient;
    total += w;
  }
  if (total > 0) {
    sum.value /= total;
    sum.gradient /= total;
  }
  return sum;
}

std::size_t PartitionOfUnity::count(PatchFit fit) const {
  return static_cast<std::size_t>(std::ranges::count(patches_, fit, &Patch::fit));
}

std::size_t PartitionOfUnity::memory_bytes() const {
  return sizeof(Patch) * patches_.capacity() + sizeof(double) * storage_.capacity() +
         sizeof(int) * (vertex_patches_.first.capacity() + vertex_patches_.items.capacity());
}

}  // namespace hooke
