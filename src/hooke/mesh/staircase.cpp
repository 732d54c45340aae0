#include "hooke/mesh/image_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

constexpr double cell_tolerance = 1e-3, tolerance = 1e-2;  // of the length of a step
constexpr std::size_t min_edges = 100;
constexpr double corner_share = 1. / 3;
constexpr double lattice_share = .99;  // of the edges

/// Vectors up to their sign, at most a given number of them.
class Steps {
 public:
  Steps(std::size_t max, double share_of_length) : max_(max), tolerance_(share_of_length) {}

  /// The index of the step, the maximum if there are as many others.
  std::size_t index_of(const Vec3& step) {
    const double limit = tolerance_ * tolerance_ * step.squaredNorm();
    const auto is_same = [&](const Vec3& other) {
      return (step - other).squaredNorm() <= limit || (step + other).squaredNorm() <= limit;
    };
    const auto found = std::ranges::find_if(steps_, is_same);
    const std::size_t index = found - steps_.begin();
    if (found == steps_.end() && index < max_) steps_.push_back(step);
    return index;
  }

  const std::vector<Vec3>& all() const { return steps_; }

 private:
  std::size_t max_;
  double tolerance_;
  std::vector<Vec3> steps_;
};

Vec3 along(const Mat3X& points, const Edge& e) {
  return points.col(e[1]) - points.col(e[0]);
}

/// Are there many sharp edges, and are a third of the vertices on them corners, at which no two are in line?
/// `steps`: the index of the step of each sharp edge, -1 of the others.
bool has_many_corners(const Adjacency& c, const std::vector<int>& steps) {
  std::size_t sharp = 0, corners = 0;
  for (int v = 0; v < c.vertex_count; ++v) {
    std::vector<int> here;
    for (int e : c.vertex_edges[v])
      if (steps[e] >= 0) here.push_back(steps[e]);
    std::ranges::sort(here);
    sharp += !here.empty();
    corners += !here.empty() && std::ranges::adjacent_find(here) == here.end();
  }
  const auto is_sharp = [](int step) { return step >= 0; };
  return std::ranges::count_if(steps, is_sharp) >= static_cast<std::ptrdiff_t>(min_edges) &&
         static_cast<double>(corners) >= corner_share * static_cast<double>(sharp);
}

/// Are the sharp edges those of cells whose length is not resolved?
bool is_made_of_cells(const Mat3X& points, const Adjacency& c, const std::vector<double>& vertex_length) {
  constexpr double resolved_step = .75;  // target lengths
  constexpr double sharp_angle = 45;
  constexpr std::size_t directions = 3;
  Steps steps(directions, cell_tolerance);
  std::vector<int> of_edges(c.edges.size(), -1);
  for (int e : sharp_edges(points, c, sharp_angle)) {
    const auto& [a, b] = c.edges[e];
    const Vec3 step = along(points, c.edges[e]);
    const std::size_t index = steps.index_of(step);
    if (index == directions || step.norm() > resolved_step * std::min(vertex_length[a], vertex_length[b]))
      return false;
    of_edges[e] = static_cast<int>(index);
  }
  return has_many_corners(c, of_edges);
}

/// The three shortest vectors that are independent, as columns.
std::optional<Eigen::Matrix3d> basis_of(std::vector<Vec3> steps) {
  constexpr double independent = .2;  // sine
  std::ranges::stable_sort(steps, {}, [](const Vec3& step) { return step.squaredNorm(); });
  Eigen::Matrix3d basis;
  int count = 0;
  for (const Vec3& step : steps) {
    const Vec3 unit = step.normalized();
    const double sine = count == 0   ? 1
                        : count == 1 ? unit.cross(basis.col(0).normalized()).norm()
                                     : std::abs(unit.dot(basis.col(0).cross(basis.col(1)).normalized()));
    if (sine < independent) continue;
    basis.col(count++) = step;
    if (count == 3) return basis;
  }
  return std::nullopt;
}

/// Do nearly all edges of each component, `of_edges` along these steps, lead from a point of a lattice to one
/// close by?
bool is_on_lattice(const Adjacency& c, const std::vector<Vec3>& steps, const std::vector<int>& of_edges,
                   const std::vector<std::size_t>& counts) {
  constexpr double min_share = .002;  // of the edges along a step of the lattice, one of the shortest
  constexpr double reach = 3;
  const auto total = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t(0)));
  std::vector<Vec3> frequent;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (static_cast<double>(counts[i]) >= min_share * total) frequent.push_back(steps[i]);
  const std::optional<Eigen::Matrix3d> basis = basis_of(std::move(frequent));
  if (!basis) return false;
  const Eigen::Matrix3d inverse = basis->inverse();
  std::vector<char> is_short(counts.size(), 0);  // the last one stands for all other steps
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Vec3 multiples = inverse * steps[i];
    const Vec3 off = multiples - multiples.array().round().matrix();
    is_short[i] =
        multiples.cwiseAbs().maxCoeff() <= reach + tolerance && off.cwiseAbs().maxCoeff() <= 3 * tolerance;
  }
  const std::vector<int> components = label_components(c);
  std::vector<std::array<std::size_t, 2>> edges(c.vertex_count,
                                                {0, 0});  // per component: all, and short ones
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    auto& [all, on_lattice] = edges[components[c.edges[e][0]]];
    ++all;
    on_lattice += is_short[of_edges[e]];
  }
  return std::ranges::all_of(edges, [](const auto& count) {
    return static_cast<double>(count[1]) >= lattice_share * static_cast<double>(count[0]);
  });
}

/// Do the faces look all ways, as around a body, and not up, as those of a height field?
bool looks_all_ways(const Mat3X& points, const Adjacency& c) {
  constexpr double max_share = .5;  // of the area, in the mean of its vectors
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const Triangle& t : c.faces) {
    const Vec3 n = doubled_area_vector(points, t);
    sum += n;
    area += n.norm();
  }
  return sum.norm() < max_share * area;
}

}  // namespace

bool is_marched_mask(const Mat3X& points, const Adjacency& c, const std::vector<double>& vertex_length) {
  constexpr std::size_t max_steps = 64, max_orientations_of_blocks = 8;
  constexpr double resolved_step = 1.5;  // target lengths
  constexpr double sharp_angle = 40;
  Steps steps(max_steps, tolerance), orientations(max_orientations_of_blocks, tolerance);
  std::vector<int> of_edges(c.edges.size(), -1);
  std::vector<std::size_t> counts(max_steps + 1, 0);
  double length = 0, target = 0;
  const double max_others = (1 - lattice_share) * static_cast<double>(c.edges.size());
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    const auto& [a, b] = c.edges[e];
    const Vec3 step = along(points, c.edges[e]);
    const std::size_t index = steps.index_of(step);
    of_edges[e] = static_cast<int>(index);
    ++counts[index];
    length += step.norm();
    target += .5 * (vertex_length[a] + vertex_length[b]);
    if (static_cast<double>(counts[max_steps]) > max_others) return false;
  }
  if (length > resolved_step * target) return false;
  const Mat3X normals = certain_face_normals(points, c);
  bool has_many_orientations = false;
  for (Eigen::Index f = 0; f < normals.cols() && !has_many_orientations; ++f)
    has_many_orientations =
        !normals.col(f).isZero(0) && orientations.index_of(normals.col(f)) == max_orientations_of_blocks;
  if (!has_many_orientations) return false;
  std::vector<int> of_sharp_edges(c.edges.size(), -1);
  for (int e : sharp_edges(points, c, sharp_angle)) of_sharp_edges[e] = of_edges[e];
  return is_on_lattice(c, steps.all(), of_edges, counts) && looks_all_ways(points, c) &&
         has_many_corners(c, of_sharp_edges);
}

bool is_staircase(const Mat3X& points, const Adjacency& c, const std::vector<double>& vertex_length) {
  return is_made_of_cells(points, c, vertex_length) || is_marched_mask(points, c, vertex_length);
}

namespace {

/// Six times the volume below the faces of each component, seen from the first of its vertices.
std::vector<double> volumes(const Mat3X& points, const Adjacency& c, const std::vector<int>& components) {
  std::vector<double> sums(c.vertex_count, 0);
  std::vector<int> origins(c.vertex_count, -1);
  for (const Triangle& t : c.faces) {
    int& origin = origins[components[t[0]]];
    if (origin < 0) origin = t[0];
    const Vec3 x = points.col(origin);
    sums[components[t[0]]] += (points.col(t[0]) - x).dot((points.col(t[1]) - x).cross(points.col(t[2]) - x));
  }
  return sums;
}

}  // namespace

Mat3X without_steps(Mat3X points, const Adjacency& c, const std::vector<char>& is_held) {
  constexpr double max_loss = .05;  // of the volume
  const Mat3X input = points;
  constexpr int rounds = 3;
  constexpr double shrinking = .5, growing = -.53;
  for (int round = 0; round < rounds; ++round)
    for (const double factor : {shrinking, growing}) {
      const Mat3X before = points;
      for (int v = 0; v < c.vertex_count; ++v) {
        const auto neighbours = c.vertex_neighbours[v];
        if (is_held[v] || neighbours.empty()) continue;
        Vec3 sum = Vec3::Zero();
        for (int n : neighbours) sum += before.col(n);
        points.col(v) += factor * (sum / static_cast<double>(neighbours.size()) - before.col(v));
      }
    }
  const std::vector<int> components = label_components(c);
  const std::vector<double> before = volumes(input, c, components), after = volumes(points, c, components);
  for (int v = 0; v < c.vertex_count; ++v) {
    const int i = components[v];
    if (std::abs(after[i] - before[i]) > max_loss * std::abs(before[i])) points.col(v) = input.col(v);
  }
  return points;
}

}  // namespace hooke
