#include "hooke/io/msh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "hooke/core/error.h"
#include "support/errors.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::msh_test {

using test::has;

constexpr MeshFormat versions[] = {MeshFormat::msh, MeshFormat::msh2};

std::vector<Triangle> faces_of(const MeshFile& file) {
  std::vector<Triangle> faces;
  for (int f = 0; f + 1 < static_cast<int>(file.polygons.first.size()); ++f)
    faces.push_back({file.polygons[f][0], file.polygons[f][1], file.polygons[f][2]});
  return faces;
}

// Builds binary files.
struct Binary {
  bool swapped = false;
  std::string bytes = {};

  template <typename T>
  Binary& operator()(T value) {
    auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
    if (swapped) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
    return *this;
  }
  Binary& text(const std::string& more) {
    bytes += more;
    return *this;
  }
  Binary& ints(std::initializer_list<std::int32_t> values) {
    for (const auto value : values) (*this)(value);
    return *this;
  }
  Binary& sizes(std::initializer_list<std::uint64_t> values) {
    for (const auto value : values) (*this)(value);
    return *this;
  }
  Binary& reals(std::initializer_list<double> values) {
    for (const auto value : values) (*this)(value);
    return *this;
  }
};

const std::string old_text =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 3 \"rim\"\n2 7 \"the "
    "\"wall\"\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n10 0 0 0\n900 1 0 0\n3 1 1 0\n77 0 1 0\n5 9 9 9\n$EndNodes\n"
    "$Elements\n4\n1 15 2 0 1 10\n2 1 2 3 1 10 900\n3 2 2 7 4 10 900 3\n8 2 3 0 5 1 10 3 77\n$EndElements\n";

TEST(Msh, BothVersionsReturnEveryBitOfTheMeshAndItsLabels) {
  const test::Triangles t = test::shuffled(test::sphere(2, .2));
  FaceChannel group{group_channel, std::vector<int>(t.faces.size()), {{5, "top"}, {-3, "low"}}},
      entity{entity_channel, std::vector<int>(t.faces.size())};
  for (size_t f = 0; f < t.faces.size(); ++f) {
    group.values[f] = f % 7 < 3 ? 5 : f % 7 == 3 ? -3 : 0;
    entity.values[f] = f % 7 < 3 ? 11 : f % 7 == 3 ? 2 : 30;
  }
  for (const MeshFormat version : versions) {
    const std::string text = write_msh(t.points, t.faces, version, {group, entity});
    const MeshFile file = read_msh(text, "m");
    EXPECT_EQ(file.format, version);
    EXPECT_EQ(file.points, t.points);
    EXPECT_EQ(faces_of(file), t.faces);
    EXPECT_TRUE(file.content.anew.empty());
    ASSERT_EQ(file.face_data.size(), 2u);
    EXPECT_EQ(file.face_data[0].values, group.values);
    EXPECT_EQ(file.face_data[0].names, group.names);
    EXPECT_EQ(file.face_data[1].values, entity.values);
    EXPECT_EQ(write_msh(file.points, faces_of(file), version, file.face_data), text) << "a fixed point";
  }
}

TEST(Msh, EntitiesAreNumberedAnewWhereTheyDoNotFitTheGroups) {
  const test::Triangles t = test::cube();
  FaceChannel group{group_channel, std::vector<int>(12, 1)}, entity{entity_channel, std::vector<int>(12, 4)};
  group.values[5] = 2;  // a second group in entity 4
  for (const MeshFormat version : versions) {
    const MeshFile file = read_msh(write_msh(t.points, t.faces, version, {group, entity}), "m");
    EXPECT_EQ(file.face_data[0].values, group.values);
    EXPECT_NE(file.face_data[1].values[5], file.face_data[1].values[4]);
  }
}

TEST(Msh, NodesMayHaveAnyNumbersAndOthersAreCounted) {
  const MeshFile file = read_msh(old_text, "m");
  EXPECT_EQ(file.format, MeshFormat::msh2);
  EXPECT_EQ(file.points.cols(), 4);
  EXPECT_EQ(faces_of(file), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(file.lines, (std::vector<int>{21, 22}));
  ASSERT_EQ(file.face_data.size(), 2u);
  EXPECT_EQ(file.face_data[0].values, (std::vector<int>{7, 0}));
  EXPECT_EQ(file.face_data[0].names, (std::map<int, std::string>{{7, "the \"wall\""}}));
  EXPECT_EQ(file.face_data[1].values, (std::vector<int>{4, 5}));
  ASSERT_EQ(file.content.anew.size(), 1u);
  EXPECT_EQ(file.content.anew[0].message,
            "m: not kept in the output: 1 lines, 1 points, 1 nodes of no triangle");
}

TEST(Msh, QuadranglesArePolygons) {
  const MeshFile file = read_msh(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n9 0 0 0 1 1 0 2 6 5 0\n$EndEntities\n"
      "$Nodes\n2 4 1 90\n2 9 1 2\n90\n2\n0 0 0 .5 .5\n1 0 0 .5 .5\n2 9 0 2\n4\n1\n1 1 0\n0 1 0\n$EndNodes\n"
      "$Elements\n1 1 1 1\n2 9 3 1\n1 90 2 4 1\n$EndElements\n$NodeData\nwhatever\n$EndNodeData\n",
      "m");
  EXPECT_EQ(file.polygons[0].size(), 4u);
  EXPECT_EQ(file.points.col(2), Vec3(1, 1, 0));
  EXPECT_EQ(file.face_data[0].values, std::vector<int>{6});
  ASSERT_EQ(file.content.anew.size(), 1u);
  EXPECT_TRUE(
      has(file.content.anew[0].message, "all physical groups but the first of 1 faces, section '$NodeData'"));
}

TEST(Msh, BinaryFilesOfBothByteOrders) {
  for (const bool swapped : {false, true}) {
    Binary file{swapped};
    file.text("$MeshFormat\n4.1 1 8\n")
        .ints({1})
        .text("\n$EndMeshFormat\n$Entities\n")
        .sizes({0, 0, 1, 0})
        .ints({9});
    file.reals({0, 0, 0, 1, 1, 0}).sizes({1}).ints({6}).sizes({0}).text("\n$EndEntities\n$Nodes\n");
    file.sizes({1, 3, 10, 12}).ints({2, 9, 0}).sizes({3, 10, 12, 11}).reals({0, 0, 0, 1, 0, 0, 0, 1, 0});
    file.text("\n$EndNodes\n$Elements\n").sizes({1, 1, 5, 5}).ints({2, 9, 2}).sizes({1, 5, 12, 11, 10});
    const MeshFile mesh = read_msh(file.text("\n$EndElements\n").bytes, "m");
    EXPECT_EQ(faces_of(mesh), (std::vector<Triangle>{{1, 2, 0}}));
    EXPECT_EQ(mesh.points.col(2), Vec3(0, 1, 0));
    EXPECT_EQ(mesh.face_data[0].values, std::vector<int>{6});

    Binary old{swapped};
    old.text("$MeshFormat\n2.2 1 8\n").ints({1}).text("\n$EndMeshFormat\n$Nodes\n3\n");
    for (const int n : {10, 12, 11}) old.ints({n}).reals({n == 12 ? 1. : 0., n == 11 ? 1. : 0., 0});
    old.text("\n$EndNodes\n$Elements\n3\n")
        .ints({15, 2, 1, 1, 0, 10, 2, 0, 11})
        .ints({2, 1, 2, 3, 6, 9, 12, 11, 10});
    const MeshFile same = read_msh(old.text("\n$EndElements\n").bytes, "m");
    EXPECT_EQ(same.points, mesh.points);
    EXPECT_EQ(faces_of(same), faces_of(mesh));
    EXPECT_EQ(same.face_data[1].values, std::vector<int>{9});
  }
}

TEST(Msh, EveryTruncatedFileIsRefused) {
  const test::Triangles t = test::cube();
  for (const std::string& text : {write_msh(t.points, t.faces), old_text})
    for (size_t size = 1; size + 1 < text.size(); ++size)
      EXPECT_THROW(read_msh(std::string_view(text).substr(0, size), "m"), Error) << size;
}

TEST(Msh, ErrorsNameThePlace) {
  const auto error = [](std::string text, const std::string& old_part, const std::string& new_part) {
    const size_t at = text.find(old_part);
    text.replace(at, old_part.size(), new_part);
    std::string message = test::message_of<InputError>([&] { read_msh(text, "m"); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  };
  EXPECT_TRUE(has(error(old_text, "2.2", "4.0"), "m:2: version '4.0' of the format; expected 2.2 or 4.1"));
  EXPECT_TRUE(has(error(old_text, "2.2 0 8", "2.2 1 8"), "instead of the number 1"));
  EXPECT_TRUE(has(error(old_text, "900 1 0 0", "900 1 nan 0"), "m:12: y is 'nan'"));
  EXPECT_TRUE(has(error(old_text, "900 1 0 0", "10 1 0 0"), "m:12: a second node 10"));
  EXPECT_TRUE(has(error(old_text, "10 3 77", "10 3 78"), "m:22: polygon 1 has node 78"));
  EXPECT_TRUE(has(error(old_text, "8 2 3", "8 200 3"), "m:22: element type 200"));
  EXPECT_TRUE(has(error(old_text, "$Nodes\n5", "$Nodes\n6"), "node number is '$EndNodes'"));
  EXPECT_TRUE(has(error(old_text, "$Nodes\n5", "$Nodes\n4"), "'5'; expected $EndNodes"));
  EXPECT_TRUE(has(error(old_text, "$Nodes\n5", "$Nodes\n99999999999"), "only"));
  EXPECT_TRUE(
      has(error(old_text, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", ""), "expected $MeshFormat first"));
  EXPECT_TRUE(has(error(old_text, "$MeshFormat", "5 2 4\n0 0 1\n$MeshFormat"),
                  "m:1: '5'; expected $MeshFormat first, as in a file of Gmsh"));
  const std::string no_faces = old_text.substr(0, old_text.find("3 2 2 7")) + "$EndElements\n";
  EXPECT_TRUE(has(error(no_faces, "$Elements\n4", "$Elements\n2"), "m: no triangles, but 1 lines, 1 points"));
}

}  // namespace hooke::msh_test
