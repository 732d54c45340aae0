#include "hooke/io/renewed_normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/mesh/normals.h"
#include "support/meshes.h"

namespace hooke::renewed_normals_test {

IntLists lists(const std::vector<std::vector<int>>& polygons) {
  IntLists result{{0}, {}};
  for (const auto& polygon : polygons) {
    result.items.insert(result.items.end(), polygon.begin(), polygon.end());
    result.first.push_back(static_cast<int>(result.items.size()));
  }
  return result;
}

IntLists lists_of(const std::vector<Triangle>& faces) {
  std::vector<std::vector<int>> polygons;
  for (const Triangle& t : faces) polygons.push_back({t.begin(), t.end()});
  return lists(polygons);
}

TEST(RenewedNormals, OfTrianglesAreTheVertexNormals) {
  const test::Triangles sphere = test::sphere(2, .2);
  const Mat3X moved = 2 * sphere.points;
  const RenewedNormals normals = renew_vertex_normals({lists_of(sphere.faces), sphere.points, moved});
  const Mat3X expected = vertex_normals(moved, make_adjacency(static_cast<int>(moved.cols()), sphere.faces));
  EXPECT_LT((normals.values - expected).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(normals.torn, 0);
}

TEST(RenewedNormals, OnlyWhereAVertexOfTheFacesMoved) {
  const test::Triangles sphere = test::sphere(2);
  Mat3X moved = sphere.points;
  moved.col(7) *= 1.1;
  const RenewedNormals normals = renew_vertex_normals({lists_of(sphere.faces), sphere.points, moved});
  std::vector<char> expected(normals.renewed.size(), 0);
  for (const Triangle& t : sphere.faces)
    if (t[0] == 7 || t[1] == 7 || t[2] == 7)
      for (const int v : t) expected[v] = 1;
  EXPECT_EQ(normals.renewed, expected);
}

// A square in the plane with a concave pentagon around one of its corners.
TEST(RenewedNormals, ConcaveCornersPointToTheSideOfTheirPolygon) {
  const Mat3X points =
      (Mat3X(3, 5) << 0, 2, 2, 1, 0, 0, 0, 2, .5, 2, 0, 0, 0, 0, 0).finished();  // concave at vertex 3
  Mat3X moved = points;
  moved.row(2).setConstant(1);
  const RenewedNormals normals = renew_vertex_normals({lists({{0, 1, 2, 3, 4}}), points, moved});
  for (int v = 0; v < 5; ++v) EXPECT_EQ(Vec3(normals.values.col(v)), Vec3(0, 0, 1)) << v;
  const RenewedNormals faces = renew_polygon_normals({lists({{0, 1, 2, 3, 4}}), points, moved});
  EXPECT_EQ(Vec3(faces.values.col(0)), Vec3(0, 0, 1));
}

TEST(RenewedNormals, EqualOldNormalsMakeAFanWhateverTheirNumbers) {
  const IntLists polygons = lists({{0, 1, 2}, {1, 3, 2}});
  const Mat3X before = (Mat3X(3, 4) << 0, 1, 1, 2, 0, 0, 1, 0, 0, 0, 0, 0).finished();
  Mat3X after = before;
  after(2, 3) = 1;
  const auto normals = [&](const Vec3& other) {
    Mat3X values(3, 2);
    values << Vec3::UnitZ(), other;
    return renew_corner_normals({polygons, before, after}, {0, 0, 0, 1, 1, 1}, values).values;
  };
  const Mat3X hard = normals(Vec3::UnitX()), smooth = normals(Vec3(0, 0, 3));
  EXPECT_EQ(Vec3(hard.col(0)), Vec3::UnitZ());
  EXPECT_LT((Vec3(hard.col(1)) - Vec3(-1, 0, 1).normalized()).norm(), 1e-12);
  EXPECT_LT(smooth(0, 0), -.1) << "bends towards the other face";
}

TEST(RenewedNormals, SizeDoesNotMatter) {
  const test::Triangles sphere = test::sphere(1, .2);
  for (const double scale : {1e-150, 1e150}) {
    const RenewedNormals normals =
        renew_vertex_normals({lists_of(sphere.faces), sphere.points, sphere.points * scale});
    const RenewedNormals expected =
        renew_vertex_normals({lists_of(sphere.faces), sphere.points, sphere.points * 2});
    EXPECT_LT((normals.values - expected.values).cwiseAbs().maxCoeff(), 1e-12) << scale;
  }
}

}  // namespace hooke::renewed_normals_test
