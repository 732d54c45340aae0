#include "hooke/mesh/chart_places.h"

#include <gtest/gtest.h>

#include "hooke/mesh/wedges.h"
#include "support/solids.h"

namespace hooke::chart_places_test {
namespace {

Adjacency adjacency_of(const test::Triangles& t) {
  return make_adjacency(static_cast<int>(t.points.cols()), t.faces);
}

TEST(ChartPlaces, OfASurfaceOnItselfAreItsFacesAndVertices) {
  const test::Triangles t = test::sphere(2, .2);
  Adjacency c = adjacency_of(t);
  split_wedges(c, {c.edges[0], c.edges[7]});
  const ChartPlaces places = find_chart_places({t.points, c}, {t.points, c});
  for (size_t f = 0; f < c.faces.size(); ++f) EXPECT_EQ(places.faces[f], static_cast<int>(f));
  for (size_t wedge = 0; wedge < places.wedges.size(); ++wedge) {
    Eigen::Index corner;
    EXPECT_EQ(places.wedges[wedge].weights.maxCoeff(&corner), 1);
    EXPECT_EQ(c.faces[places.wedges[wedge].face][corner], c.vertex_of_wedge(static_cast<int>(wedge)));
  }
}

TEST(ChartPlaces, AreOnTheirOwnSideOfAFeatureEdgeThatEnds) {
  // A cut from the boundary to the middle of a square: the chart borders on itself.
  const test::Triangles t = test::grid(8, test::flat, .2), fine = test::grid(20, test::flat);
  const auto cut = [](const test::Triangles& square) {
    Adjacency c = adjacency_of(square);
    std::vector<Edge> edges;
    for (const Edge& e : c.edges) {
      const auto is_on_cut = [&](int v) { return square.points(0, v) == .5 && square.points(1, v) <= .5; };
      if (is_on_cut(e[0]) && is_on_cut(e[1])) edges.push_back(e);
    }
    split_wedges(c, edges);
    return c;
  };
  test::Triangles coarse = t;  // with a straight cut
  for (auto x : coarse.points.colwise())
    if (std::abs(x[0] - .5) < .05) x[0] = .5;
  const Adjacency input = cut(coarse), result = cut(fine);
  ASSERT_FALSE(input.creases.empty());
  const ChartPlaces places = find_chart_places({coarse.points, input}, {fine.points, result});
  const auto side = [](const Mat3X& points, const Triangle& face) {
    return points(0, face[0]) + points(0, face[1]) + points(0, face[2]) > 1.5;
  };
  const auto is_below = [&](const Triangle& face) {
    return fine.points(1, face[0]) + fine.points(1, face[1]) + fine.points(1, face[2]) < 1.5;
  };
  int on_cut = 0;
  for (size_t f = 0; f < result.faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const int v = result.faces[f][k];
      if (fine.points(0, v) != .5 || fine.points(1, v) >= .5 || !is_below(result.faces[f])) continue;
      ++on_cut;
      const SurfacePoint& place = places.wedges[result.wedges_of_faces()[f][k]];
      EXPECT_EQ(side(coarse.points, input.faces[place.face]), side(fine.points, result.faces[f]));
    }
  EXPECT_GT(on_cut, 20);
}

TEST(ChartPlaces, OneLargeFaceNearAnotherChartDoesNotDecide) {
  const test::Triangles low = test::grid(8, test::flat);
  test::Triangles high = low, moved = low;
  high.points.row(2).setOnes();
  moved.points(2, moved.points.cols() - 1) =
      1.8;  // faces at this corner are the largest, and nearer to `high`
  const test::Triangles input = test::both(high, low);
  const Adjacency c = adjacency_of(input), result = adjacency_of(moved);
  const ChartPlaces places = find_chart_places({input.points, c}, {moved.points, result});
  for (const int face : places.faces) EXPECT_GE(face, std::ssize(high.faces));
}

TEST(ChartPlaces, NearFacesTellSheetsApart) {
  const test::Triangles sheet = test::grid(4, test::flat);
  const auto n = static_cast<int>(sheet.points.cols());
  test::Triangles two{Mat3X(3, 2 * n), sheet.faces};
  two.points << sheet.points, sheet.points;
  two.points.row(2).tail(n).setConstant(.01);
  for (const Triangle& face : sheet.faces) two.faces.push_back({face[0] + n, face[1] + n, face[2] + n});
  const Adjacency c = adjacency_of(two);
  Mat3X moved = two.points;
  moved.row(2).head(n).setConstant(.009);  // nearer to the other sheet
  std::vector<int> near;
  for (int v = 0; v < 2 * n; ++v) near.push_back(c.vertex_faces[v][0]);
  const ChartPlaces places = find_chart_places({two.points, c}, {moved, c}, near);
  for (size_t f = 0; f < c.faces.size(); ++f) EXPECT_EQ(places.faces[f], static_cast<int>(f));
}

}  // namespace
}  // namespace hooke::chart_places_test
