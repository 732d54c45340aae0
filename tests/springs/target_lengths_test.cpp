#include "hooke/springs/target_lengths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "hooke/core/error.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/springs/sizing.h"
#include "support/solids.h"

namespace hooke::target_lengths_test {

double natural_length_of(const test::Triangles& t) {
  return natural_length(total_area(t.points, t.faces), t.faces.size());
}

TEST(Sizing, AreasAreThoseOfGeometry) {
  const test::Triangles cube = test::cube();
  EXPECT_NEAR(total_area(cube.points, cube.faces), 6, 1e-14);
  const test::Triangles grid = test::grid(7, test::flat, .3);
  EXPECT_NEAR(total_area(grid.points, grid.faces), 1, 1e-13);
  const test::Triangles turned = test::moved(cube, 3);
  EXPECT_NEAR(total_area(turned.points, turned.faces), 54, 1e-12);
}

TEST(Sizing, EquilateralTrianglesHaveTheirEdgeAsNaturalLength) {
  EXPECT_NEAR(natural_length_of(test::equilateral()), 1, 1e-15);
  EXPECT_NEAR(natural_length_of(test::tetrahedron()), std::sqrt(8), 1e-14);
}

TEST(Sizing, AnEdgeIsTheMeanOfItsEndsAndAFaceOfItsEdges) {
  const Adjacency c = make_adjacency(3, {{0, 1, 2}});
  const TargetLengths targets = spread_target_lengths(c, {1, 2, 6});
  const std::vector<double> expected = {1.5, 4, 3.5};
  EXPECT_EQ(targets.edge.values(), expected);
  EXPECT_DOUBLE_EQ(targets.face[0], 3);
}

TEST(Sizing, TargetsOfAFaceAlwaysFormATriangle) {
  const Adjacency c = test::connect(test::sphere(2));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-6, 6);
  std::vector<double> length(c.vertex_count);
  for (double& l : length) l = std::pow(10, exponent(random));
  const TargetLengths targets = spread_target_lengths(c, length);
  for (const auto& edges : c.face_edges)
    for (size_t k = 0; k < 3; ++k) {
      const auto side = [&](size_t i) { return targets.edge[edges[(k + i) % 3]]; };
      EXPECT_LE(side(0), (side(1) + side(2)) * (1 + 1e-15));
    }
}

TEST(EdgeTargets, AreThoseOfTheEdgesWhereTheMeshHasThem) {
  const test::Triangles t = test::sphere(1);
  TriMesh mesh = test::to_mesh(t);
  const MemoryOrder memory_order = find_memory_order(mesh);
  const Adjacency& c = *memory_order.adjacency;
  EXPECT_THROW(target_lengths_of(mesh, memory_order.order, c), Error);
  set_vertex_values(mesh, target_length_property, .5);
  const UniformVector of_vertices = target_lengths_of(mesh, memory_order.order, c).edge;
  EXPECT_FALSE(of_vertices.is_varying());
  EXPECT_EQ(of_vertices[0], .5);
  std::vector<double> lengths(c.edges.size());
  for (size_t e = 0; e < lengths.size(); ++e) lengths[e] = 1 + .01 * static_cast<double>(e);
  set_edge_values(mesh, edge_length_property, memory_order.order, c, lengths);
  const TargetLengths targets = target_lengths_of(mesh, memory_order.order, c);
  EXPECT_EQ(targets.edge.values(), lengths);
  for (size_t f = 0; f < c.faces.size(); ++f) {
    double sum = 0;
    for (int e : c.face_edges[f]) sum += lengths[e];
    EXPECT_DOUBLE_EQ(targets.face[f], sum / 3);
  }
  const Adjacency in_file_order = make_adjacency(static_cast<int>(mesh.n_vertices()), t.faces);
  const std::vector<double> again = edge_values(mesh, edge_length_property, {}, in_file_order);
  EXPECT_EQ(std::multiset<double>(again.begin(), again.end()),
            std::multiset<double>(lengths.begin(), lengths.end()));
}

TEST(LengthSpec, MeansWhatItSays) {
  const test::Triangles cube = test::cube();
  const Adjacency c = test::connect(cube);
  const auto length = [&](const char* text) { return resolve_length(parse_length(text), cube.points, c); };
  EXPECT_DOUBLE_EQ(length("auto"), natural_length(6, 12));
  EXPECT_DOUBLE_EQ(length("2x"), 2 * natural_length(6, 12));
  EXPECT_DOUBLE_EQ(length("10%"), .1 * std::sqrt(3));
  EXPECT_DOUBLE_EQ(length("1.5e-1"), .15);
  EXPECT_DOUBLE_EQ(length("mean"), (12 + 6 * std::sqrt(2)) / 18);
}

TEST(LengthSpec, RefusesWhatIsNoLength) {
  for (const char* text :
       {"", "%", "x", "0", "-1", "nan", "inf", "1e999", "2 x", "2xx", "2%x", "two", "Auto"})
    EXPECT_THROW(parse_length(text), Error) << text;
}

/// A fine ball and a coarse one eight times as large.
test::Triangles two_balls() {
  test::Triangles coarse = test::sphere(1);
  coarse.points *= 8;
  coarse.points.row(0).array() += 20;
  return test::both(test::sphere(2), coarse);
}

TEST(LengthSpec, NaturalLengthsAreThoseOfTheParts) {
  const test::Triangles t = two_balls(), fine = test::sphere(2), coarse = test::sphere(1);
  const Adjacency c = test::connect(t);
  const double of_fine = natural_length_of(fine), of_coarse = 8 * natural_length_of(coarse),
               of_both = natural_length_of(t);
  ASSERT_LT(of_both, of_coarse);
  for (const double times : {1., .5, 3.}) {
    LengthSpec spec = parse_length(times == 1 ? "auto" : fmt::format("{}x", times));
    const auto expect_lengths = [&](double first, double last, const std::vector<int>& joined = {}) {
      const std::vector<double> lengths = resolve_vertex_lengths(spec, {}, t.points, c, joined);
      EXPECT_NEAR(lengths.front(), times * first, 1e-12);
      EXPECT_NEAR(lengths.back(), times * last, 1e-12);
    };
    expect_lengths(of_fine, of_coarse);
    std::vector<int> joined(c.vertex_count);
    std::iota(joined.begin(), joined.end(), 0);
    joined.back() = 0;  // they touch there: one part
    expect_lengths(of_both, of_both, joined);
    spec.whose = LengthSpec::Natural::shorter;
    expect_lengths(of_fine, of_both);
  }
  for (const char* length : {"mean", "3", "1%"})
    EXPECT_TRUE(UniformVector::are_equal(resolve_vertex_lengths(parse_length(length), {}, t.points, c)));
}

TEST(LengthSpec, PartsThatAreAlikeHaveOneLength) {
  test::Triangles other = test::sphere(2, .1);
  other.points.row(0).array() += 20;
  const test::Triangles t = test::both(test::sphere(2), other);
  EXPECT_TRUE(UniformVector::are_equal(resolve_vertex_lengths({}, {}, t.points, test::connect(t))));
}

TEST(LengthSpec, APartWithoutAreaHasTheLengthOfItsEdges) {
  const auto length_beside_ball = [](const Mat3X& corners) {
    const test::Triangles t = test::both(test::sphere(2), {corners, {{0, 1, 2}}});
    return resolve_vertex_lengths({}, {}, t.points, test::connect(t)).back();
  };
  Mat3X line = Mat3X::Zero(3, 3);
  line.row(0) << 5, 6, 7;
  EXPECT_NEAR(length_beside_ball(line), .5 * 4 / 3, 1e-12);
  EXPECT_NEAR(length_beside_ball(Mat3X::Constant(3, 3, 7)), 1e-3 * natural_length_of(test::sphere(2)), 1e-5);
}

TEST(LengthSpec, PiecesOfASurfaceThatWasCutOpenAreOnePart) {
  test::Triangles left = test::grid(6, test::flat), right = test::grid(3, test::flat);
  right.points.row(0).array() += 1;  // every other vertex of the left one is there too
  const test::Triangles t = test::both(left, right);
  EXPECT_TRUE(UniformVector::are_equal(resolve_vertex_lengths({}, {}, t.points, test::connect(t))));
  right.points.row(0).array() += 1;
  const test::Triangles apart = test::both(left, right);
  EXPECT_FALSE(UniformVector::are_equal(resolve_vertex_lengths({}, {}, apart.points, test::connect(apart))));
}

TEST(TargetLengths, AreEvenIfNoFaceHasTwo) {
  const test::Triangles t = two_balls();
  const Adjacency c = test::connect(t);
  std::vector<double> lengths(c.vertex_count, 1);
  EXPECT_TRUE(are_even(c, spread_target_lengths(c, lengths)));
  for (size_t v = test::sphere(2).points.cols(); v < lengths.size(); ++v) lengths[v] = 2;
  EXPECT_TRUE(are_even(c, spread_target_lengths(c, lengths)));
  lengths[0] = 1.1;
  EXPECT_FALSE(are_even(c, spread_target_lengths(c, lengths)));
}

/// A sphere whose target lengths vary by 4.
struct Graded {
  test::Triangles t = test::sphere(3, .2, 6);
  Adjacency c = test::connect(t);
  Sizing sizing;

  Graded() {
    for (const auto p : t.points.colwise()) sizing.vertex_length.push_back(2.5 + 1.5 * p[2]);
  }
  std::vector<double> resolve(const char* length) const {
    return resolve_vertex_lengths(parse_length(length), sizing, t.points, c);
  }
  TargetLengths targets(const char* length) const { return spread_target_lengths(c, resolve(length)); }
};

TEST(VertexLengths, ConstantOnesAreThoseWithoutASizingToTheLastBit) {
  Graded g;
  for (const char* length : {"auto", "mean", "1.3x", "7%", ".123"}) {
    const std::vector<double> plain = resolve_vertex_lengths(parse_length(length), {}, g.t.points, g.c);
    for (double constant : {1., .1, 7e5}) {
      g.sizing.vertex_length.assign(plain.size(), constant);
      EXPECT_EQ(g.resolve(length), plain) << length << " " << constant;
    }
  }
}

TEST(VertexLengths, AutoAsksForAsManyFacesAsThereAre) {
  const Graded g;
  const double natural = natural_length_of(g.t);
  EXPECT_NEAR(covering_length(g.t.points, g.c, g.targets("auto")), natural, 2e-6 * natural);
  EXPECT_NEAR(covering_length(g.t.points, g.c, g.targets("2x")), 2 * natural, 4e-6 * natural);
  EXPECT_NEAR(mean_length(g.t.points, g.c, g.targets(".2")), .2, 4e-7);
  const std::vector<double> lengths = g.resolve("auto");
  for (size_t v = 0; v < lengths.size(); ++v)
    EXPECT_NEAR(lengths[v] / lengths[0], g.sizing.vertex_length[v] / g.sizing.vertex_length[0], 1e-12);
}

TEST(VertexLengths, AutoCoversTheAreaAlsoWhereTheGradationHoldsLengthsBack) {
  Graded g;
  std::ranges::fill(g.sizing.vertex_length, 10);
  g.sizing.vertex_length[0] = g.sizing.vertex_length[100] = 1;
  g.sizing.gradation = .1;
  const TargetLengths targets = g.targets("auto");
  const double natural = natural_length_of(g.t);
  EXPECT_NEAR(covering_length(g.t.points, g.c, targets), natural, 1e-5 * natural);
  const std::vector<double> lengths = g.resolve("auto");
  EXPECT_GT(lengths[0], .101 * *std::ranges::max_element(lengths));
}

TEST(VertexLengths, AreTakenAsTheyAreOnRequest) {
  Graded g;
  for (double& l : g.sizing.vertex_length) l *= .05;
  EXPECT_EQ(g.resolve("sizing"), g.sizing.vertex_length);
  g.sizing.vertex_length.clear();
  EXPECT_THROW(g.resolve("sizing"), Error);
}

TEST(VertexLengths, APowerOfTwoScalesThemExactly) {
  Graded g;
  const std::vector<double> lengths = g.resolve("auto");
  g.t.points *= .25;
  for (double& l : g.sizing.vertex_length) l *= 1024;
  const std::vector<double> scaled = g.resolve("auto");
  for (size_t v = 0; v < lengths.size(); ++v) EXPECT_EQ(scaled[v], .25 * lengths[v]);
}

TEST(VertexLengths, FollowTheLeastRadiusOfCurvature) {
  test::Triangles t = test::sphere(3, .2, 1);
  const Adjacency c = test::connect(t);
  const auto expected = [](double error) { return std::sqrt(8 * error - 4 * error * error); };
  for (double error : {1e-4, .01, .3})
    for (double l : curvature_lengths(t.points, c, error, 10)) EXPECT_NEAR(l, expected(error), .03 * l);
  for (double l : curvature_lengths(t.points, c, 5, 100))
    EXPECT_EQ(l, 10);  // a smaller radius does not count
  for (double l : curvature_lengths(t.points, c, .3, .1)) EXPECT_EQ(l, .1);
}

TEST(LeastRestAngle, IsThatOfTheSlimmestTriangleOfRestLengths) {
  const Adjacency c = make_adjacency(4, {{0, 1, 2}, {0, 2, 3}});
  const auto angle_with = [&](double diagonal, double side) {
    std::vector<double> lengths(c.edges.size(), side);
    for (std::size_t e = 0; e < lengths.size(); ++e)
      if (!c.is_boundary_edge(static_cast<int>(e))) lengths[e] = diagonal;
    return least_rest_angle(c, from_edge_lengths(c, lengths));
  };
  EXPECT_NEAR(angle_with(2, 2), 60, 1e-9);
  EXPECT_NEAR(angle_with(std::numbers::sqrt2, 1), 45, 1e-9);
  EXPECT_NEAR(angle_with(1, 2), 2 * std::asin(.25) * 180 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(angle_with(3, 1), 60, 1e-9);
}

}  // namespace hooke::target_lengths_test
