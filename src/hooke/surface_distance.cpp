#include "hooke/surface_distance.h"

#include <algorithm>
#include <cmath>

#include "hooke/parallel.h"

namespace hooke {
namespace {

constexpr size_t block = 256;  // faces whose samples are looked for together

using Face = BoundingVolumeTree::Face;

double area_of(const Face& face) {
  const auto& [a, b, c] = face.corners;
  return .5 * (b - a).cross(c - a).norm();
}

/// The samples of one face: its centre first, the quarters, then the edges and vertices that no face with a
/// lower id has.
class FaceSamples {
 public:
  FaceSamples(const MeasuredSurface& surface, const Face& face) {
    const Connectivity& c = surface.connectivity;
    const Vec3 centre = (face.corners[0] + face.corners[1] + face.corners[2]) / 3;
    add(centre);
    for (const Vec3& corner : face.corners) add(.5 * (corner + centre));
    for (int e : c.face_edges[static_cast<size_t>(face.id)]) {
      if (c.edge_faces[static_cast<size_t>(e)][0] != face.id) continue;
      edges_[edge_count_++] = e;
      const auto [a, b] = c.edges[static_cast<size_t>(e)];
      add(.5 * (surface.points.col(a) + surface.points.col(b)));
    }
    for (int v : face.vertices) {
      if (c.vertex_faces[v].front() != face.id) continue;
      vertices_[vertex_count_++] = v;
      add(surface.points.col(v));
    }
  }

  std::span<const Vec3> points() const { return {points_.data(), count_}; }

  void store(std::span<const ClosestPoint> closest, int face, DistanceSamples& samples) const {
    const auto distance = [&](size_t i) { return closest[i].squared_distance; };
    samples.centres[static_cast<size_t>(face)] = closest[0];
    samples.quarters[static_cast<size_t>(face)] = {distance(1), distance(2), distance(3)};
    for (size_t k = 0; k < edge_count_; ++k) samples.edges[static_cast<size_t>(edges_[k])] = distance(4 + k);
    for (size_t k = 0; k < vertex_count_; ++k)
      samples.vertices[static_cast<size_t>(vertices_[k])] = distance(4 + edge_count_ + k);
  }

 private:
  static constexpr size_t most = 10;

  void add(const Vec3& point) { points_[count_++] = point; }

  std::array<Vec3, most> points_;
  std::array<int, 3> edges_, vertices_;
  size_t count_ = 0, edge_count_ = 0, vertex_count_ = 0;
};

/// The face with the same id, if there is one.
int hint(const MeasuredSurface& surface, int face) {
  return face < static_cast<int>(surface.connectivity.faces.size()) ? face : -1;
}

}  // namespace

DistanceSamples sample_distances(const MeasuredSurface& from, const MeasuredSurface& to) {
  const Connectivity& c = from.connectivity;
  DistanceSamples samples;
  samples.vertices.resize(static_cast<size_t>(c.vertex_count));
  samples.edges.resize(c.edges.size());
  samples.centres.resize(c.faces.size());
  samples.quarters.resize(c.faces.size());
  const std::span<const Face> faces = from.tree.faces();
  const auto look = [&](size_t begin, size_t end) {
    std::vector<FaceSamples> wanted;
    std::vector<Vec3> points;
    std::vector<int> hints;
    for (const Face& face : faces.subspan(begin, end - begin)) {
      wanted.emplace_back(from, face);
      points.insert(points.end(), wanted.back().points().begin(), wanted.back().points().end());
      hints.resize(points.size(), hint(to, face.id));
    }
    std::vector<ClosestPoint> closest(points.size());
    to.tree.closest(points, hints, closest);
    std::span<const ClosestPoint> found = closest;
    for (size_t k = begin; k < end; ++k) {
      const FaceSamples& of_face = wanted[k - begin];
      of_face.store(found, faces[k].id, samples);
      found = found.subspan(of_face.points().size());
    }
  };
  parallel_for((faces.size() + block - 1) / block, 1,
               [&](size_t begin, size_t end) {  // one thread: all blocks
                 for (size_t k = begin; k < end; ++k)
                   look(k * block, std::min(faces.size(), (k + 1) * block));
               });
  return samples;
}

/// The rms takes each of the four quarters by the rule that is exact for quadratics: 1/12 at each corner, 3/4
/// at the centre.
MaxRms measure_distance(const MeasuredSurface& from, const DistanceSamples& samples) {
  const Connectivity& c = from.connectivity;
  const std::span<const Face> faces = from.tree.faces();
  std::vector<double> greatest(faces.size() / block + 1, 0);
  const double integral = parallel_sum(faces.size(), block, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t i = begin; i < end; ++i) {
      const auto f = static_cast<size_t>(faces[i].id);
      double corners = 0, midpoints = 0, centres = samples.centres[f].squared_distance;
      double& most = greatest[i / block];
      most = std::max(most, centres);
      for (size_t k = 0; k < 3; ++k) {
        const double corner = samples.vertices[static_cast<size_t>(faces[i].vertices[k])];
        const double midpoint = samples.edges[static_cast<size_t>(c.face_edges[f][k])];
        const double quarter = samples.quarters[f][k];
        most = std::max({most, corner, midpoint, quarter});
        corners += corner;
        midpoints += midpoint;
        centres += quarter;
      }
      // A midpoint is in three quarters.
      sum += area_of(faces[i]) * (corners / 48 + midpoints / 16 + centres * 3 / 16);
    }
    return sum;
  });
  const double area = from.extent.area;
  return {std::sqrt(*std::ranges::max_element(greatest)), area > 0 ? std::sqrt(integral / area) : 0};
}

}  // namespace hooke
