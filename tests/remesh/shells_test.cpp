#include "hooke/remesh/shells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hooke/mesh/junctions.h"
#include "hooke/remesh/result.h"
#include "support/crease_solids.h"
#include "support/junction_sheets.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::shells_test {

/// A cube of 12 faces, a ball, and a sheet with a boundary.
test::Triangles assembly() {
  test::Triangles ball = test::sphere(2, .2, 1), sheet = test::grid(6, test::paraboloid, .2);
  ball.points.colwise() += Vec3(4, 0, 0);
  sheet.points.colwise() += Vec3(0, 4, 0);
  return test::both(test::both(test::cube(), ball), sheet);
}

TEST(Shells, AreConnectedOverEdgesAndJunctions) {
  const test::Triangles t = test::both(test::cube(), test::tetrahedron());
  const auto n = static_cast<int>(test::cube().points.cols()), m = static_cast<int>(t.points.cols());
  const Adjacency c = test::connect(t);
  std::vector<int> apart(m, 0), joined;
  std::fill(apart.begin() + n, apart.end(), 1);
  EXPECT_EQ(label_shells(c, {}), apart);
  for (int v = 0; v < m; ++v) joined.push_back(v == n ? 0 : v);
  EXPECT_EQ(label_shells(c, joined), std::vector<int>(m, 0));
  const std::vector<int> first_is_loose = label_shells(make_adjacency(4, {{1, 2, 3}}), {});
  EXPECT_EQ(first_is_loose, (std::vector<int>{-1, 0, 0, 0}));
}

TEST(Shells, PartsHaveWhatTheWholeSaysOfThem) {
  const test::Triangles t = assembly();
  const TriMesh whole = test::with_length(t, .4);
  const std::vector<int> numbers = label_shells(test::connect(t), {});
  std::vector<int> part_of_vertex;
  for (int n : numbers) part_of_vertex.push_back(n - 1);  // not the cube
  const std::vector<PartOfMesh> parts = parts_of_mesh(whole, {}, part_of_vertex);
  ASSERT_EQ(parts.size(), 2u);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const PartOfMesh& part = parts[p];
    EXPECT_EQ(std::ssize(part.vertices), std::ranges::count(part_of_vertex, static_cast<int>(p)));
    EXPECT_EQ(Mat3X(vertex_points(part.mesh)), Mat3X(t.points(Eigen::all, part.vertices)));
    EXPECT_EQ(vertex_values(part.mesh, target_length_property),
              std::vector<double>(part.vertices.size(), .4));
    const std::vector<Triangle> triangles = triangles_of(part.mesh);
    ASSERT_EQ(triangles.size(), part.faces.size());
    for (std::size_t f = 0; f < triangles.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(part.vertices[triangles[f][k]], t.faces[part.faces[f]][k]);
  }
  const PartOfMesh& ball = parts[0];
  const int first = ball.vertices.front(), second = ball.vertices[1];
  ConstraintOptions all;
  all.fixed_vertices = {0, first};
  all.frozen_vertices = {second, 1};
  all.seams = {{0, 1}, {first, second}};
  const ConstraintOptions of_ball = parts_of_mesh(whole, all, part_of_vertex)[0].constraints;
  EXPECT_EQ(of_ball.fixed_vertices, std::vector<int>{0});
  EXPECT_EQ(of_ball.frozen_vertices, std::vector<int>{1});
  EXPECT_EQ(of_ball.seams, (std::vector<Edge>{{0, 1}}));
}

struct Adapted {
  TriMesh input, mesh;
  RemeshResult result;
};

Adapted adapted(const TriMesh& input) {
  Adapted a{input, input, {}};
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  options.effort = Effort::fast;
  options.map = true;
  a.result = remesh(a.mesh, options);
  return a;
}

/// The corners of the faces, each from its least one, sorted.
std::vector<std::array<std::array<double, 3>, 3>> corners(const TriMesh& mesh) {
  std::vector<std::array<std::array<double, 3>, 3>> all;
  for (const Triangle& t : triangles_of(mesh)) {
    auto& face = all.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      for (Eigen::Index i = 0; i < 3; ++i) face[k][i] = vertex_points(mesh)(i, t[k]);
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  }
  std::ranges::sort(all);
  return all;
}

TEST(Shells, TheirResultsMakeTheWholeOneAgain) {
  const test::Triangles t = assembly();
  const Adapted whole = adapted(test::with_length(t, .4));
  const std::vector<PartOfMesh> parts = parts_of_mesh(whole.input, {}, label_shells(test::connect(t), {}));
  const std::vector<PartOfResult> results = parts_of_result(parts, whole.mesh, whole.result);
  for (const std::vector<int>& chosen : {std::vector<int>{1}, {0, 2}, {0, 1, 2}}) {
    TriMesh mesh = whole.mesh;
    RemeshResult result = whole.result;
    std::vector<PartOfMesh> some;
    std::vector<RemeshedMesh> of_some;
    for (int p : chosen) {
      some.push_back(parts[p]);
      of_some.push_back({results[p].mesh, results[p].result});
    }
    replace_parts(some, of_some, mesh, result);
    EXPECT_EQ(corners(mesh), corners(whole.mesh));
    EXPECT_EQ(result.creases.edges, whole.result.creases.edges);
    EXPECT_EQ(result.creases.curves, whole.result.creases.curves);
    EXPECT_EQ(result.creases.corners, whole.result.creases.corners);
    EXPECT_EQ(result.creases.curve_vertices, whole.result.creases.curve_vertices);
    EXPECT_EQ(result.creases.charts, whole.result.creases.charts);
    EXPECT_EQ(result.creases.sharp, whole.result.creases.sharp);
    EXPECT_EQ(std::multiset<Edge>(result.input_creases.begin(), result.input_creases.end()),
              std::multiset<Edge>(whole.result.input_creases.begin(), whole.result.input_creases.end()));
    ASSERT_EQ(result.map.size(), mesh.n_vertices());
    int last = -1;
    bool has_new = false;
    for (std::size_t v = 0; v < result.map.size(); ++v) {
      const auto& [origin, position] = result.map[v];
      if (origin < 0) has_new = true;
      if (origin >= 0) {  // those of the input come first, in their order
        EXPECT_FALSE(has_new);
        EXPECT_GT(origin, last);
        last = origin;
      }
      Vec3 x = Vec3::Zero();
      for (std::size_t k = 0; k < 3; ++k)
        x += position.weights[static_cast<Eigen::Index>(k)] * t.points.col(t.faces[position.face][k]);
      EXPECT_LT((x - vertex_points(mesh).col(static_cast<Eigen::Index>(v))).norm(), .1);
    }
  }
}

TEST(Shells, JunctionsStayJoined) {
  const test::Triangles t = test::both(test::cube(), test::cube());
  std::vector<int> joined;
  for (int v = 0; v < t.points.cols(); ++v) joined.push_back(v % 8);  // all vertices are copies
  TriMesh input = test::with_length(t, .4);
  set_joined_vertices(input, joined);
  const std::vector<PartOfMesh> parts = parts_of_mesh(input, {}, std::vector<int>(t.points.cols(), 0));
  EXPECT_EQ(joined_vertices(parts[0].mesh), joined);
}

}  // namespace hooke::shells_test
