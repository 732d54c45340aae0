#include "hooke/io/obj.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "support/errors.h"

namespace hooke::obj_test {

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

MeshFile read(const std::string& text) {
  return read_obj(text, "m.obj");
}

std::vector<int> corners(const std::string& faces) {
  return read(three + faces).polygons.items;
}

std::string not_kept(const std::string& text) {
  const Warnings warnings = read(text).content.anew;
  if (warnings.size() != 1) return "";
  EXPECT_EQ(warnings[0].code, "attributes_not_kept");
  return warnings[0].message;
}

TEST(Obj, ReadsVerticesAndFacesInFileOrder) {
  const MeshFile file =
      read("# c\nv 0 .5 -1e-3\n\nv\t+1 2 3 1.0\r\nv 4 5 6\nv 7 8 9\nf 1 2 3\nf 1 3 4 2 # c\n");
  EXPECT_EQ(file.points.cols(), 4);
  EXPECT_EQ(Vec3(file.points.col(0)), Vec3(0, .5, -1e-3));
  EXPECT_EQ(Vec3(file.points.col(1)), Vec3(1, 2, 3));
  EXPECT_EQ(file.polygons.items, (std::vector{0, 1, 2, 0, 2, 3, 1}));
  EXPECT_EQ(file.polygons.first, (std::vector{0, 3, 7}));
  EXPECT_EQ(file.lines, (std::vector{7, 8}));
  EXPECT_TRUE(file.content.anew.empty());
}

TEST(Obj, CornerFormsNameTheSameVertices) {
  const std::string extra = "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
  const std::vector expected{0, 1, 2};
  EXPECT_EQ(corners("f 1 2 3"), expected);
  EXPECT_EQ(corners("f -3 -2 -1"), expected);
  EXPECT_EQ(corners(extra + "f 1/1 2/2 3/3"), expected);
  EXPECT_EQ(corners(extra + "f 1//1 2//-1 3//1"), expected);
  EXPECT_EQ(corners(extra + "f 1/1/1 2/-2/1 3/3/1"), expected);
  EXPECT_EQ(corners(extra + "f 1/ 2/2/ 3//"), expected);  // as some programs write what they have not
  EXPECT_EQ(corners("f 1 \\\n 2 \\\r\n 3"), expected);
}

TEST(Obj, NegativeIndicesCountFromWhereTheyStandAndPositiveOnesMayPointForward) {
  EXPECT_EQ(corners("f -3 -2 -1\nv 5 5 5\nf -3 -2 -1"), (std::vector{0, 1, 2, 1, 2, 3}));
  EXPECT_EQ(corners("f 1 2 4\nv 5 5 5"), (std::vector{0, 1, 3}));
}

TEST(Obj, SaysWhatIsNotKept) {
  EXPECT_EQ(
      not_kept(three + "vt 0 0\nvn 0 0 1\ng a\no b\ns 1\nusemtl x\nmtllib y\nl 1 2\np 1\nfrob 1\nf 1 2 3"),
      "m.obj: not kept in the output: texture coordinates, normals, lines, points, 'frob' statements (line "
      "13)");
  EXPECT_EQ(not_kept("v 0 0 0 1 .5 0\nv 1 0 0\nv 0 1 0 1 .5 0\nf 1 2 3"),
            "m.obj: not kept in the output: vertex colours");
  EXPECT_EQ(not_kept(three + "s off\nf 1 2 3"), "");
}

TEST(Obj, KeepsTheColoursOfVertices) {
  const std::string text = "v 0 0 0 1 0.5 0\nv 1 0 0 0.25 0.5 0\nv 0 1 0 0 0.5 1\nf 1 2 3\n";
  const MeshFile file = read(text);
  EXPECT_TRUE(file.content.anew.empty());
  ASSERT_EQ(file.vertex_data.size(), 3u);
  EXPECT_EQ(file.vertex_data[0].values, (std::vector<double>{1, .25, 0}));
  EXPECT_EQ(write_obj(file.points, {{0, 1, 2}}, file.vertex_data), text);
}

const std::string texture = "vt 0 0.5\nvt 0.25 1\nvt 0.125 -2\n";

TEST(Obj, WritesTheTextureCoordinatesAndNormalsOfVerticesAsItReadThem) {
  const std::string normals = "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\n", deep = "vt 1 2 3\nvt 0 0 1\nvt 3 2 1\n";
  for (const std::string& text :
       {three + texture + "f 1/1 2/2 3/3\n", three + normals + "f 1//1 2//2 3//3\n",
        three + texture + normals + "f 1/1/1 2/2/2 3/3/3\n", three + deep + "f 1/1 2/2 3/3\n",
        three + "vt 1\nvt 0\nvt 7\nf 1/1 2/2 3/3\n"}) {
    const MeshFile file = read(text);
    EXPECT_TRUE(file.content.anew.empty()) << text;
    EXPECT_EQ(write_obj(file.points, {{0, 1, 2}}, file.vertex_data), text);
  }
}

TEST(Obj, TextureCoordinatesGoToTheVerticesThatReferToThem) {
  const MeshFile file = read("vt 9 9\n" + three + "v 1 1 0\nvt 0.5 1\nvt 0.25 1 7\nf 1/-1 2/2 3/-3\n");
  ASSERT_EQ(file.vertex_data.size(), 3u) << "as many numbers as the longest has";
  EXPECT_EQ(file.vertex_data[0].values, (std::vector<double>{.25, .5, 9, 0})) << "0 for a vertex in no face";
  EXPECT_EQ(file.vertex_data[2].values, (std::vector<double>{7, 0, 0, 0}));
}

TEST(Obj, EqualTextureCoordinatesAreNoSeam) {
  const std::string text = "v 1 1 0\n" + texture + "vt 0.250 1e0\nvt 0 0\nf 1/1 2/2 3/3\nf 2/4 1/1 4/5\n";
  EXPECT_TRUE(read(three + text).content.anew.empty());
}

TEST(Obj, SeamsAndHardEdgesAreNamed) {
  const std::string square = three + "v 1 1 0\n";
  const Warnings seam = read(square + texture + "vt 7 7\nf 1/1 2/2 3/3\nf 4/1 3/3 2/4\n").content.no_obj;
  ASSERT_EQ(seam.size(), 1u);
  EXPECT_EQ(seam[0].code, "texture_seams");
  EXPECT_EQ(seam[0].message,
            "m.obj: not kept in the output: texture coordinates, because of seams (edges: 1; vertices with "
            "several vt: 1, numbers 2); to keep them write an OBJ, or cut the mesh open there, so that each "
            "vertex has one vt");
  const MeshFile hard = read(square + "vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 4//2 3//2 2//2\ng x\n");
  EXPECT_TRUE(hard.vertex_data.empty());
  ASSERT_EQ(hard.content.no_obj.size(), 1u);
  EXPECT_EQ(hard.content.no_obj[0].code, "hard_edges");
  EXPECT_EQ(
      hard.content.no_obj[0].message,
      "m.obj: not kept in the output: normals, because of hard edges (edges: 1; vertices with several vn: "
      "2, numbers 2 3); to keep them write an OBJ, or cut the mesh open there, so that each vertex has one "
      "vn");
  EXPECT_TRUE(hard.content.anew.empty());
  EXPECT_EQ(hard.normals.corners, (std::vector{0, 0, 0, 1, 1, 1}));
}

TEST(Obj, OfManySeamVerticesSomeAreNamed) {
  std::string text = "vt 0 0\nvt 1 1\nv 0 0 0\n";
  for (int k = 0; k < 11; ++k) text += "v 0 0 1\n";
  for (int k = 2; k < 12; ++k) text += fmt::format("f 1/1 {}/1 {}/2\n", k, k + 1);
  const std::string warning = read(text).content.no_obj.at(0).message;
  EXPECT_TRUE(test::has(warning, "several vt: 9, numbers 3 4 5 6 7 8 9 10 11)")) << warning;
  EXPECT_TRUE(test::has(read(text + "f 12/1 1/1 2/2\n").content.no_obj.at(0).message,
                        ": 11, numbers 2 3 4 5 6 7 8 9 10 11 ...)"));
}

TEST(Obj, TextureCoordinatesAndNormalsThatAreNotForAllOrBrokenAreNamed) {
  const std::string start = "m.obj: not kept in the output: ";
  const auto partly = [](const std::string& text) { return read(text).content.no_obj.at(0).message; };
  EXPECT_EQ(partly(three + texture + "f 1/1 2/2 3"),
            start + "texture coordinates (1 of 3 face corners have none)");
  EXPECT_EQ(partly(three + texture + "f 1 2 3\nv 0 0 1\nf 1/1 2/2 4/3"),
            start + "texture coordinates (3 of 6 face corners have none)");
  for (const char* broken : {"vt", "vt 0 nan", "vt 1 2 3 4", "vt 0 1e999", "vt a"})
    EXPECT_EQ(not_kept(three + texture + broken + "\nf 1/1 2/2 3/3"),
              start + "texture coordinates (line 7; expected 1 to 3 finite numbers)");
  for (const char* broken : {"vn 0 1", "vn -nan(ind) 0 0", "vn 0 0 0 1"})
    EXPECT_EQ(not_kept(three + broken + "\nvn\nf 1//1 2//1 3//1"),
              start + "normals (line 4; expected 3 finite numbers)");
  EXPECT_EQ(not_kept("v 0 0 0 1 1 1\nv 1 0 0 1 1 1 1\nv 0 1 0\nf 1 2 3"), start + "vertex colours");
}

TEST(Obj, LabelsOfFacesGoOnFromStatementToStatement) {
  const MeshFile file = read(three +
                             "f 1 2 3\ng left  arm # a comment\nf 1 2 3\nusemtl skin\ns 4\nf 1 2 3\ng other\n"
                             "f 1 2 3\ns off\ng left  arm\nf 1 2 3\nmtllib a.mtl b.mtl\n");
  ASSERT_EQ(file.face_data.size(), 3u);
  EXPECT_EQ(file.face_data[0].name, group_channel);
  EXPECT_EQ(file.face_data[0].values, (std::vector{0, 1, 1, 2, 1}));
  EXPECT_EQ(file.face_data[0].names, (std::map<int, std::string>{{1, "left  arm"}, {2, "other"}}));
  EXPECT_EQ(file.face_data[1].name, material_channel);
  EXPECT_EQ(file.face_data[1].values, (std::vector{0, 0, 1, 1, 1}));
  EXPECT_EQ(file.face_data[2].name, smoothing_channel);
  EXPECT_EQ(file.face_data[2].values, (std::vector{0, 0, 4, 4, 0}));
  EXPECT_EQ(file.material_libraries, std::vector<std::string>{"a.mtl b.mtl"});
}

TEST(Obj, DataOfFacesAndCornersAreWrittenAsTheyWereRead) {
  const std::string text = "mtllib a.mtl\n" + three + "v 1 1 0\n" + texture +
                           "vt 7 7.5\nvn 0 0 1\nvn 0 1 0\no Thing\ng left\nusemtl skin\nf 1/1/1 2/2/1 3/3/1\n"
                           "g right\ns 3\nf 4/1/2 3/3/2 2/4/2\ng left\ns off\nf 1//1 2//1 3//1\n";
  const MeshFile file = read(text);
  const auto values = [](const PolygonCorners& c, std::vector<Triangle> corners) {
    return CornerValues{c.values, c.width, std::move(corners)};
  };
  const CornerData corners{values(file.texture, {{0, 1, 2}, {0, 2, 3}, {-1, -1, -1}}),
                           values(file.normals, {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}})};
  EXPECT_EQ(write_obj(file.points, {{0, 1, 2}, {3, 2, 1}, {0, 1, 2}},
                      ObjData{file.vertex_data, file.face_data, corners, file.material_libraries}),
            text);
}

TEST(Obj, FacesWithFewerThanThreeCornersUseAVertexTwice) {
  const MeshFile file = read(three + "vt .5 0\nvt 0 .5\nf 1/1 2/2\nf 3\nf 1 2 3\n");
  EXPECT_EQ(file.polygons.items, (std::vector<int>{0, 1, 1, 2, 2, 2, 0, 1, 2}));
  EXPECT_EQ(file.texture.corners, (std::vector<int>{0, 1, -1, -1, -1, -1, -1, -1, -1}));
  EXPECT_EQ(file.lines, (std::vector<int>{6, 7, 8}));
}

TEST(Obj, ErrorsNameTheLine) {
  EXPECT_ERROR(InputError, "m.obj:2: z is missing", read("v 0 0 0\nv 1 0\n"));
  EXPECT_ERROR(InputError, "m.obj:1: x is 'nan'", read("v nan 0 0\n"));
  EXPECT_ERROR(InputError, "m.obj:1: y is '1e400'", read("v 0 1e400 0\n"));
  EXPECT_ERROR(InputError, "m.obj:1: vertex weight w is 2", read("v 0 0 0 2\n"));
  EXPECT_ERROR(InputError, "m.obj:1: vertex with 5 numbers", read("v 0 0 0 1 1\n"));
  EXPECT_ERROR(InputError, "m.obj:4: face with 0 corners", read(three + "f"));
  EXPECT_ERROR(InputError, "m.obj:4: vertex index 0", read(three + "f 0 1 2"));
  EXPECT_ERROR(InputError, "m.obj:4: vertex index 4; expected at most 3", read(three + "f 1 2 4\nf 1 2 3"));
  EXPECT_ERROR(InputError, "m.obj:4: vertex index -4", read(three + "f -4 1 2"));
  EXPECT_ERROR(InputError, "m.obj:4: vertex index 4294967297", read(three + "f 4294967297 2 3"));
  EXPECT_ERROR(InputError, "m.obj:4: texture coordinate index 1", read(three + "f 1/1 2/1 3/1"));
  EXPECT_ERROR(InputError, "m.obj:4: normal index 1", read(three + "f 1//1 2//1 3//1"));
  for (const char* corner : {"f", "1.5", "/1", "1/x", "1/1/1/1"})
    EXPECT_ERROR(InputError, "m.obj:5: face corner '" + std::string(corner) + "'",
                 read(three + "vt 0 0\nf 2 3 " + corner + "\nvn 0 0 1\n"));
  EXPECT_ERROR(InputError, "m.obj: no vertices", read("hello\n"));
}

TEST(Obj, WritesWhatItReads) {
  EXPECT_EQ(write_obj(read(three + "f 1 2 3").points, {{0, 1, 2}}), three + "f 1 2 3\n");
}

}  // namespace hooke::obj_test
