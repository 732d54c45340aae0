#include "hooke/measure/surface_distance.h"

#include <algorithm>
#include <cmath>

#include "hooke/core/parallel.h"
#include "hooke/geometry/nearest_faces.h"

namespace hooke {
namespace {

constexpr size_t block = 1024;

using Face = BoundingVolumeTree::Face;

double area_of(const Face& face) {
  const auto& [a, b, c] = face.corners;
  return .5 * (b - a).cross(c - a).norm();
}

/// The samples of a few faces: those that faces have in common once, and those of a face in one group.
class Samples {
 public:
  static constexpr size_t most_faces = 16;

  explicit Samples(std::span<const Face> faces) {
    for (const Face& face : faces) {
      const Vec3 centre = (face.corners[0] + face.corners[1] + face.corners[2]) / 3;
      add(centre);
      for (const Vec3& corner : face.corners) add(.5 * (corner + centre));
    }
    first_vertex_ = count_;
    for (const Face& face : faces) {
      OfFace& of_face = faces_[face_count_++];
      for (size_t k = 0; k < 3; ++k) of_face.corners[k] = add_vertex(face.vertices[k], face.corners[k]);
    }
    for (size_t f = 0; f < faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k) add_midpoint(faces[f], k, faces_[f]);
  }

  std::span<const Vec3> points() const { return {points_.data(), count_}; }
  static size_t centre_of(size_t face) { return 4 * face; }

  double greatest(std::span<const NearestFace> nearest, size_t face) const {
    double most = 0;
    for (size_t k = 0; k < 4; ++k) most = std::max(most, nearest[4 * face + k].squared_distance);
    for (size_t k = 0; k < 3; ++k)
      most = std::max({most, nearest[faces_[face].corners[k]].squared_distance,
                       nearest[faces_[face].midpoints[k]].squared_distance});
    return most;
  }

  /// Mean of the squares over the face: each of its four quarters by the rule that is exact for quadratics,
  /// 1/12 at each corner and 3/4 at the centre.
  double mean(std::span<const NearestFace> nearest, size_t face) const {
    double corners = 0, midpoints = 0, centres = 0;
    for (size_t k = 0; k < 4; ++k) centres += nearest[4 * face + k].squared_distance;
    for (size_t k = 0; k < 3; ++k) {
      corners += nearest[faces_[face].corners[k]].squared_distance;
      midpoints += nearest[faces_[face].midpoints[k]].squared_distance;
    }
    return corners / 48 + midpoints / 16 + centres * 3 / 16;  // a midpoint is in three quarters
  }

 private:
  struct OfFace {
    std::array<size_t, 3> corners, midpoints;  // places among the points
  };
  static constexpr size_t most_points = 10 * most_faces;

  size_t add(const Vec3& point) {
    points_[count_] = point;
    return count_++;
  }

  size_t add_vertex(int vertex, const Vec3& point) {
    size_t k = 0;
    while (k < vertex_count_ && vertices_[k] != vertex) ++k;
    if (k < vertex_count_) return first_vertex_ + k;
    vertices_[vertex_count_++] = vertex;
    return add(point);
  }

  void add_midpoint(const Face& face, size_t k, OfFace& of_face) {
    const auto [a, b] = std::minmax(of_face.corners[k], of_face.corners[(k + 1) % 3]);
    unsigned char& known = midpoints_[a - first_vertex_][b - first_vertex_];
    if (known == 0)
      known = static_cast<unsigned char>(add(.5 * (face.corners[k] + face.corners[(k + 1) % 3])));
    of_face.midpoints[k] = known;
  }

  std::array<Vec3, most_points> points_;
  std::array<OfFace, most_faces> faces_;
  std::array<int, 3 * most_faces> vertices_;
  std::array<std::array<unsigned char, 3 * most_faces>, 3 * most_faces> midpoints_{};  // by ends; 0: none yet
  size_t count_ = 0, face_count_ = 0, vertex_count_ = 0, first_vertex_ = 0;
};

}  // namespace

MaxRms measure_distance(const MeasuredSurface& from, const MeasuredSurface& to,
                        std::vector<TreeFoot>* centres) {
  const std::span<const Face> faces = from.tree.faces();
  if (centres) centres->assign(faces.size(), {});
  std::vector<double> greatest(faces.size() / block + 1, 0);
  std::vector<double> integrals(faces.size());  // by id
  const auto look = [&](size_t begin, size_t end) {
    NearestFaceSearch find(to.tree);
    std::vector<NearestFace> nearest;
    for (size_t first = begin; first < end; first += Samples::most_faces) {
      const auto some = faces.subspan(first, std::min(Samples::most_faces, end - first));
      const Samples samples(some);
      nearest.resize(samples.points().size());
      find(samples.points(), nearest);
      for (size_t k = 0; k < some.size(); ++k) {
        const auto id = static_cast<size_t>(some[k].id);
        greatest[begin / block] = std::max(greatest[begin / block], samples.greatest(nearest, k));
        integrals[id] = area_of(some[k]) * samples.mean(nearest, k);
        const size_t centre = Samples::centre_of(k);
        if (!centres || nearest[centre].place < 0) continue;
        const auto& [a, b, c] = to.tree.faces()[static_cast<size_t>(nearest[centre].place)].corners;
        (*centres)[first + k] = {closest_point(samples.points()[centre], a, b, c).point,
                                 nearest[centre].place};
      }
    }
  };
  parallel_for(greatest.size(), 1, [&](size_t begin, size_t end) {  // one thread: all blocks
    for (size_t k = begin; k < end; ++k) look(k * block, std::min(faces.size(), (k + 1) * block));
  });
  const double integral = parallel_sum(faces.size(), block, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t f = begin; f < end; ++f) sum += integrals[f];
    return sum;
  });
  const double area = from.extent.area;
  return {std::sqrt(*std::ranges::max_element(greatest)), area > 0 ? std::sqrt(integral / area) : 0};
}

}  // namespace hooke
