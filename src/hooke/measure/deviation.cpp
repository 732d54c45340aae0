#include "hooke/measure/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/core/parallel.h"
#include "hooke/geometry/closest_faces.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/surface_point.h"

namespace hooke {
namespace {

constexpr size_t deviation_block = 1024;

using Face = AabbTree::Face;

double area_of(const Face& face) {
  const auto& [a, b, c] = face.corners;
  return .5 * (b - a).cross(c - a).norm();
}

Vec3 middle_of(const Face& face) {
  return (face.corners[0] + face.corners[1] + face.corners[2]) / 3;
}

/// The samples of a few faces. Those shared by faces occur once; those inside a face are consecutive.
class Samples {
 public:
  static constexpr size_t max_faces = 16;

  explicit Samples(std::span<const Face> faces) {
    for (const Face& face : faces) {
      const Vec3 centre = middle_of(face);
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
  size_t corner_of(size_t face, size_t corner) const { return faces_[face].corners[corner]; }

  double max_squared(std::span<const NearestFace> nearest, size_t face) const {
    double largest = 0;
    for (size_t k = 0; k < 4; ++k) largest = std::max(largest, nearest[4 * face + k].squared_distance);
    for (size_t k = 0; k < 3; ++k)
      largest = std::max({largest, nearest[faces_[face].corners[k]].squared_distance,
                          nearest[faces_[face].midpoints[k]].squared_distance});
    return largest;
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
    std::array<size_t, 3> corners, midpoints;  // indices into the points
  };
  static constexpr size_t max_points = 10 * max_faces;

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

  std::array<Vec3, max_points> points_;
  std::array<OfFace, max_faces> faces_;
  std::array<int, 3 * max_faces> vertices_;
  std::array<std::array<unsigned char, 3 * max_faces>, 3 * max_faces> midpoints_{};  // by ends; 0: none yet
  size_t count_ = 0, face_count_ = 0, vertex_count_ = 0, first_vertex_ = 0;
};

}  // namespace

MaxRms measure_distance(const MeasuredSurface& from, const MeasuredSurface& to, VertexDistances& vertices,
                        std::vector<ClosestFacePoint>* centres) {
  const std::span<const Face> faces = from.tree.faces();
  const size_t vertex_count = from.adjacency.vertex_count;
  vertices = {std::vector<double>(vertex_count, 0), std::vector<int>(vertex_count, -1)};
  if (centres) centres->assign(faces.size(), {});
  std::vector<double> max_squared(faces.size() / deviation_block + 1, 0);
  std::vector<double> integrals(faces.size());  // by id
  const auto measure_block = [&](size_t begin, size_t end) {
    NearestFaceSearch find(to.tree);
    std::vector<NearestFace> nearest;
    for (size_t first = begin; first < end; first += Samples::max_faces) {
      const auto some = faces.subspan(first, std::min(Samples::max_faces, end - first));
      const Samples samples(some);
      nearest.resize(samples.points().size());
      find(samples.points(), nearest);
      for (size_t k = 0; k < some.size(); ++k) {
        const size_t id = some[k].id;
        max_squared[begin / deviation_block] =
            std::max(max_squared[begin / deviation_block], samples.max_squared(nearest, k));
        integrals[id] = area_of(some[k]) * samples.mean(nearest, k);
        for (size_t corner = 0; corner < 3; ++corner) {
          const int v = some[k].vertices[corner];
          if (from.adjacency.vertex_faces[v].front() != some[k].id) continue;  // another face tells
          const NearestFace& at_vertex = nearest[samples.corner_of(k, corner)];
          vertices.distances[v] = std::sqrt(at_vertex.squared_distance);
          if (at_vertex.index >= 0) vertices.faces[v] = to.tree.faces()[at_vertex.index].id;
        }
        const size_t centre = Samples::centre_of(k);
        if (!centres || nearest[centre].index < 0) continue;
        const auto& [a, b, c] = to.tree.faces()[nearest[centre].index].corners;
        (*centres)[first + k] = {closest_point(samples.points()[centre], a, b, c).point,
                                 nearest[centre].index};
      }
    }
  };
  parallel_for(max_squared.size(), 1,
               [&](size_t begin, size_t end) {  // a single thread gets all blocks at once
                 for (size_t k = begin; k < end; ++k)
                   measure_block(k * deviation_block, std::min(faces.size(), (k + 1) * deviation_block));
               });
  const double integral = parallel_sum(faces.size(), deviation_block, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t f = begin; f < end; ++f) sum += integrals[f];
    return sum;
  });
  const double area = from.extent.area;
  return {std::sqrt(*std::ranges::max_element(max_squared)), area > 0 ? std::sqrt(integral / area) : 0};
}

namespace {

/// Normal vector whose length is twice the area.
Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}
Vec3 area_vector(const Mat3X& points, const Triangle& t) {
  return area_vector(points.col(t[0]), points.col(t[1]), points.col(t[2]));
}

using Face = AabbTree::Face;

Vec3 area_vector(const Face& face) {
  return area_vector(face.corners[0], face.corners[1], face.corners[2]);
}

const Face& face_at(const MeasuredSurface& surface, const ClosestFacePoint& projection) {
  return surface.tree.faces()[projection.face_index];
}

Vec3 weights_at(const Face& face, const ClosestFacePoint& projection) {
  return barycentric(projection.point, face.corners[0], face.corners[1], face.corners[2]);
}

/// Points in the order of the vertex ids of the mesh.
Mat3X points_by_id(const MeasuredSurface& surface) {
  Mat3X points(3, surface.points.cols());
  for (int v = 0; v < surface.adjacency.vertex_count; ++v)
    points.col(surface.ids.vertex(v)) = surface.points.col(v);
  return points;
}

MaxRms measure_displacement(const Mat3X& before, const Mat3X& after) {
  MaxRms displacement;
  double squares = 0;
  for (Eigen::Index v = 0; v < before.cols(); ++v) {
    const double d = (after.col(v) - before.col(v)).squaredNorm();
    displacement.max = std::max(displacement.max, d);
    squares += d;
  }
  displacement.max = std::sqrt(displacement.max);
  if (before.cols() > 0) displacement.rms = std::sqrt(squares / static_cast<double>(before.cols()));
  return displacement;
}

/// Angle in degrees between two normal vectors of any length; NaN if one is zero.
double angle_of_normals(const Vec3& n, const Vec3& m) {
  if (!(n.squaredNorm() > 0 && m.squaredNorm() > 0)) return std::numeric_limits<double>::quiet_NaN();
  return angle_between(n, m);
}

/// The vertices of a face in its own sheet, which the tree has joined to those of others.
const Triangle& corners_in_sheet(const MeasuredSurface& surface, const Face& face) {
  return surface.adjacency.faces[face.id];
}

/// Does a face with this area vector oppose the reference at the closest point, which is on `there`, or one
/// of its folded faces? On an edge or a vertex this is the closest point of several faces.
bool opposes(const MeasuredSurface& reference, int there, const Vec3& point, const Vec3& n) {
  constexpr double on_side = 1e-9;  // of a barycentric weight
  constexpr double fold = -.1;      // cosine; a right-angled crease is no fold
  const Triangle& t = reference.adjacency.faces[there];
  const Vec3 of_face = area_vector(reference.points, t);
  if (n.dot(of_face) < 0) return true;
  const Vec3 weights =
      barycentric(point, reference.points.col(t[0]), reference.points.col(t[1]), reference.points.col(t[2]));
  const auto touches = [&](const Triangle& other) {
    for (size_t k = 0; k < 3; ++k)
      if (weights[static_cast<Eigen::Index>(k)] > on_side && std::ranges::find(other, t[k]) == other.end())
        return false;
    return true;
  };
  if (weights.minCoeff() > on_side) return false;
  const Vec3 own = of_face.normalized();
  Eigen::Index corner = 0;
  weights.maxCoeff(&corner);
  for (int f : reference.adjacency.vertex_faces[t[corner]]) {
    const Triangle& other = reference.adjacency.faces[f];
    const Vec3 m = area_vector(reference.points, other).normalized();
    if (touches(other) && m.dot(own) < fold && m.dot(n) < 0) return true;
  }
  return false;
}

/// `closest` has one entry per face centre of the result, in the order of its tree.
MaxRms measure_normal_deviation(const MeasuredSurface& reference, const MeasuredSurface& result,
                                const std::vector<ClosestFacePoint>& closest) {
  const std::span<const Face> faces = result.tree.faces();
  std::vector<double> angles(closest.size()), weights(closest.size());
  parallel_for(faces.size(), deviation_block, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      if (closest[k].face_index < 0) continue;
      const size_t f = faces[k].id;
      const Vec3 n = area_vector(faces[k]);
      angles[f] = angle_of_normals(n, area_vector(face_at(reference, closest[k])));
      weights[f] = n.norm();
    }
  });
  MaxRms deviation;
  double area = 0, integral = 0;
  for (size_t f = 0; f < angles.size(); ++f) {
    if (std::isnan(angles[f])) continue;
    deviation.max = std::max(deviation.max, angles[f]);
    area += weights[f];
    integral += weights[f] * angles[f] * angles[f];
  }
  if (area > 0) deviation.rms = std::sqrt(integral / area);
  return deviation;
}

constexpr double across_sheets = .25;  // of an edge

/// Edges as degenerate triangles, the form in which the tree accepts segments.
template <typename IsMeant>
std::vector<Triangle> segments_of(const Adjacency& adjacency, const IsMeant& is_meant) {
  std::vector<Triangle> segments;
  for (size_t e = 0; e < adjacency.edges.size(); ++e) {
    const auto [a, b] = adjacency.edges[e];
    if (is_meant(static_cast<int>(e))) segments.push_back({a, b, b});
  }
  return segments;
}

AabbTree folded_edges(const MeasuredSurface& surface) {
  return {surface.points, segments_of(surface.adjacency, [&](int e) {
            return is_folded_edge(surface.points, surface.adjacency, e);
          })};
}

/// Is there a fold between this face and a neighbour, where the reference has none?
bool folds_anew(const MeasuredSurface& surface, int face, const AabbTree& reference_folds) {
  const Adjacency& c = surface.adjacency;
  return std::ranges::any_of(c.face_edges[face], [&](int e) {
    if (!is_folded_edge(surface.points, c, e)) return false;
    const Vec3 a = surface.points.col(c.edges[e][0]), b = surface.points.col(c.edges[e][1]);
    const ClosestPoint fold = reference_folds.closest((a + b) / 2);
    return fold.face < 0 || fold.squared_distance > across_sheets * across_sheets * (b - a).squaredNorm();
  });
}

/// Finds the faces of a result that are turned over.
class TurnedFaces {
 public:
  /// `normals`: of the vertices of the reference.
  TurnedFaces(const MeasuredSurface& reference, const MeasuredSurface& result, const Mat3X& normals)
      : reference_(reference),
        result_(result),
        normals_(normals),
        shell_(label_shells(reference.adjacency, reference.joined)),
        folds_(folded_edges(reference)) {}

  /// Is there no face of the reference about as close to the centre of this face of the result as the closest
  /// one, `at`, that faces the same way, as `n` does? Beside creases and on thin walls there is one. Where
  /// shells cross, or the face cuts deeper into a rounding than a wall is thick, the closest one may be of
  /// another sheet: one of its own is close then by the size of the face.
  bool faces_no_like(const Face& face, const Vec3& n, const ClosestFacePoint& at) const {
    const Vec3 centre = middle_of(face);
    if (!(n.norm() > 0) || faces_like_own_shell(face, centre, n)) return false;
    const ClosestPoint like = closest_like(centre, n);
    if (like.face < 0) return true;
    double limit = limit_of_like((centre - at.point).norm());
    if (like.squared_distance > limit * limit && (is_of_other_shell(like, at) || lies_on_like(face, n)))
      for (size_t k = 0; k < 3; ++k)
        limit = std::max(limit, across_sheets * (face.corners[(k + 1) % 3] - face.corners[k]).norm());
    return like.squared_distance > limit * limit;
  }

  /// Does its centre lie on a face of the reference that faces the same way, as where bodies share a wall?
  bool lies_on_face_like(const Face& face, const Vec3& n) const {
    constexpr double rounding = 1e-12;  // of the diagonal
    const double limit = rounding * reference_.extent.diagonal;
    return closest_like(middle_of(face), n).squared_distance <= limit * limit;
  }

 private:
  ClosestPoint closest_like(const Vec3& x, const Vec3& n) const {
    return closest_like(x, n, reference_.tree);
  }

  ClosestPoint closest_like(const Vec3& x, const Vec3& n, const AabbTree& tree) const {
    constexpr double min_cosine = -.1;  // a face across a right-angled crease is not turned over
    const double length = n.norm();
    return tree.closest(x, [&](int f) {
      const Vec3 m = area_vector(reference_.points, reference_.adjacency.faces[f]);
      return m.dot(n) >= min_cosine * m.norm() * length;
    });
  }

  /// How far a face that is about as close as the closest one may be.
  double limit_of_like(double closest) const {
    constexpr double as_close = 1.25;
    constexpr double touching = 1e-6;  // of the diagonal
    return as_close * closest + touching * reference_.extent.diagonal;
  }

  /// Does it face the same way as its own shell does where that is closest, or about as close?
  bool faces_like_own_shell(const Face& face, const Vec3& centre, const Vec3& n) const {
    const int shell = result_.shell_of_face(face.id);
    if (shell < 0) return false;
    const AabbTree& tree = reference_.tree_of(shell);
    const ClosestPoint own = tree.closest(centre);
    if (own.face < 0) return false;
    const Vec3 weights = on_face(own, reference_.points, reference_.adjacency).weights;
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      normal += weights[static_cast<Eigen::Index>(k)] * normals_.col(reference_.adjacency.faces[own.face][k]);
    if (n.dot(normal) >= 0) return true;
    const double limit = limit_of_like(std::sqrt(own.squared_distance));
    return closest_like(centre, n, tree).squared_distance <= limit * limit;
  }

  bool is_of_other_shell(const ClosestPoint& like, const ClosestFacePoint& at) const {
    return shell_[reference_.adjacency.faces[like.face][0]] !=
           shell_[corners_in_sheet(reference_, face_at(reference_, at))[0]];
  }

  /// Is a corner of the face on a sheet that faces the same way, and does it not fold back on neighbours?
  bool lies_on_like(const Face& face, const Vec3& n) const {
    const auto is_on_like = [&](const Vec3& x) {
      const double limit = limit_of_like(std::sqrt(reference_.tree.closest(x).squared_distance));
      return closest_like(x, n).squared_distance <= limit * limit;
    };
    return std::ranges::any_of(face.corners, is_on_like) && !folds_anew(result_, face.id, folds_);
  }

  const MeasuredSurface& reference_;
  const MeasuredSurface& result_;
  const Mat3X& normals_;
  const std::vector<int> shell_;  // per vertex of the reference
  const AabbTree folds_;          // of the reference
};

/// Unit vertex normals, weighted by face area, so that a folded sliver does not turn them.
Mat3X vertex_normals(const MeasuredSurface& surface) {
  Mat3X normals = Mat3X::Zero(3, surface.adjacency.vertex_count);
  parallel_for(normals.cols(), deviation_block, [&](size_t begin, size_t end) {
    for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
      Vec3 sum = Vec3::Zero();
      for (int f : surface.adjacency.vertex_faces[v])
        sum += area_vector(surface.points, surface.adjacency.faces[f]);
      normals.col(v) = sum.normalized();
    }
  });
  return normals;
}

/// The reference's vertex normals, interpolated at a point of its surface.
Vec3 normal_at(const MeasuredSurface& reference, const Mat3X& normals, const Face& face,
               const ClosestFacePoint& at) {
  const Triangle& t = corners_in_sheet(reference, face);
  const Vec3 weights = weights_at(face, at);
  return weights[0] * normals.col(t[0]) + weights[1] * normals.col(t[1]) + weights[2] * normals.col(t[2]);
}

/// The coordinate axis, or its opposite, that all faces are turned to, as those of a terrain are to the sky,
/// by less than 60 degrees on average; none if there is none.
std::optional<Vec3> common_side(const MeasuredSurface& surface) {
  constexpr double steepest = .5;  // cosine
  if (surface.adjacency.faces.empty()) return std::nullopt;
  Vec3 least = Vec3::Constant(std::numeric_limits<double>::infinity()), greatest = -least, sum = Vec3::Zero();
  double area = 0;
  for (const Triangle& t : surface.adjacency.faces) {
    const Vec3 n = area_vector(surface.points, t);
    least = least.cwiseMin(n);
    greatest = greatest.cwiseMax(n);
    sum += n;
    area += n.norm();
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(sum[axis]) < steepest * area) continue;
    if (least[axis] > 0) return Vec3::Unit(axis);
    if (greatest[axis] < 0) return -Vec3::Unit(axis);
  }
  return std::nullopt;
}

int count_overhangs(const MeasuredSurface& reference, const MeasuredSurface& result) {
  const std::optional<Vec3> side = common_side(reference);
  if (!side) return 0;
  return static_cast<int>(std::ranges::count_if(result.adjacency.faces, [&](const Triangle& t) {
    return area_vector(result.points, t).dot(*side) < 0;
  }));
}

/// Does a face of the result, with this area vector, oppose the reference where that is closest, and its own
/// shell too if that is another one there?
bool opposes_own_shell(const MeasuredSurface& reference, const MeasuredSurface& result, const Face& face,
                       const Vec3& n, const ClosestFacePoint& at) {
  const int there = face_at(reference, at).id;
  if (!opposes(reference, there, at.point, n)) return false;
  const int shell = result.shell_of_face(face.id);
  if (shell < 0 || shell == reference.shell_of_face(there)) return true;
  const ClosestPoint own = reference.tree_of(shell).closest(middle_of(face));
  return own.face < 0 || opposes(reference, own.face, own.point, n);
}

/// `closest` has one entry per face centre of the result, in the order of its tree.
void find_opposing_faces(const MeasuredSurface& reference, const MeasuredSurface& result,
                         const std::vector<ClosestFacePoint>& closest, Deviation& deviation) {
  const Mat3X normals = vertex_normals(reference);
  const TurnedFaces turned(reference, result, normals);
  std::vector<char> flipped(closest.size(), 0), opposing(closest.size(), 0);
  const std::span<const Face> faces = result.tree.faces();
  parallel_for(faces.size(), deviation_block, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      if (closest[k].face_index < 0) continue;
      const size_t f = faces[k].id;
      const Vec3 n = area_vector(faces[k]);
      const Face& there = face_at(reference, closest[k]);
      flipped[f] = n.dot(normal_at(reference, normals, there, closest[k])) < 0 &&
                   turned.faces_no_like(faces[k], n, closest[k]);
      opposing[f] = flipped[f] || (opposes_own_shell(reference, result, faces[k], n, closest[k]) &&
                                   !turned.lies_on_face_like(faces[k], n));
    }
  });
  for (size_t f = 0; f < opposing.size(); ++f) {
    if (flipped[f]) deviation.flipped_faces.push_back(result.ids.face(static_cast<int>(f)));
    if (opposing[f]) deviation.opposing_faces.push_back(result.ids.face(static_cast<int>(f)));
  }
  std::ranges::sort(deviation.flipped_faces);
  std::ranges::sort(deviation.opposing_faces);
}

double max_distance(const Mat3X& points, const std::vector<Triangle>& segments, const AabbTree& to) {
  constexpr int samples = 8;
  std::vector<double> max_squared(segments.size());
  parallel_for(segments.size(), deviation_block, [&](size_t begin, size_t end) {
    for (size_t s = begin; s < end; ++s)
      for (int k = 0; k < samples; ++k) {
        const double share = static_cast<double>(k) / samples;
        const Vec3 x = (1 - share) * points.col(segments[s][0]) + share * points.col(segments[s][1]);
        max_squared[s] = std::max(max_squared[s], to.closest(x).squared_distance);
      }
  });
  return std::sqrt(*std::max_element(max_squared.begin(), max_squared.end()));
}

std::optional<double> relative_change(std::optional<double> before, std::optional<double> after) {
  if (!before || !after || *before == 0) return std::nullopt;
  return (*after - *before) / *before;
}

}  // namespace

Deviation measure_deviation(const MeasuredSurface& reference, const MeasuredSurface& result,
                            Stopwatch* stopwatch) {
  Deviation d;
  if (reference.points.cols() == result.points.cols())
    d.displacement = std::ranges::equal(reference.ids.vertices, result.ids.vertices)
                         ? measure_displacement(reference.points, result.points)
                         : measure_displacement(points_by_id(reference), points_by_id(result));

  std::vector<ClosestFacePoint> closest;
  timed(stopwatch, "to_reference",
        [&] { d.to_reference = measure_distance(result, reference, d.vertices_to_reference, &closest); });
  timed(stopwatch, "from_reference",
        [&] { d.from_reference = measure_distance(reference, result, d.vertices_from_reference); });
  timed(stopwatch, "normals", [&] {
    d.normal_deviation = measure_normal_deviation(reference, result, closest);
    find_opposing_faces(reference, result, closest, d);
    d.overhangs = count_overhangs(reference, result);
  });
  d.diagonal = reference.extent.diagonal;
  d.area_change = relative_change(reference.extent.area, result.extent.area);
  d.volume_change = relative_change(reference.extent.volume, result.extent.volume);

  const Stage stage(stopwatch, "boundary");
  const auto boundary_of = [](const Adjacency& c) {
    return segments_of(c, [&](int e) { return c.is_boundary_edge(e); });
  };
  const std::vector<Triangle> reference_boundary = boundary_of(reference.adjacency),
                              result_boundary = boundary_of(result.adjacency);
  if (!reference_boundary.empty() && !result_boundary.empty()) {
    d.boundary_to_reference =
        max_distance(result.points, result_boundary, AabbTree(reference.points, reference_boundary));
    d.boundary_from_reference =
        max_distance(reference.points, reference_boundary, AabbTree(result.points, result_boundary));
  }
  return d;
}

Deviation measure_deviation(const Mat3X& reference_points, const Adjacency& reference,
                            const Mat3X& result_points, const Adjacency& result) {
  return measure_deviation(MeasuredSurface(reference_points, reference),
                           MeasuredSurface(result_points, result));
}

}  // namespace hooke
