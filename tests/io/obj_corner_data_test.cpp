#include "hooke/io/obj_corner_data.h"

#include <gtest/gtest.h>

namespace hooke::obj_corner_data_test {

/// A fan of triangles about vertex 0 with the ring 1, 2 ... n, closed.
IntLists fan(int n) {
  IntLists polygons{{0}, {}};
  for (int k = 0; k < n; ++k) {
    polygons.items.insert(polygons.items.end(), {0, 1 + k, 1 + (k + 1) % n});
    polygons.first.push_back(3 * (k + 1));
  }
  return polygons;
}

CornerSeams seams_of(const ElementsOfCorners& data, const IntLists& polygons, int vertices) {
  return find_corner_seams(data, polygons, elements_of_vertices(data, polygons, vertices));
}

TEST(CornerData, WhatIsTheSameInAllCornersHasNoSeam) {
  const IntLists polygons = fan(6);
  Mat3X values = Mat3X::Random(3, 7);
  EXPECT_TRUE(seams_of({values, polygons.items}, polygons, 7).vertices.empty());

  // As many elements as corners, equal where the vertex is.
  Mat3X repeated(3, 18);
  std::vector<int> own(18);
  for (int c = 0; c < 18; ++c) {
    repeated.col(c) = values.col(polygons.items[c]);
    own[c] = c;
  }
  const CornerSeams seams = seams_of({repeated, own}, polygons, 7);
  EXPECT_TRUE(seams.vertices.empty());
  EXPECT_EQ(seams.edges, 0u);
}

TEST(CornerData, ASeamIsItsVerticesAndItsEdges) {
  const IntLists polygons = fan(6);
  const Mat3X values = Mat3X::Random(3, 14);
  std::vector<int> elements = polygons.items;  // faces 0, 1 and 2 have other values: cut along 4-0-1
  for (size_t c = 0; c < 9; ++c) elements[c] += 7;
  const CornerSeams seams = seams_of({values, elements}, polygons, 7);
  EXPECT_EQ(seams.vertices, (std::vector{0, 1, 4}));
  EXPECT_EQ(seams.edges, 2u);
}

TEST(CornerData, AnEdgeIsPartOfASeamWhenOneEndDiffers) {
  const IntLists polygons = fan(4);
  const Mat3X values = Mat3X::Random(3, 6);
  std::vector<int> elements = polygons.items;
  elements[0] = 5;  // vertex 0 in face 0: differs along 0-1 and 0-2
  const CornerSeams seams = seams_of({values, elements}, polygons, 5);
  EXPECT_EQ(seams.vertices, std::vector{0});
  EXPECT_EQ(seams.edges, 2u);
}

TEST(CornerData, VerticesWithoutCornersGetZero) {
  MeshFile file;
  file.points.resize(3, 4);
  file.polygons = {{0, 3}, {0, 1, 2}};
  const Mat3X values{{.5, .25, .125}, {1, 2, 3}, {9, 9, 9}};
  keep_as_vertex_data(file, {values, {2, 1, 0}}, 2,
                      {texture_names, NumberType::float64, "texture coordinates", "vt", "seams", "code"});
  EXPECT_TRUE(file.content.anew.empty());
  ASSERT_EQ(file.vertex_data.size(), 2u);
  EXPECT_EQ(file.vertex_data[0].name, "s");
  EXPECT_EQ(file.vertex_data[0].values, (std::vector<double>{.125, .25, .5, 0}));
  EXPECT_EQ(file.vertex_data[1].values, (std::vector<double>{3, 2, 1, 0}));
}

}  // namespace hooke::obj_corner_data_test
