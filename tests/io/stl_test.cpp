#include "hooke/io/stl.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "hooke/core/error.h"
#include "support/errors.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::stl_test {

using test::has;

std::vector<Triangle> faces_of(const MeshFile& file) {
  std::vector<Triangle> faces;
  for (int f = 0; f + 1 < static_cast<int>(file.polygons.first.size()); ++f)
    faces.push_back({file.polygons[f][0], file.polygons[f][1], file.polygons[f][2]});
  return faces;
}

// The mesh with its vertices numbered as the corners of its faces meet them first.
test::Triangles in_order_of_corners(const test::Triangles& t) {
  std::vector<int> number(t.points.cols(), -1);
  test::Triangles result{Mat3X(3, t.points.cols()), t.faces};
  int next = 0;
  for (Triangle& face : result.faces)
    for (int& v : face) {
      int& fresh = number[v];
      if (fresh < 0) {
        result.points.col(next) = t.points.col(v);
        fresh = next++;
      }
      v = fresh;
    }
  return result;
}

// A binary file with this header, count and facets.
std::string binary(std::string header, std::uint32_t count, const std::vector<std::array<float, 9>>& facets) {
  header.resize(80, '\0');
  const auto append = [&](auto value) {
    const auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
    header.append(raw.data(), raw.size());
  };
  append(count);
  for (const auto& facet : facets) {
    append(std::array<float, 3>{});
    append(facet);
    append(std::uint16_t{0});
  }
  return header;
}

const std::array<float, 9> facet = {0, 0, 0, 1, 0, 0, 0, 1, 0};
const std::string corners = "outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n";
const std::string text_facet = "facet normal 0 0 1\n" + corners + "endfacet\n";

TEST(Stl, TextReturnsEveryBitOfTheMesh) {
  const test::Triangles t = in_order_of_corners(test::shuffled(test::sphere(2, .2)));
  const MeshFile file = read_stl(write_stl(t.points, t.faces, PlyEncoding::ascii), "m");
  EXPECT_EQ(file.points, t.points);
  EXPECT_EQ(faces_of(file), t.faces);
  EXPECT_EQ(file.encoding, PlyEncoding::ascii);
  EXPECT_EQ(file.format, MeshFormat::stl);
  EXPECT_TRUE(file.warnings.empty());
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_EQ(file.notes[0].message, "m: 960 corners of facets are 162 different points, its vertices");
}

TEST(Stl, BinaryFilesHoldTheNearestFloats) {
  const test::Triangles t = in_order_of_corners(test::sphere(2, .2));
  const std::string bytes = write_stl(t.points, t.faces, PlyEncoding::binary_little_endian);
  EXPECT_EQ(bytes.size(), 84 + 50 * t.faces.size());
  const MeshFile file = read_stl(bytes, "m");
  EXPECT_EQ(file.points, t.points.cast<float>().cast<double>());
  EXPECT_EQ(faces_of(file), t.faces);
  EXPECT_TRUE(write_stl(file.points, t.faces, file.encoding) == bytes) << "a fixed point";
}

TEST(Stl, NormalsAreThoseOfTheFacets) {
  const test::Triangles t = test::sphere(1);
  const std::string bytes = write_stl(t.points, t.faces, PlyEncoding::binary_little_endian);
  for (size_t f = 0; f < t.faces.size(); ++f) {
    std::array<float, 3> n;
    std::memcpy(n.data(), bytes.data() + 84 + 50 * f, sizeof n);
    const Vec3 normal(n[0], n[1], n[2]);
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
    EXPECT_GT(normal.dot(t.points.col(t.faces[f][0])), .8);
  }
  const Mat3X flat = Mat3X::Ones(3, 3);
  EXPECT_TRUE(has(write_stl(flat, {{0, 1, 2}}, PlyEncoding::ascii), "facet normal 0 0 0\n"));
}

TEST(Stl, ABinaryFileMayBeginWithTheWordSolid) {
  for (const char* header : {"solid", "solid part\n", "SOLID x facet normal", "OFF", "ply", "v 0 0 0\n"}) {
    const MeshFile file = read_stl(binary(header, 1, {facet}), "m");
    EXPECT_EQ(file.encoding, PlyEncoding::binary_little_endian) << header;
    EXPECT_EQ(file.points.cols(), 3);
  }
  EXPECT_EQ(parse_mesh_file(binary("v 0 0 0\n", 1, {facet}), "m", MeshFormat::stl).points.cols(), 3);
}

TEST(Stl, WordsInAnyCaseAndOnAnyLine) {
  for (const std::string& text :
       {std::string("solid\n" + text_facet + "endsolid\n"),
        std::string("  SOLID A B\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0 VERTEX "
                    "1 0 0\rVertex 0 1 0\nENDLOOP ENDFACET\nENDSOLID A B"),
        std::string("solid x\nfacet normal nan -nan(ind) 1e999\n" + corners + "endfacet\nendsolid x\n\n")}) {
    const MeshFile file = read_stl(text, "m");
    EXPECT_EQ(file.points.cols(), 3) << text;
    EXPECT_EQ(file.encoding, PlyEncoding::ascii);
  }
}

TEST(Stl, SeveralSolidsAreGroupsWithTheirNames) {
  const std::string other =
      "facet normal 0 0 1\nouter loop\nvertex 5 0 0\nvertex 6 0 0\nvertex 5 1 0\nendloop\nendfacet\n";
  const std::string text =
      "solid first part\n" + text_facet + other + "endsolid\nsolid\n" + other + "endsolid\n";
  const MeshFile file = read_stl(text, "m");
  EXPECT_EQ(file.points.cols(), 6);
  EXPECT_EQ(file.lines, (std::vector<int>{2, 9, 18}));
  ASSERT_EQ(file.face_data.size(), 1u);
  EXPECT_EQ(file.face_data[0].name, group_channel);
  EXPECT_EQ(file.face_data[0].values, (std::vector<int>{1, 1, 2}));
  EXPECT_EQ(file.face_data[0].names, (std::map<int, std::string>{{1, "first part"}}));
  const std::string written = write_stl(file.points, faces_of(file), PlyEncoding::ascii, file.face_data);
  EXPECT_TRUE(has(written, "solid first part\n"));
  EXPECT_TRUE(has(written, "endsolid group_2\n"));
  EXPECT_EQ(read_stl(written, "m").face_data[0].values, file.face_data[0].values);
}

TEST(Stl, TheHeaderComesBackUnlessItWouldPassForText) {
  for (const std::string start : {"COLOR=\x1\x2\x3\x4,MATERIAL=", "solid of another program", " SOLID"}) {
    std::string bytes = binary("", 1, {facet});
    bytes.replace(0, start.size(), start);
    const MeshFile file = read_stl(bytes, "m");
    const std::string written = write_stl(file.points, faces_of(file), file.encoding, {}, file.stl_header);
    EXPECT_EQ(written.substr(0, 80) == bytes.substr(0, 80), start[0] == 'C');
    EXPECT_TRUE(written.starts_with(start[0] == 'C' ? start : "binary STL  "));
  }
}

TEST(Stl, BothZerosAreOneVertexAndTheFirstIsKept) {
  const MeshFile file =
      read_stl(binary("", 2, {{-0.f, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 0, -0.f, 0, 1, 1, 0}}), "m");
  EXPECT_EQ(faces_of(file), (std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}}));
  EXPECT_TRUE(std::signbit(file.points(0, 0)));
}

TEST(Stl, DegenerateFacetsStayForTheValidation) {
  const MeshFile file = read_stl(binary("", 2, {facet, {0, 0, 0, 0, 0, 0, 1, 0, 0}}), "m");
  EXPECT_EQ(faces_of(file), (std::vector<Triangle>{{0, 1, 2}, {0, 0, 1}}));
}

TEST(Stl, AttributesOfFacetsComeBack) {
  std::string bytes = binary("", 2, {facet, {1, 0, 0, 1, 1, 0, 0, 1, 0}});
  EXPECT_TRUE(read_stl(bytes, "m").face_data.empty());
  bytes[84 + 48] = 5;
  bytes[84 + 50 + 49] = static_cast<char>(0x80);
  const MeshFile file = read_stl(bytes, "m");
  ASSERT_EQ(file.face_data.size(), 1u);
  EXPECT_EQ(file.face_data[0].values, (std::vector<int>{5, 0x8000}));
  const std::string written = write_stl(file.points, faces_of(file), file.encoding, file.face_data);
  EXPECT_EQ(read_stl(written, "m").face_data[0].values, file.face_data[0].values);
}

TEST(Stl, ErrorsNameThePlace) {
  const auto error = [](const std::string& bytes) {
    std::string message = test::message_of<InputError>([&] { read_stl(bytes, "m"); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  };
  EXPECT_TRUE(has(error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"), "m:4: z is 'x'"));
  EXPECT_TRUE(has(error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n"), "m:4: z is 'nan'"));
  EXPECT_TRUE(
      has(error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0"), "m:4: the file ends; expected z"));
  EXPECT_TRUE(
      has(error("solid\n" + text_facet), "the file ends; expected facet or endsolid; it is truncated"));
  EXPECT_TRUE(has(error("solid\n" + text_facet + "endsolid\nxyz\n"), "'xyz'; expected solid"));
  EXPECT_TRUE(has(error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
                  "m:6: 'endloop'; expected vertex"));
  EXPECT_TRUE(has(error(std::string(64, '\0')), "m: 64 bytes; expected at least 84"));
  EXPECT_TRUE(has(error(binary("solid", 2, {facet})), "m: 134 bytes; expected 184 for the 2 facets"));
  EXPECT_TRUE(has(error(binary("", 0xffffffff, {facet})), "is truncated"));
  EXPECT_TRUE(has(error(binary("", 1, {facet, facet})), "the count or the end is wrong"));
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(has(error(binary("", 2, {facet, {0, 0, 0, 1, inf, 0, 0, 1, 0}})),
                  "m: facet 1, byte 162: a coordinate is inf"));
}

TEST(Stl, WhatDoesNotFitIsToldOrRefused) {
  Mat3X far(3, 4);
  far << 1, 2, 1, 1 + 1e-12, 0, 0, 1, 0, 0, 0, 0, 0;
  const std::vector<Triangle> faces = {{0, 1, 2}, {3, 2, 1}};
  const auto codes = [&](PlyEncoding encoding, const std::vector<Triangle>& some) {
    std::vector<std::string> found;
    for (const Warning& w : losses_in_stl(far, some, encoding, "m")) found.push_back(w.code);
    return found;
  };
  EXPECT_EQ(codes(PlyEncoding::ascii, faces), std::vector<std::string>{});
  EXPECT_EQ(codes(PlyEncoding::binary_little_endian, faces), std::vector<std::string>{"vertices_coincide"});
  EXPECT_EQ(codes(PlyEncoding::ascii, {{0, 1, 2}}), std::vector<std::string>{"attributes_not_kept"});
  far(0, 1) = 1e39;
  EXPECT_THROW(write_stl(far, faces, PlyEncoding::binary_little_endian), OutputError);
  EXPECT_NO_THROW(write_stl(far, faces, PlyEncoding::ascii));
}

TEST(Stl, FacesThatRoundingTurnsOverAreTold) {
  Mat3X thin(3, 3);  // a unit in the last place of a float near 1e6 is 1/16
  thin << 1e6, 1e6 + 10, 1e6 + 5, 0, 0, 0, 1e6, 1e6, 1e6 + .01;
  const Warnings told = losses_in_stl(thin, {{0, 1, 2}}, PlyEncoding::binary_little_endian, "m");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, "faces_turned_by_rounding");
  EXPECT_TRUE(losses_in_stl(thin, {{0, 1, 2}}, PlyEncoding::ascii, "m").empty());
}

}  // namespace hooke::stl_test
