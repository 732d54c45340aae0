#include "hooke/mesh/attributes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hooke/core/error.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/ply.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/remesh.h"
#include "hooke/springs/target_lengths.h"
#include "support/errors.h"
#include "support/meshes.h"

namespace hooke::attributes_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// A channel of each type on three vertices.
VertexData all_types() {
  return {{"a", NumberType::int8, {-128, 0, 127}},
          {"red", NumberType::uint8, {0, 1, 255}},
          {"c", NumberType::int16, {-32768, 7, 32767}},
          {"d", NumberType::uint16, {0, 1, 65535}},
          {"e", NumberType::int32, {-2147483648., 0, 2147483647}},
          {"f", NumberType::uint32, {0, 1, 4294967295.}},
          {"g", NumberType::float32, {.5, nan, -inf}},
          {"h", NumberType::float64, {1. / 3, inf, 1e-300}}};
}

TEST(VertexData, PlyReturnsEveryNumberOfEveryType) {
  const Mat3X points{{0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  for (PlyEncoding encoding :
       {PlyEncoding::ascii, PlyEncoding::binary_little_endian, PlyEncoding::binary_big_endian}) {
    const MeshFile file = read_ply(write_ply(points, {{0, 1, 2}}, encoding, all_types()), "m.ply");
    EXPECT_TRUE(file.content.anew.empty());
    EXPECT_EQ(file.points, points);
    EXPECT_EQ(file.polygons.items, (std::vector{0, 1, 2}));
    ASSERT_EQ(file.vertex_data.size(), 8u);
    for (size_t c = 0; c < 8; ++c) {
      const VertexChannel expected = all_types()[c], &channel = file.vertex_data[c];
      EXPECT_EQ(channel.name, expected.name);
      EXPECT_EQ(channel.type, expected.type);
      for (size_t v = 0; v < 3; ++v)
        if (std::isnan(expected.values[v]))
          EXPECT_TRUE(std::isnan(channel.values[v]));
        else
          EXPECT_EQ(channel.values[v], expected.values[v]);
    }
  }
}

TEST(VertexData, BrokenNumbersOfVerticesAreErrors) {
  const auto ply = [](const std::string& type, const std::string& value) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
           "property " +
           type + " q\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1\n1 0 0 " +
           value + "\n0 1 0 1\n3 0 1 2\n";
  };
  EXPECT_NO_THROW(read_ply(ply("float", "-inf"), "m.ply"));
  EXPECT_ERROR(InputError, "m.ply:12: q is 'red'", read_ply(ply("float", "red"), "m.ply"));
  EXPECT_ERROR(InputError, "m.ply:12: q is 'nan'", read_ply(ply("uchar", "nan"), "m.ply"));
  EXPECT_ERROR(InputError, "m.ply:12: a value is missing", read_ply(ply("float", ""), "m.ply"));
}

TEST(VertexData, IsLinearInTheFaces) {
  const VertexData data = {{"w", NumberType::float64, {1, 2, 4, nan}},
                           {"red", NumberType::uint8, {0, 1, 1, 9}}};
  const std::vector<Triangle> faces = {{0, 1, 2}, {2, 1, 3}};
  const std::vector<MapEntry> map = {
      {0, {0, Vec3(1, 0, 0)}}, {-1, {0, Vec3(.5, .25, .25)}}, {-1, {1, Vec3(.5, .5, 0)}}, {3, {}}};
  const VertexData carried = interpolate(data, map, faces);
  EXPECT_EQ(carried[0].values[0], 1);
  EXPECT_EQ(carried[0].values[1], 2);
  EXPECT_EQ(carried[0].values[2], 3) << "the corner without weight does not count";
  EXPECT_TRUE(std::isnan(carried[0].values[3]));
  EXPECT_EQ(carried[1].values, (std::vector<double>{0, 1, 1, 9}));
}

TEST(VertexData, LabelsAreThoseOfTheNearestCorner) {
  const std::vector<Triangle> faces = {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}};
  const std::vector<MapEntry> map = {
      {-1, {0, Vec3(.4, .25, .35)}}, {-1, {0, Vec3(.2, .3, .5)}}, {-1, {0, Vec3(0, .5, .5)}}, {2, {}}};
  const std::vector<double> same = {1, 5, 9, 7, 7, 7, 7}, differ = {1, 5, 9, 3, 4, 5, 6};
  const std::vector<double> nearest = {1, 9, 5, 9}, rounded = {5, 6, 7, 9};
  for (const NumberType type : {NumberType::uint8, NumberType::int8, NumberType::uint16, NumberType::int32}) {
    const bool is_short = type != NumberType::int32;
    const VertexData data = {{"label", type, same}, {"red", type, same}, {"q", type, differ}};
    const VertexData carried = interpolate(data, map, faces);
    EXPECT_EQ(carried[0].values, nearest);
    EXPECT_EQ(carried[1].values, rounded);
    EXPECT_EQ(carried[2].values, is_short ? rounded : nearest) << "brightness";
  }
}

TEST(VertexData, AValueIsNeverBeyondThoseOfTheCorners) {
  const std::vector<Triangle> faces = {{0, 1, 2}};
  const VertexData data = {{"same", NumberType::float64, {.1, .1, .1}},
                           {"infinite", NumberType::float64, {inf, 1, 1}},
                           {"none", NumberType::float64, {1, nan, 1}},
                           {"large", NumberType::float64, {1e308, 1.7e308, 1.7e308}}};
  std::vector<MapEntry> map;
  for (int k = 1; k < 100; ++k) {
    const double a = k / 300., b = std::sqrt(k) / 20;
    map.push_back({-1, {0, Vec3(a, b, 1 - a - b)}});
  }
  const VertexData carried = interpolate(data, map, faces);
  for (size_t v = 0; v < map.size(); ++v) {
    EXPECT_EQ(carried[0].values[v], .1);
    EXPECT_EQ(carried[1].values[v], inf);
    EXPECT_TRUE(std::isnan(carried[2].values[v]));
    EXPECT_LE(carried[3].values[v], 1.7e308);
  }
}

TEST(VertexData, ALinearFieldOnAPlaneGoesWithAnAdaptedMesh) {
  const test::Triangles t = test::grid(8, test::flat, .3);
  VertexData data = {{.name = "field"}};
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    data[0].values.push_back(3 * t.points(0, v) - t.points(1, v));
  TriMesh mesh = test::to_mesh(t);
  set_vertex_values(mesh, target_length_property,
                    .7 * natural_length(total_area(t.points, t.faces), t.faces.size()));
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  options.map = true;
  const VertexData carried = interpolate(data, remesh(mesh, options).map, t.faces);
  const Mat3X points = vertex_points(mesh);
  ASSERT_EQ(carried[0].values.size(), points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    EXPECT_NEAR(carried[0].values[v], 3 * points(0, v) - points(1, v), 1e-9);
}

TEST(VertexData, NormalsNeedAllThreeChannels) {
  VertexData data = {{.name = "nx", .values = {9}}, {.name = "nz", .values = {9}}};
  EXPECT_FALSE(has_normals(data));
  data.push_back({.name = "ny", .values = {9}});
  ASSERT_TRUE(has_normals(data));
  set_normals(data, Vec3(1, 2, 3));
  EXPECT_EQ(data[0].values[0], 1);
  EXPECT_EQ(data[1].values[0], 3);
  EXPECT_EQ(data[2].values[0], 2);
}

TEST(FormatData, ColoursChangeTheirScaleBetweenFormats) {
  const VertexData bytes = {{"red", NumberType::uint8, {0, 255}},
                            {"green", NumberType::uint8, {51, 255}},
                            {"blue", NumberType::uint8, {255, 0}},
                            {"quality", NumberType::float32, {1, 2}}};
  const FormatData obj = data_for_format(bytes, MeshFormat::ply, MeshFormat::obj);
  ASSERT_EQ(obj.data.size(), 3u);
  EXPECT_EQ(obj.data[1].values, (std::vector<double>{.2, 1}));
  EXPECT_EQ(obj.dropped, std::vector<std::string>{"quality"});
  const FormatData ply = data_for_format(obj.data, MeshFormat::obj, MeshFormat::ply);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(ply.data[c].type, NumberType::uint8);
    EXPECT_EQ(ply.data[c].values, bytes[c].values);
  }
  EXPECT_EQ(data_for_format(bytes, MeshFormat::ply, MeshFormat::ply).data.size(), 4u);
  const FormatData off = data_for_format(obj.data, MeshFormat::obj, MeshFormat::off);
  ASSERT_EQ(off.data.size(), 4u) << "an alpha is added";
  for (size_t c = 0; c < 3; ++c) EXPECT_EQ(off.data[c].values, bytes[c].values);
  EXPECT_EQ(off.data[3].values, (std::vector<double>{255, 255}));
  EXPECT_EQ(data_for_format(off.data, MeshFormat::off, MeshFormat::obj).dropped,
            std::vector<std::string>{"alpha"});
}

TEST(FormatData, ColoursWithoutANumberHaveNoPlaceInTextFormats) {
  const VertexData data = {{"red", NumberType::float32, {nan, 2}},
                           {"green", NumberType::float32, {.5, -1}},
                           {"blue", NumberType::float32, {1, 1}}};
  EXPECT_EQ(data_for_format(data, MeshFormat::ply, MeshFormat::off).dropped.size(), 3u);
  EXPECT_EQ(data_for_format(data, MeshFormat::ply, MeshFormat::obj).dropped.size(), 3u);
}

TEST(FormatData, NormalsAndTextureCoordinatesGoBetweenFormatsWhereTheyAreWhole) {
  const auto of = [](const std::vector<std::string>& names) {
    VertexData data;
    for (const std::string& name : names) data.push_back({name, NumberType::float32, {.25, .5}});
    return data;
  };
  const auto dropped = [&](const std::vector<std::string>& names, MeshFormat from, MeshFormat to) {
    return data_for_format(of(names), from, to).dropped;
  };
  const std::vector<std::string> none;
  for (const MeshFormat to : {MeshFormat::obj, MeshFormat::off}) {
    EXPECT_EQ(dropped({"nx", "ny", "nz", "s", "t"}, MeshFormat::ply, to), none);
    EXPECT_EQ(dropped({"nx", "nz", "t"}, MeshFormat::ply, to).size(), 3u);
    const FormatData other = data_for_format(of({"texture_u", "q", "texture_v"}), MeshFormat::ply, to);
    ASSERT_EQ(other.data.size(), 2u);
    EXPECT_EQ(other.data[0].name, "s");
    EXPECT_EQ(other.data[1].name, "t");
    EXPECT_EQ(dropped({"s", "t", "texture_u", "texture_v"}, MeshFormat::ply, to).size(), 2u)
        << "one pair has the place";
  }
  EXPECT_EQ(dropped({"s", "t", "p"}, MeshFormat::obj, MeshFormat::off), std::vector<std::string>{"p"});
  EXPECT_EQ(dropped({"s", "t", "p"}, MeshFormat::obj, MeshFormat::ply), none);
  VertexData endless = of({"s", "t"});
  endless[1].values[0] = inf;
  EXPECT_EQ(data_for_format(endless, MeshFormat::ply, MeshFormat::obj).dropped.size(), 2u);
}

}  // namespace hooke::attributes_test
