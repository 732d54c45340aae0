#include "hooke/io/carried_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "hooke/constraints/seams.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/wedges.h"
#include "support/remeshed.h"

namespace hooke::carried_data_test {
namespace {

/// A mesh with data at its faces and corners.
struct Textured {
  test::Triangles mesh;
  CornerData corners;
  FaceData faces;
};

/// A grid bent to an open tube, cut along x = 0: its texture is the grid's, its material changes at two
/// heights. Inner points are moved.
Textured tube(int n) {
  const test::Triangles grid = test::grid(n, test::flat, .25);
  const auto merged = [&](int v) {
    return grid.points(0, v) == 1 ? v - n : v;
  };  // the last of a row of n + 1
  Textured t;
  std::vector<int> id(static_cast<size_t>(grid.points.cols()), -1);
  std::vector<Vec3> points;
  for (int v = 0; v < grid.points.cols(); ++v) {
    if (merged(v) != v) continue;
    const double angle = 2 * std::numbers::pi * grid.points(0, v);
    id[static_cast<size_t>(v)] = static_cast<int>(points.size());
    points.emplace_back(std::cos(angle), std::sin(angle), 6 * grid.points(1, v));
  }
  t.mesh.points.resize(3, std::ssize(points));
  for (size_t v = 0; v < points.size(); ++v) t.mesh.points.col(static_cast<Eigen::Index>(v)) = points[v];
  t.corners.texture = {grid.points, 2, grid.faces};
  FaceChannel material{material_channel, {}, {{1, "low"}, {2, "middle"}, {3, "high"}}};
  for (const Triangle& face : grid.faces) {
    Triangle& corners = t.mesh.faces.emplace_back();
    double y = 0;
    for (size_t k = 0; k < 3; ++k) {
      corners[k] = id[static_cast<size_t>(merged(face[k]))];
      y += grid.points(1, face[k]) / 3;
    }
    material.values.push_back(y < .25 ? 1 : y < .5 ? 2 : 3);
  }
  t.faces.push_back(material);
  return t;
}

Seams seams_of(const Textured& t) {
  return find_seams(find_memory_order(test::to_mesh(t.mesh)), t.corners, t.faces);
}

Textured remeshed(const Textured& t, ConnectivityMode mode, double length) {
  RemeshOptions options;
  options.connectivity = mode;
  set_effort(options, Effort::fast);
  options.constraints.seams = seams_of(t).ends;
  TriMesh mesh = test::with_length(t.mesh, length * test::natural(t.mesh));
  const MemoryOrder before = find_memory_order(mesh);
  const RemeshResult result = remesh(mesh, options);
  Adjacency input = *before.adjacency, output = *result.memory_order.adjacency;
  split_wedges(input, before.order.new_edges(result.input_creases));
  split_wedges(output, result.memory_order.order.new_edges(result.crease_edges));
  const Mat3X from = before.order.gather(t.mesh.points),
              to = result.memory_order.order.gather(vertex_points(mesh));
  const Remeshed meshes{{from, input}, before, {to, output}, result.memory_order.order};
  const ChartPlaces places = find_chart_places(meshes.input, meshes.result);
  return {{vertex_points(mesh), triangles_of(mesh)},
          carry_corner_data(t.corners, places, meshes),
          carry_face_data(t.faces, places, meshes)};
}

double length_of(const Textured& t, const Seams& seams) {
  double sum = 0;
  for (const auto& [a, b] : seams.ends) sum += (t.mesh.points.col(a) - t.mesh.points.col(b)).norm();
  return sum;
}

std::map<int, double> area_of_materials(const Textured& t) {
  std::map<int, double> areas;
  for (size_t f = 0; f < t.mesh.faces.size(); ++f)
    areas[t.faces[0].values[f]] += .5 * doubled_area_vector(t.mesh.points, t.mesh.faces[f]).norm();
  return areas;
}

/// The material on both sides of its borders.
std::set<std::pair<int, int>> pairs_of(const Textured& t) {
  std::set<std::pair<int, int>> pairs;
  const MemoryOrder order = find_memory_order(test::to_mesh(t.mesh));
  for (const auto& [left, right] : order.adjacency->edge_faces) {
    if (right < 0) continue;
    const auto material = [&](int f) {
      return t.faces[0].values[static_cast<size_t>(order.order.old_face[static_cast<size_t>(f)])];
    };
    if (material(left) != material(right)) pairs.insert(std::minmax({material(left), material(right)}));
  }
  return pairs;
}

struct Run {
  ConnectivityMode mode;
  double length;
};
class EveryRun : public testing::TestWithParam<Run> {
 protected:
  const Textured before = tube(24);
  const Textured after = remeshed(before, GetParam().mode, GetParam().length);
};

TEST_P(EveryRun, SeamsKeepTheirLengthAndMaterialsTheirAreaAndNeighbours) {
  EXPECT_NE(after.mesh.faces, before.mesh.faces);
  const Seams seams = seams_of(after), old = seams_of(before);
  EXPECT_NEAR(length_of(after, seams), length_of(before, old), .03 * length_of(before, old));
  for (const auto& [material, area] : area_of_materials(before))
    EXPECT_NEAR(area_of_materials(after).at(material), area, .03 * area) << material;
  EXPECT_EQ(pairs_of(after), pairs_of(before));
  EXPECT_EQ(after.faces[0].names, before.faces[0].names);
}

TEST_P(EveryRun, TheTextureCoversItsMapOnceWithNoFaceTurnedOver) {
  double area = 0;
  for (const Triangle& corners : after.corners.texture.corners) {
    const double doubled = doubled_area_vector(after.corners.texture.values, corners)[2];
    EXPECT_GT(doubled, 0);
    area += .5 * doubled;
  }
  EXPECT_NEAR(area, 1, 1e-9) << "its border is straight, and its corners stand still";
}

TEST_P(EveryRun, TheTextureIsThatOfThePlace) {
  for (size_t f = 0; f < after.mesh.faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 x = after.mesh.points.col(after.mesh.faces[f][k]);
      const Vec3 uv = after.corners.texture.values.col(after.corners.texture.corners[f][k]);
      EXPECT_NEAR(uv[1], x[2] / 6, 1e-3);
      const double turn = std::atan2(x[1], x[0]) / (2 * std::numbers::pi);
      EXPECT_NEAR(uv[0] - turn, std::round(uv[0] - turn), 4e-3);
    }
}

TEST_P(EveryRun, VerticesThatStayKeepTheirValues) {
  std::map<std::array<double, 3>, std::set<std::pair<double, double>>> old;
  const auto key = [](const auto& x) { return std::array{x[0], x[1], x[2]}; };
  const auto for_corners = [](const Textured& t, const auto& use) {
    for (size_t f = 0; f < t.mesh.faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k)
        use(t.mesh.points.col(t.mesh.faces[f][k]),
            t.corners.texture.values.col(t.corners.texture.corners[f][k]));
  };
  for_corners(before, [&](const auto& x, const auto& uv) { old[key(x)].insert({uv[0], uv[1]}); });
  int stayed = 0;
  for_corners(after, [&](const auto& x, const auto& uv) {
    const auto found = old.find(key(x));
    if (found == old.end()) return;
    ++stayed;
    EXPECT_EQ(found->second.count({uv[0], uv[1]}), 1u) << x.transpose() << " has " << uv.transpose();
  });
  EXPECT_GT(stayed, 0);
}

INSTANTIATE_TEST_SUITE_P(CarriedData, EveryRun,
                         testing::Values(Run{ConnectivityMode::flip, 1}, Run{ConnectivityMode::adapt, 1},
                                         Run{ConnectivityMode::adapt, .7}, Run{ConnectivityMode::adapt, 2}));

TEST(CarriedData, ASeamDoesNotChangeTheSurface) {
  // On a sphere far from its seam vertices are as near to the true surface as without one.
  const test::Triangles ball = test::sphere(3, .3);
  const auto error = [&](bool with_seam) {
    RemeshOptions options;
    options.connectivity = ConnectivityMode::adapt;
    set_effort(options, Effort::fast);
    const Adjacency c = make_adjacency(static_cast<int>(ball.points.cols()), ball.faces);
    for (size_t e = 0; with_seam && e < c.edges.size(); ++e) {
      const auto side = [&](int f) {
        const Triangle& t = c.faces[static_cast<size_t>(f)];
        return ball.points(0, t[0]) + ball.points(0, t[1]) + ball.points(0, t[2]) > 0;
      };
      if (side(c.edge_faces[e][0]) != side(c.edge_faces[e][1]))
        options.constraints.seams.push_back(c.edges[e]);
    }
    EXPECT_NE(options.constraints.seams.empty(), with_seam);
    const test::Outcome done = test::remeshed(ball, test::natural(ball), options);
    double worst = 0;
    for (const auto x : done.points.colwise())
      if (std::abs(x[0]) > .15) worst = std::max(worst, std::abs(x.norm() - 1));
    return worst;
  };
  EXPECT_LT(error(true), 1.5 * error(false));
}

TEST(CarriedData, NormalsOfABoxStayHardAtItsEdgesAndSmoothElsewhere) {
  const test::Triangles sheet = test::grid(8, [](double x, double) { return std::abs(x - .5); });
  CornerValues normals{Mat3X(3, 2), 3, {}};
  normals.values << -std::sqrt(.5), std::sqrt(.5), 0, 0, std::sqrt(.5), std::sqrt(.5);
  for (const Triangle& t : sheet.faces) {
    const int side = sheet.points(0, t[0]) + sheet.points(0, t[1]) + sheet.points(0, t[2]) > 1.5;
    normals.corners.push_back({1 - side, 1 - side, 1 - side});
  }
  const MemoryOrder order = find_memory_order(test::to_mesh(sheet));
  Adjacency c = *order.adjacency;
  std::vector<Edge> fold;
  for (const Edge& e : c.edges) {
    const auto on_fold = [&](int v) {
      return sheet.points(0, order.order.old_vertex[static_cast<size_t>(v)]) == .5;
    };
    if (on_fold(e[0]) && on_fold(e[1])) fold.push_back(e);
  }
  split_wedges(c, fold);
  const Mat3X points = order.order.gather(sheet.points);
  const Remeshed same{{points, c}, order, {points, c}, order.order};
  const CornerValues carried =
      carry_corner_data({{}, normals}, find_chart_places(same.input, same.result), same).normals;
  for (size_t f = 0; f < sheet.faces.size(); ++f) {
    const Vec3 face = doubled_area_vector(sheet.points, sheet.faces[f]).normalized();
    for (const int n : carried.corners[f]) EXPECT_NEAR((carried.values.col(n) - face).norm(), 0, 1e-12);
  }
}

}  // namespace
}  // namespace hooke::carried_data_test
