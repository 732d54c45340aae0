#include "hooke/lloyd.h"

#include <cmath>
#include <numbers>

#include "hooke/parallel.h"

namespace hooke {
namespace {

/// Mass and first moment about the vertex.
struct Moments {
  double mass = 0;
  Vec3 moment = Vec3::Zero();

  /// The triangle (0, a, b) of signed area with densities at its corners, linear between them.
  void add(double area, const Vec3& a, const Vec3& b, double at_0, double at_a, double at_b) {
    const double sum = at_0 + at_a + at_b;
    mass += area * sum / 3;
    moment += area / 12 * ((sum + at_a) * a + (sum + at_b) * b);
  }
};

double density(double length) {
  return 1 / (length * length * length * length);
}

/// An angle by its sine and cosine, both times the same length.
struct CornerAngle {
  double sine = 0, cosine = 1;

  double radians() const { return std::atan2(sine, cosine); }
  double length() const { return sine + std::abs(cosine); }  // about
};

/// The angle across edge k of the face.
CornerAngle angle_across(const Mat3X& points, const Triangle& t, size_t k) {
  const Vec3 p = points.col(t[(k + 2) % 3]);
  const Vec3 u = points.col(t[k]) - p, v = points.col(t[(k + 1) % 3]) - p;
  return {u.cross(v).norm(), u.dot(v)};
}

/// Is the sum of two angles less than pi beyond doubt? Its sine tells without an arctangent.
bool clearly_less_than_pi(const CornerAngle& a, const CornerAngle& b) {
  return a.sine * b.cosine + a.cosine * b.sine > 1e-9 * a.length() * b.length();
}

/// Edges across which Voronoi cells are not made of kites. A crease bounds the cells on either side.
std::vector<char> crooked_edges(const Mat3X& points, const Connectivity& c) {
  constexpr double limit = std::numbers::pi + 1e-9;
  constexpr CornerAngle right_angle{1, 0};
  std::vector<char> crooked(c.edges.size());
  parallel_for(c.edges.size(), 2048, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      std::array<CornerAngle, 2> angles;
      for (size_t side = 0; side < 2; ++side) {
        if (c.edge_faces[e][side] < 0) continue;
        const auto face = static_cast<size_t>(c.edge_faces[e][side]);
        const Triangle& edges = c.face_edges[face];
        const size_t k = edges[0] == static_cast<int>(e) ? 0 : edges[1] == static_cast<int>(e) ? 1 : 2;
        angles[side] = angle_across(points, c.faces[face], k);
      }
      const auto is_crooked = [&](const CornerAngle& a, const CornerAngle& b) {
        return !clearly_less_than_pi(a, b) && a.radians() + b.radians() > limit;
      };
      crooked[e] = c.is_border(static_cast<int>(e))
                       ? is_crooked(angles[0], right_angle) || is_crooked(angles[1], right_angle)
                       : is_crooked(angles[0], angles[1]);
    }
  });
  return crooked;
}

class Lloyd {
 public:
  Lloyd(const Placement& at, const Connectivity& c, const std::vector<double>& length,
        const LloydOptions& options)
      : X_(at.points), c_(c), length_(length), options_(options), crooked_(crooked_edges(X_, c)) {}

  Vec3 step(int v) const {
    if (c_.vertex_faces[v].empty()) return Vec3::Zero();
    const std::array<int, 2> sides = border_neighbours(v);
    if (sides[1] >= 0) return boundary_step(v, sides[0], sides[1]);
    Moments cell = has_straight_cell(v) ? voronoi_cell(v) : Moments{};
    if (!(cell.mass > 0)) cell = faces_about(v);
    if (!(cell.mass > 0)) return Vec3::Zero();
    return options_.over_relaxation / cell.mass * cell.moment;
  }

 private:
  /// -1 for an inner vertex.
  std::array<int, 2> border_neighbours(int v) const {
    std::array<int, 2> sides = {-1, -1};
    const auto edges = c_.vertex_edges[v], neighbours = c_.vertex_neighbours[v];
    size_t count = 0;
    for (size_t i = 0; i < edges.size() && count < 2; ++i)
      if (c_.is_border(edges[i])) sides[count++] = neighbours[i];
    return sides;
  }

  Vec3 boundary_step(int v, int a, int b) const {
    const double to_a = length(v) + length(a), to_b = length(v) + length(b);
    const Vec3 along = X_.col(b) - X_.col(a);
    const double squared = along.squaredNorm();
    if (!(squared > 0)) return Vec3::Zero();
    const double t = (X_.col(v) - X_.col(a)).dot(along) / squared;
    return options_.boundary_relaxation * (to_a / (to_a + to_b) - t) * along;
  }

  bool has_straight_cell(int v) const {
    for (int f : c_.vertex_faces[v])
      for (int e : c_.face_edges[static_cast<size_t>(f)])
        if (crooked_[static_cast<size_t>(e)]) return false;
    return true;
  }

  Moments voronoi_cell(int v) const {
    Moments cell;
    for (int f : c_.vertex_faces[v]) {
      const auto [p, q] = others(f, v);
      const Vec3 a = X_.col(p) - X_.col(v), b = X_.col(q) - X_.col(v);
      const Vec3 n = a.cross(b);
      const double n2 = n.squaredNorm();
      if (!(n2 > 0)) return {};
      const Vec3 o = (b.squaredNorm() * n.cross(a) + a.squaredNorm() * b.cross(n)) / (2 * n2);
      const Vec3 unit = n / std::sqrt(n2);
      const double at_v = density(length(v)), at_o = density((length(v) + length(p) + length(q)) / 3);
      cell.add(.25 * a.cross(o).dot(unit), .5 * a, o, at_v, density(.5 * (length(v) + length(p))), at_o);
      cell.add(.25 * o.cross(b).dot(unit), o, .5 * b, at_v, at_o, density(.5 * (length(v) + length(q))));
    }
    return cell;
  }

  Moments faces_about(int v) const {
    Moments faces;
    for (int f : c_.vertex_faces[v]) {
      const auto [p, q] = others(f, v);
      const Vec3 a = X_.col(p) - X_.col(v), b = X_.col(q) - X_.col(v);
      faces.add(.5 * a.cross(b).norm(), a, b, density(length(v)), density(length(p)), density(length(q)));
    }
    return faces;
  }

  /// The corners of the face that follow v.
  Edge others(int face, int v) const {
    const Triangle& t = c_.faces[static_cast<size_t>(face)];
    const size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
    return {t[(k + 1) % 3], t[(k + 2) % 3]};
  }

  double length(int v) const { return length_[static_cast<size_t>(v)]; }

  const Mat3X& X_;
  const Connectivity& c_;
  const std::vector<double>& length_;
  const LloydOptions& options_;
  std::vector<char> crooked_;
};

}  // namespace

Mat3X lloyd_step(const Placement& placement, const Connectivity& connectivity,
                 const std::vector<double>& vertex_length, const LloydOptions& options) {
  const Lloyd lloyd(placement, connectivity, vertex_length, options);
  Mat3X step(3, placement.points.cols());
  parallel_for(static_cast<size_t>(step.cols()), 512, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      step.col(static_cast<Eigen::Index>(v)) = lloyd.step(static_cast<int>(v));
  });
  return step;
}

}  // namespace hooke
