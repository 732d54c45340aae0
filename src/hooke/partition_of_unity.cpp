#include "hooke/partition_of_unity.h"

#include <algorithm>

#include "hooke/normals.h"
#include "hooke/parallel.h"

namespace hooke {
namespace {

constexpr double least_normal_agreement =
    -.2;  // of a patch's vertices with its centre: stops at the other sheet
constexpr double least_fold_agreement =
    .3;                                   // of a vertex normal with its faces: a folded ring has no outside
constexpr double reach = 1.1;             // radius over the distance of the farthest vertex
constexpr int least_quadratic_size = 15;  // vertices of a patch that get a quadratic part
constexpr double coincidence = 1e-6;      // in radii: two centres closer than this count once
constexpr std::size_t patches_per_task = 32;

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

/// Breadth-first search over mesh edges, by vertex order, within the cone of normals of the first vertex.
class PatchGrower {
 public:
  PatchGrower(const Connectivity& connectivity, const Mat3X& normals)
      : connectivity_(connectivity), normals_(normals), seen_by_(idx(connectivity.vertex_count), -1) {}

  /// The vertices nearest to `centre`, at most `size` of them, in the order in which they are found.
  const std::vector<int>& grow(int centre, int size) {
    members_.assign(1, centre);
    ++search_;
    seen_by_[idx(centre)] = search_;
    const Vec3 axis = normals_.col(centre);
    for (std::size_t i = 0; i < members_.size(); ++i)
      for (int n : connectivity_.vertex_neighbours[members_[i]]) {
        if (members_.size() >= idx(size)) return members_;
        if (seen_by_[idx(n)] == search_) continue;
        seen_by_[idx(n)] = search_;
        if (normals_.col(n).dot(axis) > least_normal_agreement) members_.push_back(n);
      }
    return members_;
  }

 private:
  const Connectivity& connectivity_;
  const Mat3X& normals_;
  std::vector<int> seen_by_;  // the last search that met the vertex
  std::vector<int> members_;
  int search_ = -1;
};

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

/// Centres and values of one spline, in coordinates scaled by the patch.
struct SplineData {
  Mat3X centres;
  Eigen::VectorXd values;
  Eigen::Index count = 0;

  void clear(std::size_t capacity) {
    centres.resize(3, static_cast<Eigen::Index>(capacity));
    values.resize(static_cast<Eigen::Index>(capacity));
    count = 0;
  }
  void add(const Vec3& centre, double value) {
    for (Eigen::Index i = 0; i < count; ++i)
      if ((centres.col(i) - centre).squaredNorm() < coincidence * coincidence) return;
    centres.col(count) = centre;
    values[count++] = value;
  }
};

/// Vertices and offsets of a patch: at most this many.
std::size_t most_centres(std::size_t vertices) {
  return vertices + (vertices + 1) / 2;
}

}  // namespace

PartitionOfUnity::PartitionOfUnity(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity,
                                   const Mat3X& normals, const Eigen::VectorXd& edge_lengths,
                                   const PartitionOptions& options)
    : kernel_(options.kernel) {
  IntLists members;  // vertices of each patch
  members.first.push_back(0);
  std::vector<char> covered(idx(connectivity.vertex_count), 0);
  PatchGrower grower(connectivity, normals);
  std::size_t storage = 0;
  for (int v = 0; v < connectivity.vertex_count; ++v) {
    if (covered[idx(v)] || connectivity.vertex_faces[v].empty()) continue;
    const auto& grown = grower.grow(v, options.patch_size);
    Patch patch;
    patch.centre = points.col(v);
    double farthest = 0;
    for (int m : grown) farthest = std::max(farthest, (points.col(m) - patch.centre).norm());
    patch.radius = farthest > 0 ? reach * farthest : 2 * edge_lengths[v];
    for (int m : grown)
      if ((points.col(m) - patch.centre).norm() <= options.coverage * patch.radius) covered[idx(m)] = 1;
    patch.storage = storage;
    storage += spline_storage_size(most_centres(grown.size()));
    patches_.push_back(patch);
    members.items.insert(members.items.end(), grown.begin(), grown.end());
    members.first.push_back(static_cast<int>(members.items.size()));
  }
  storage_.resize(storage);

  const std::vector<char> unfolded = unfolded_vertices(points, connectivity, normals);
  parallel_for(patches_.size(), patches_per_task, [&](std::size_t begin, std::size_t end) {
    SplineWorkspace workspace;
    SplineData data;
    for (std::size_t p = begin; p < end; ++p) {
      Patch& patch = patches_[p];
      const auto vertices = members[static_cast<int>(p)];
      data.clear(most_centres(vertices.size()));
      for (int v : vertices) data.add((points.col(v) - patch.centre) / patch.radius, 0);
      for (std::size_t i = 0; i < vertices.size(); i += 2) {  // [11] [13]
        const int v = vertices[i];
        if (!unfolded[idx(v)]) continue;
        const double rho = (i % 4 == 0 ? 1 : -1) * options.offset * edge_lengths[v];
        data.add((points.col(v) + rho * normals.col(v) - patch.centre) / patch.radius, rho / patch.radius);
      }
      const auto fit = [&](SplineDegree degree) {
        return fit_spline(data.centres.leftCols(data.count), data.values.head(data.count), kernel_, degree,
                          workspace, &storage_[patch.storage]);
      };
      const bool determined = !data.values.head(data.count).isZero(0);
      const bool quadratic = static_cast<int>(vertices.size()) >= least_quadratic_size;
      patch.centres = static_cast<int>(data.count);
      if (determined && quadratic && fit(2)) continue;
      if (determined && fit(1)) {
        if (quadratic) patch.fit = Patch::affine;
        continue;
      }
      patch.fit = Patch::plane;
      patch.centres = 0;
      store_affine_spline(0, normals.col(vertices[0]), &storage_[patch.storage]);
    }
  });

  std::vector<int> next(idx(connectivity.vertex_count) + 1, 0);
  for (int v : members.items) ++next[idx(v) + 1];
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  vertex_patches_.first = next;
  vertex_patches_.items.resize(members.items.size());
  for (int p = 0; p < static_cast<int>(patches_.size()); ++p)
    for (int v : members[p]) vertex_patches_.items[idx(next[idx(v)]++)] = p;
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

std::size_t PartitionOfUnity::affine_fallbacks() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(patches_, [](const Patch& p) { return p.fit == Patch::affine; }));
}

std::size_t PartitionOfUnity::plane_fallbacks() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(patches_, [](const Patch& p) { return p.fit == Patch::plane; }));
}

std::size_t PartitionOfUnity::memory_bytes() const {
  return sizeof(Patch) * patches_.capacity() + sizeof(double) * storage_.capacity() +
         sizeof(int) * (vertex_patches_.first.capacity() + vertex_patches_.items.capacity());
}

}  // namespace hooke
