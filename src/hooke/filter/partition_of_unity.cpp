#include "hooke/filter/partition_of_unity.h"

#include <algorithm>
#include <span>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

constexpr int patch_size = 30;  // vertices

constexpr double min_normal_agreement = -.2;  // minimum cosine with the axis: excludes the opposite sheet
constexpr double tie = 1 + 1e-6;              // for distances: rounding must not choose between equal ones

}  // namespace

PatchGrower::PatchGrower(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                         const Mat3X& normals, const std::vector<char>& unfolded)
    : points_(points),
      adjacency_(adjacency),
      normals_(normals),
      unfolded_(unfolded),
      visited_in_(adjacency.vertex_count, -1),
      member_in_(adjacency.vertex_count, -1) {}

void PatchGrower::grow(int centre, int size) {
  axis_ = axis_at(centre);
  search(centre, size + size / 2);
  distances_.clear();
  for (int m : members_) distances_.push_back((points_.col(m) - points_.col(centre)).norm());
  std::vector<double> sorted = distances_;
  const auto last = sorted.begin() + std::min(size, static_cast<int>(sorted.size())) - 1;
  std::nth_element(sorted.begin(), last, sorted.end());
  farthest_ = *last;

  std::size_t kept = 0;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (distances_[i] > farthest_ * tie) continue;
    members_[kept] = members_[i];
    distances_[kept++] = distances_[i];
    member_in_[members_[i]] = round_;
  }
  members_.resize(kept);
  distances_.resize(kept);
}

bool PatchGrower::is_inside(int vertex) const {
  return std::ranges::all_of(adjacency_.vertex_neighbours[vertex],
                             [&](int n) { return member_in_[n] == round_ || !is_admitted(n); });
}

/// Folded vertices are always admitted: their normals are meaningless.
bool PatchGrower::is_admitted(int vertex) const {
  return !unfolded_[vertex] || normals_.col(vertex).dot(axis_) > min_normal_agreement;
}

/// The normal of the centre or, where that is meaningless, the mean normal of its unfolded neighbours.
Vec3 PatchGrower::axis_at(int centre) const {
  Vec3 sum = Vec3::Zero();
  if (!unfolded_[centre])
    for (int n : adjacency_.vertex_neighbours[centre])
      if (unfolded_[n]) sum += normals_.col(n);
  return sum.isZero(0) ? Vec3(normals_.col(centre)) : sum.normalized();
}

void PatchGrower::search(int centre, std::size_t max_size) {
  ++round_;
  members_.assign(1, centre);
  visited_in_[centre] = round_;
  for (std::size_t i = 0; i < members_.size(); ++i)
    for (int n : adjacency_.vertex_neighbours[members_[i]]) {
      if (members_.size() >= max_size) return;
      if (visited_in_[n] == round_) continue;
      visited_in_[n] = round_;
      if (is_admitted(n)) members_.push_back(n);
    }
}

namespace {

constexpr double patch_radius_ratio = .9;  // radius of a patch over the distance of its farthest vertex

}  // namespace

PatchCover::PatchCover(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                       const Mat3X& normals, const Eigen::VectorXd& edge_lengths,
                       const std::vector<char>& unfolded)
    : adjacency_(adjacency),
      edge_lengths_(edge_lengths),
      unfolded_(unfolded),
      grower_(points, adjacency, normals, unfolded),
      covered_(adjacency.vertex_count, 0) {}

PatchList PatchCover::next(size_t count) {
  PatchList patches;
  patches.members.first.push_back(0);
  while (patches.size() < count) {
    if (vertex_ == adjacency_.vertex_count) {
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
  const size_t v = vertex;
  return !covered_[v] && (unfolded_[v] == 0) == folded_ && !adjacency_.vertex_faces[vertex].empty();
}

void PatchCover::add_patch(int centre, PatchList& patches) {
  grower_.grow(centre, patch_size);
  const std::vector<int>& members = grower_.members();
  const double radius =
      grower_.farthest() > 0 ? patch_radius_ratio * grower_.farthest() : 2 * edge_lengths_[centre];
  for (size_t i = 0; i < members.size(); ++i)
    if (i == 0 || (grower_.distances()[i] <= patch_coverage * radius && grower_.is_inside(members[i])))
      covered_[members[i]] = 1;
  patches.centres.push_back(centre);
  patches.radii.push_back(radius);
  patches.members.items.insert(patches.members.items.end(), members.begin(), members.end());
  patches.members.first.push_back(static_cast<int>(patches.members.items.size()));
}

namespace {

constexpr double min_fold_agreement = .3;       // minimum cosine of a vertex normal with its faces
constexpr std::size_t min_quadratic_size = 15;  // minimum number of patch vertices for a quadratic part
constexpr double coincidence = 1e-6;            // in radii; centres closer than this are dropped
constexpr double min_height = 1e-8;             // in radii; smaller values are not offsets

/// Several times as many as other vertices have: the hub of a fan lies in the patches of all its neighbours,
/// and each point tracked there would evaluate them all.
constexpr std::size_t max_patches_of_vertex = 64;

/// Patches per batch: many in a large mesh, so that short-lived small allocations do not fragment memory.
std::size_t patches_of_batch(int vertices) {
  return std::clamp<std::size_t>(vertices / 1000, 32, 512);
}

/// Wendland's C2 function of the squared distance over the squared radius, for r2 < 1.
double weight(double r2) {
  const double r = std::sqrt(r2), s = (1 - r) * (1 - r);
  return s * s * (4 * r + 1);
}

/// Marks the vertices whose normal is on the outer side of all their faces.
std::vector<char> unfolded_vertices(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                                    const Mat3X& normals) {
  const Mat3X of_faces = face_normals(points, adjacency);
  std::vector<char> unfolded(adjacency.vertex_count, 0);
  parallel_for(unfolded.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
      double smallest = normals.col(v).squaredNorm();
      for (int f : adjacency.vertex_faces[v])
        smallest = std::min(smallest, of_faces.col(f).dot(normals.col(v)));
      unfolded[v] = smallest >= min_fold_agreement;
    }
  });
  return unfolded;
}

/// Every third vertex of a patch has an offset point, outside and inside in turn; more offsets do not improve
/// the fit.
constexpr std::size_t offset_stride = 3;

/// Maximum number of centres of a patch: its vertices and their offset points.
std::size_t max_centres(std::size_t vertices) {
  return vertices + (vertices + offset_stride - 1) / offset_stride;
}

/// Fits a single patch that SplineGroup has no spline for: without repeated centres, and with an affine part
/// if the quadratic one is not determined. Returns nothing if that fails too.
std::optional<SplineCoefficients> fit_single(SplineData& data, Kernel kernel, std::size_t vertices,
                                             SplineWorkspace& workspace, PatchFit& fit) {
  data.drop_repeated(coincidence);
  const auto centres = data.centres.leftCols(data.count);
  const auto values = data.values.head(data.count);
  const bool quadratic = vertices >= min_quadratic_size;
  fit = PatchFit::failed;
  if (data.count == 0 || values.isZero(min_height)) return std::nullopt;  // the outside is unknown
  std::optional<SplineCoefficients> spline;
  if (quadratic && (spline = fit_spline(centres, values, kernel, 2, workspace)))
    fit = PatchFit::as_requested;
  else if ((spline = fit_spline(centres, values, kernel, 1, workspace)))
    fit = quadratic ? PatchFit::affine : PatchFit::as_requested;
  return spline;
}

}  // namespace

PartitionOfUnity::PartitionOfUnity(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                                   const Mat3X& normals, const Eigen::VectorXd& edge_lengths,
                                   const PartitionOptions& options)
    : kernel_(options.kernel) {
  const std::vector<char> unfolded = unfolded_vertices(points, adjacency, normals);
  const Samples samples{points, normals, edge_lengths, unfolded, options.offset};
  PatchCover cover(points, adjacency, normals, edge_lengths, unfolded);
  std::deque<Batch> batches;
  const auto next_batch = [&]() -> Batch* {
    PatchList list = cover.next(patches_of_batch(adjacency.vertex_count));
    if (list.size() == 0) return nullptr;
    batches.push_back({std::move(list), {}, {}});
    return &batches.back();
  };
  parallel_pipeline<Batch>(next_batch, [&](Batch& batch) { fit(samples, batch); });
  std::size_t count = 0;
  for (const Batch& batch : batches) count += batch.patches.size();
  patches_.reserve(count);
  storage_.reserve(batches.size());
  for (Batch& batch : batches) {
    patches_.insert(patches_.end(), batch.patches.begin(), batch.patches.end());
    storage_.push_back(std::move(batch.storage));
  }
  index_patches(points, batches);
}

/// Coordinates are relative to the centre, in radii. The field is zero at the vertices [11] and a distance
/// near them [13]; snapping a centre changes its value by the displacement along the normal.
void PartitionOfUnity::gather(const Samples& samples, const PatchList& list, std::size_t patch,
                              SplineData& data) {
  const auto vertices = list.members[static_cast<int>(patch)];
  const Vec3 centre = samples.points.col(list.centres[patch]);
  const double radius = list.radii[patch];
  data.clear(max_centres(vertices.size()));
  if (!(radius > 0)) return;
  const auto add = [&](const Vec3& position, int v, double height) {
    const Vec3 local = (position - centre) / radius, snap = snapped(local);
    data.add(snap, height / radius + samples.normals.col(v).dot(snap - local));
  };
  for (int v : vertices) add(samples.points.col(v), v, 0);
  for (std::size_t i = 0; i < vertices.size(); i += offset_stride) {
    const int v = vertices[i];
    if (!samples.unfolded[v]) continue;
    const double rho = (i % (2 * offset_stride) == 0 ? 1 : -1) * samples.offset * samples.edge_lengths[v];
    add(samples.points.col(v) + rho * samples.normals.col(v), v, rho);
  }
}

void PartitionOfUnity::fit(const Samples& samples, Batch& batch) const {
  using Stored = StoredSpline<SnappedCoordinate>;
  const PatchList& list = batch.list;
  const auto vertices = [&](std::size_t p) { return list.members[static_cast<int>(p)].size(); };
  std::size_t coordinates = 0, coefficients = 0;
  for (std::size_t p = 0; p < list.size(); ++p) {
    coordinates += Stored::coordinates_size(max_centres(vertices(p)));
    coefficients += Stored::coefficients_size(max_centres(vertices(p)));
  }
  batch.patches.reserve(list.size());
  batch.storage.coordinates.resize(coordinates);
  batch.storage.coefficients.resize(coefficients);
  SnappedCoordinate* coordinate = batch.storage.coordinates.data();
  double* coefficient = batch.storage.coefficients.data();
  const auto store = [&](const SplineData& data, const SplineCoefficients& spline) {
    const Stored stored = store_spline(data.centres.leftCols(data.count), spline, coordinate, coefficient);
    coordinate += Stored::coordinates_size(stored.centres);
    coefficient += Stored::coefficients_size(stored.centres);
    return stored;
  };

  SplineWorkspace workspace;
  SplineGroup group;
  SplineGroup::Data data;
  for (std::size_t first = 0; first < list.size(); first += lane_count) {
    SplineGroup::Flags requested{};
    const std::size_t count = std::min(lane_count, list.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      gather(samples, list, first + k, data[k]);
      requested[k] =
          vertices(first + k) >= min_quadratic_size && std::cmp_greater(data[k].count, vertices(first + k));
    }
    const SplineGroup::Flags fitted = group.fit(data, requested, kernel_, coincidence);
    for (std::size_t k = 0; k < count; ++k) {
      Patch patch{samples.points.col(list.centres[first + k]), list.radii[first + k]};
      if (fitted[k])
        patch.spline = store(data[k], group.solution(k, data[k].count));
      else if (const auto spline = fit_single(data[k], kernel_, vertices(first + k), workspace, patch.fit))
        patch.spline = store(data[k], *spline);
      batch.patches.push_back(patch);
    }
  }
}

void PartitionOfUnity::index_patches(const Eigen::Ref<const Mat3X>& points,
                                     const std::deque<Batch>& batches) {
  const auto for_each_pair = [&](const auto& visit) {
    int id = 0;
    for (const Batch& batch : batches)
      for (std::size_t p = 0; p < batch.patches.size(); ++p, ++id)
        if (batch.patches[p].fit != PatchFit::failed)
          for (int v : batch.list.members[static_cast<int>(p)]) visit(v, id);
  };
  std::vector<int>&first = vertex_patches_.first, &items = vertex_patches_.items;
  first.assign(points.cols() + 1, 0);
  for_each_pair([&](std::size_t v, int) { ++first[v + 1]; });
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  items.resize(first.back());
  std::vector<int> next = first;
  for_each_pair([&](std::size_t v, int p) { items[next[v]++] = p; });
  drop_shallow_patches(points);
}

/// Leaves no vertex more than max_patches_of_vertex patches: those in which it lies deepest, in their order.
void PartitionOfUnity::drop_shallow_patches(const Eigen::Ref<const Mat3X>& points) {
  std::vector<int>&first = vertex_patches_.first, &items = vertex_patches_.items;
  int kept = 0;
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    const int begin = std::exchange(first[v], kept);
    std::span<int> patches(items.data() + begin, items.data() + first[v + 1]);
    if (patches.size() > max_patches_of_vertex) {
      const Vec3 place = points.col(static_cast<Eigen::Index>(v));
      const auto shallowness = [&](int p) {
        return std::pair(((place - patches_[p].centre) / patches_[p].radius).squaredNorm(), p);
      };
      std::ranges::nth_element(patches, patches.begin() + max_patches_of_vertex, {}, shallowness);
      patches = patches.first(max_patches_of_vertex);
      std::ranges::sort(patches);
    }
    if (kept < begin) std::ranges::copy(patches, items.begin() + kept);
    kept += static_cast<int>(patches.size());
  }
  first.back() = kept;
  items.resize(kept);
}

FieldSample PartitionOfUnity::operator()(const Vec3& x, int hint) const {
  FieldSample sum;
  double total = 0;
  for (int p : vertex_patches_[hint]) {
    const Patch& patch = patches_[p];
    const Vec3 local = (x - patch.centre) / patch.radius;
    const double r2 = local.squaredNorm();
    if (!(r2 < 1)) continue;
    const double w = weight(r2);
    const FieldSample s = patch.spline(kernel_, local);
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
  return std::ranges::count(patches_, fit, &Patch::fit);
}

std::size_t PartitionOfUnity::memory_bytes() const {
  std::size_t splines = 0;
  for (const Storage& s : storage_)
    splines +=
        sizeof(SnappedCoordinate) * s.coordinates.capacity() + sizeof(double) * s.coefficients.capacity();
  return sizeof(Patch) * patches_.capacity() + splines +
         sizeof(int) * (vertex_patches_.first.capacity() + vertex_patches_.items.capacity());
}

}  // namespace hooke
