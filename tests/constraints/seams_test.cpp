#include "hooke/constraints/seams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/mesh/corner_differences.h"
#include "hooke/mesh/hard_edges.h"
#include "support/meshes.h"

namespace hooke::seams_test {
namespace {

/// Data of a grid: texture coordinates x and y, those to the right of `border` moved by `gap`.
CornerData texture_of(const test::Triangles& t, double border, double gap) {
  CornerData data;
  const Eigen::Index n = t.points.cols();
  data.texture.width = 2;
  data.texture.values = Mat3X::Zero(3, 2 * n);
  data.texture.values.topRows(2) << t.points.topRows(2), t.points.topRows(2);
  data.texture.values.row(0).tail(n).array() += gap;
  for (const Triangle& face : t.faces) {
    double x = 0;
    for (const int v : face) x += t.points(0, v) / 3;
    const int shift = x > border ? static_cast<int>(n) : 0;
    data.texture.corners.push_back({face[0] + shift, face[1] + shift, face[2] + shift});
  }
  return data;
}

FaceChannel halves(const test::Triangles& t, LabelKind kind) {
  FaceChannel channel{"half", {}, {}, kind};
  for (const Triangle& face : t.faces)
    channel.values.push_back(t.points(1, face[0]) + t.points(1, face[1]) + t.points(1, face[2]) > 1.5);
  return channel;
}

const test::Triangles& square() {
  static const test::Triangles t = test::grid(8, test::flat);
  return t;
}

Seams seams_of(const CornerData& corners, const FaceData& faces, const SeamKinds& kinds = {}) {
  const MemoryOrder order = find_memory_order(test::to_mesh(square()));
  return find_seams(order, corners, faces, kinds);
}

double length_of(const Seams& seams) {
  double sum = 0;
  for (const auto& [a, b] : seams.ends) sum += (square().points.col(a) - square().points.col(b)).norm();
  return sum;
}

TEST(Seams, AreWhereTheTextureJumps) {
  const Seams seams = seams_of(texture_of(square(), .5, 3), {});
  EXPECT_EQ(seams.texture, 8u);
  EXPECT_EQ(seams.edges.size(), 8u);
  EXPECT_DOUBLE_EQ(length_of(seams), 1);
  for (const Edge& e : seams.ends)
    for (const int v : e) EXPECT_EQ(square().points(0, v), .5);
}

TEST(Seams, EqualValuesWithOtherNumbersAreNone) {
  EXPECT_TRUE(seams_of(texture_of(square(), .5, 0), {}).edges.empty());
  EXPECT_TRUE(seams_of(texture_of(square(), .5, 1e-9), {}).edges.empty()) << "nor those that only round so";
}

TEST(Seams, FacesWithoutTextureHaveASeamToThoseWithOne) {
  CornerData data = texture_of(square(), .5, 0);
  for (Triangle& corners : data.texture.corners)
    if (corners[0] >= square().points.cols()) corners = {-1, -1, -1};
  EXPECT_DOUBLE_EQ(length_of(seams_of(data, {})), 1);
}

/// Normals of the square: to the right of `border` turned by `degrees` about the y axis.
CornerValues normals_of(double border, double degrees) {
  CornerValues normals = texture_of(square(), border, 0).texture;
  const double angle = degrees * std::numbers::pi / 180;
  const Eigen::Index n = square().points.cols();
  normals.width = 3;
  normals.values.leftCols(n).colwise() = Vec3(0, 0, 1);
  normals.values.rightCols(n).colwise() = Vec3(std::sin(angle), 0, std::cos(angle));
  return normals;
}

TEST(Seams, AreWhereNormalsDiffer) {
  const Seams seams = seams_of({{}, normals_of(.5, 3)}, {});
  EXPECT_EQ(seams.hard_edges, 8u);
  EXPECT_EQ(seams.edges.size(), 8u);
  EXPECT_DOUBLE_EQ(length_of(seams), 1);
  EXPECT_TRUE(seams_of({{}, normals_of(.5, .7)}, {}).edges.empty()) << "by more than digits make";
  EXPECT_TRUE(seams_of({{}, normals_of(2, 90)}, {}).edges.empty());
  EXPECT_TRUE(seams_of({{}, normals_of(.5, 3)}, {}, {.hard_edges = false}).edges.empty());
}

TEST(Seams, AHardEdgeMayEndInTheSurface) {
  CornerValues normals = normals_of(.5, 20);
  const Eigen::Index n = square().points.cols();
  const auto half_way = [&](int v) { return square().points(1, v) >= .5; };
  for (Eigen::Index v = 0; v < n; ++v)
    if (half_way(static_cast<int>(v))) normals.values.col(n + v) = normals.values.col(v);
  EXPECT_DOUBLE_EQ(length_of(seams_of({{}, normals}, {})), .5);
}

TEST(Seams, FacesWithoutNormalsHaveNoHardEdges) {
  CornerValues normals = normals_of(.5, 20);
  for (Triangle& corners : normals.corners)
    if (corners[0] >= square().points.cols()) corners = {-1, -1, -1};
  EXPECT_TRUE(seams_of({{}, normals}, {}).edges.empty());
}

/// Each pair of triangles, or each triangle, has a normal of its own; the surface is flat.
CornerValues normals_of_facets(std::size_t faces_each) {
  CornerValues normals;
  const std::size_t faces = square().faces.size();
  normals.values.resize(3, std::ssize(square().faces));
  for (std::size_t f = 0; f < faces; ++f) {
    const int id = static_cast<int>(f / faces_each);
    normals.corners.push_back({id, id, id});
    normals.values.col(id) = Vec3(std::sin(id), std::cos(id), 3).normalized();
  }
  return normals;
}

TEST(Seams, NormalsOfFacetsSayNothing) {
  for (const std::size_t faces_each : {1, 2}) {
    EXPECT_TRUE(seams_of({{}, normals_of_facets(faces_each)}, {}).edges.empty());
    EXPECT_TRUE(find_hard_edges(find_memory_order(test::to_mesh(square())), normals_of_facets(faces_each))
                    .is_flat_shaded);
  }
  EXPECT_FALSE(
      find_hard_edges(find_memory_order(test::to_mesh(square())), normals_of(.5, 90)).is_flat_shaded);
}

TEST(Seams, AreOfTheKindsAskedFor) {
  const CornerData corners = texture_of(square(), .5, 3);
  for (const LabelKind kind : {LabelKind::material, LabelKind::group, LabelKind::other}) {
    const FaceData faces = {halves(square(), kind)};
    const Seams all = seams_of(corners, faces);
    EXPECT_EQ(all.materials, kind == LabelKind::material ? 8u : 0u);
    EXPECT_EQ(all.groups, kind == LabelKind::group ? 8u : 0u);
    EXPECT_DOUBLE_EQ(length_of(all), kind == LabelKind::other ? 1 : 2);
    EXPECT_DOUBLE_EQ(length_of(seams_of(corners, faces, {true, false, false, false})), 1);
    EXPECT_TRUE(seams_of(corners, faces, {false, false, false, false}).edges.empty());
  }
}

/// A fan of n triangles about vertex 0 whose texture has a value for each of them there.
CornerValues texture_of_fan(int n) {
  CornerValues values;
  values.values = Mat3X::Zero(3, 2 * n + 1);
  for (int i = 0; i <= n; ++i) values.values(0, i) = i;
  for (int i = 0; i < n; ++i) {
    values.values.col(n + 1 + i) = Vec3(i + .5, 1, 0);
    values.corners.push_back({n + 1 + i, i, i + 1});
  }
  return values;
}

TEST(Seams, APoleIsWhereManyFacesMeetThatOnlyDifferThere) {
  for (const int n : {6, 12}) {
    Mat3X points = Mat3X::Zero(3, n + 1);
    std::vector<Triangle> faces;
    for (int i = 0; i < n; ++i) {
      points.col(i + 1) = Vec3(std::cos(6.2831853 * i / n), std::sin(6.2831853 * i / n), 0);
      faces.push_back({0, 1 + i, 1 + (i + 1) % n});
    }
    const MemoryOrder order = find_memory_order(build_mesh(points, faces));
    const CornerData corners{texture_of_fan(n), {}};
    const Seams seams = find_seams(order, corners, {});
    const bool is_pole = n == 12;  // six faces leave room for good angles
    EXPECT_EQ(seams.poles, is_pole ? std::vector{0} : std::vector<int>());
    EXPECT_EQ(seams.edges.size(), is_pole ? 1u : 6u) << "the one where the texture begins and ends";
  }
}

}  // namespace
}  // namespace hooke::seams_test
