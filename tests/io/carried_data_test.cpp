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
#include "support/solids.h"

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
  std::vector<int> id(grid.points.cols(), -1);
  std::vector<Vec3> points;
  for (int v = 0; v < grid.points.cols(); ++v) {
    if (merged(v) != v) continue;
    const double angle = 2 * std::numbers::pi * grid.points(0, v);
    id[v] = static_cast<int>(points.size());
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
      corners[k] = id[merged(face[k])];
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
  options.effort = Effort::fast;
  const Seams seams = seams_of(t);
  options.constraints.seams = seams.ends;
  options.constraints.fixed_vertices = seams.poles;
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
    const auto material = [&](int f) { return t.faces[0].values[order.order.old_face[f]]; };
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
    options.effort = Effort::fast;
    const Adjacency c = make_adjacency(static_cast<int>(ball.points.cols()), ball.faces);
    for (size_t e = 0; with_seam && e < c.edges.size(); ++e) {
      const auto side = [&](int f) {
        const Triangle& t = c.faces[f];
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

/// A globe whose texture is (longitude, latitude), with a value of its own in each face at a pole.
Textured textured_globe(int meridians, int bands) {
  Textured t{test::globe(meridians, bands), {}, {}};
  const auto longitude = [&](int v) {
    const double turn = std::atan2(t.mesh.points(1, v), t.mesh.points(0, v)) / (2 * std::numbers::pi);
    return turn < -1e-9 ? turn + 1 : turn;
  };
  const auto is_pole = [&](int v) { return std::abs(t.mesh.points(2, v)) == 1; };
  std::vector<Vec3> values;
  for (const Triangle& face : t.mesh.faces) {
    Triangle& corners = t.corners.texture.corners.emplace_back();
    std::array<double, 3> u;
    double sum = 0, greatest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (!is_pole(face[k])) greatest = std::max(greatest, longitude(face[k]));
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = is_pole(face[k]) ? 0 : longitude(face[k]) + (greatest - longitude(face[k]) > .5 ? 1 : 0);
      sum += u[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = static_cast<int>(values.size());
      values.emplace_back(is_pole(face[k]) ? sum / 2 : u[k],
                          1 - std::acos(t.mesh.points(2, face[k])) / std::numbers::pi, 0);
    }
  }
  t.corners.texture.width = 2;
  t.corners.texture.values.resize(3, std::ssize(values));
  for (std::size_t i = 0; i < values.size(); ++i)
    t.corners.texture.values.col(static_cast<Eigen::Index>(i)) = values[i];
  return t;
}

TEST(CarriedData, EachFaceAtAPoleHasAValueOfItsOwn) {
  const Textured before = textured_globe(24, 12);
  ASSERT_EQ(seams_of(before).poles.size(), 2u);
  const Textured after = remeshed(before, ConnectivityMode::adapt, 1);
  EXPECT_NE(after.mesh.faces, before.mesh.faces);
  std::set<int> at_poles;
  int corners_at_poles = 0;
  for (std::size_t f = 0; f < after.mesh.faces.size(); ++f) {
    const Triangle& corners = after.corners.texture.corners[f];
    EXPECT_GT(doubled_area_vector(after.corners.texture.values, corners)[2], 0) << f;
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(after.mesh.points(2, after.mesh.faces[f][k])) < 1) continue;
      ++corners_at_poles;
      at_poles.insert(corners[k]);
    }
  }
  EXPECT_GE(corners_at_poles, 8);
  EXPECT_EQ(std::ssize(at_poles), corners_at_poles);
}

TEST(CarriedData, WhereAllEdgesAreHardTheyStayHard) {
  Textured before{test::torus(24, 10, .2), {}, {}};
  const auto normal_of = [](const Textured& t, std::size_t f) -> Vec3 {
    return doubled_area_vector(t.mesh.points, t.mesh.faces[f]).normalized();
  };
  CornerValues& normals = before.corners.normals;
  normals.values.resize(3, std::ssize(before.mesh.faces));
  for (std::size_t f = 0; f < before.mesh.faces.size(); ++f) {
    const int id = static_cast<int>(f);
    normals.values.col(id) = normal_of(before, f);
    normals.corners.push_back({id, id, id});
  }
  const Textured after = remeshed(before, ConnectivityMode::adapt, 1);
  EXPECT_NE(after.mesh.faces, before.mesh.faces);
  for (std::size_t f = 0; f < after.mesh.faces.size(); ++f)
    for (const int n : after.corners.normals.corners[f])
      EXPECT_NEAR((after.corners.normals.values.col(n) - normal_of(after, f)).norm(), 0, 1e-9) << f;
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
    const auto on_fold = [&](int v) { return sheet.points(0, order.order.old_vertex[v]) == .5; };
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
