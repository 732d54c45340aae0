#include "hooke/io/obj.h"

#include <gtest/gtest.h>

#include "errors.h"
#include "hooke/error.h"

namespace hooke {
namespace {

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

MeshFile read(const std::string& text) {
  return read_obj(text, "m.obj");
}

std::vector<int> corners(const std::string& faces) {
  return read(three + faces).polygons.items;
}

std::string not_kept(const std::string& text) {
  const Warnings warnings = read(text).warnings;
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
  EXPECT_TRUE(file.warnings.empty());
}

TEST(Obj, CornerFormsNameTheSameVertices) {
  const std::string extra = "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
  const std::vector expected{0, 1, 2};
  EXPECT_EQ(corners("f 1 2 3"), expected);
  EXPECT_EQ(corners("f -3 -2 -1"), expected);
  EXPECT_EQ(corners(extra + "f 1/1 2/2 3/3"), expected);
  EXPECT_EQ(corners(extra + "f 1//1 2//-1 3//1"), expected);
  EXPECT_EQ(corners(extra + "f 1/1/1 2/-2/1 3/3/1"), expected);
  EXPECT_EQ(corners("f 1 \\\n 2 \\\r\n 3"), expected);
}

TEST(Obj, NegativeIndicesCountFromWhereTheyStandAndPositiveOnesMayPointForward) {
  EXPECT_EQ(corners("f -3 -2 -1\nv 5 5 5\nf -3 -2 -1"), (std::vector{0, 1, 2, 1, 2, 3}));
  EXPECT_EQ(corners("f 1 2 4\nv 5 5 5"), (std::vector{0, 1, 3}));
}

TEST(Obj, SaysWhatIsNotKept) {
  EXPECT_EQ(
      not_kept(three + "vt 0 0\nvn 0 0 1\ng a\no b\ns 1\nusemtl x\nmtllib y\nl 1 2\np 1\nfrob 1\nf 1 2 3"),
      "m.obj: not kept in the output: texture coordinates, normals, groups, objects, smoothing groups, "
      "materials, lines, points, 'frob' statements (line 13)");
  EXPECT_EQ(not_kept("v 0 0 0 1 .5 0\nv 1 0 0\nv 0 1 0 1 .5 0\nf 1 2 3"),
            "m.obj: not kept in the output: vertex colours");
  EXPECT_EQ(not_kept(three + "s off\nf 1 2 3"), "");
}

TEST(Obj, KeepsTheColoursOfVertices) {
  const std::string text = "v 0 0 0 1 0.5 0\nv 1 0 0 0.25 0.5 0\nv 0 1 0 0 0.5 1\nf 1 2 3\n";
  const MeshFile file = read(text);
  EXPECT_TRUE(file.warnings.empty());
  ASSERT_EQ(file.vertex_data.size(), 3u);
  EXPECT_EQ(file.vertex_data[0].values, (std::vector<double>{1, .25, 0}));
  EXPECT_EQ(write_obj(file.points, {{0, 1, 2}}, file.vertex_data), text);
}

TEST(Obj, ErrorsNameTheLine) {
  EXPECT_ERROR(InputError, "m.obj:2: z is missing", read("v 0 0 0\nv 1 0\n"));
  EXPECT_ERROR(InputError, "m.obj:1: x is 'nan'", read("v nan 0 0\n"));
  EXPECT_ERROR(InputError, "m.obj:1: y is '1e400'", read("v 0 1e400 0\n"));
  EXPECT_ERROR(InputError, "m.obj:1: vertex weight w is 2", read("v 0 0 0 2\n"));
  EXPECT_ERROR(InputError, "m.obj:1: vertex with 5 numbers", read("v 0 0 0 1 1\n"));
  EXPECT_ERROR(InputError, "m.obj:4: face with 2 corners", read(three + "f 1 2"));
  EXPECT_ERROR(InputError, "m.obj:4: face with 0 corners", read(three + "f"));
  EXPECT_ERROR(InputError, "m.obj:4: vertex index 0", read(three + "f 0 1 2"));
  EXPECT_ERROR(InputError, "m.obj:4: vertex index 4; expected at most 3", read(three + "f 1 2 4\nf 1 2 3"));
  EXPECT_ERROR(InputError, "m.obj:4: vertex index -4", read(three + "f -4 1 2"));
  EXPECT_ERROR(InputError, "m.obj:4: vertex index 4294967297", read(three + "f 4294967297 2 3"));
  EXPECT_ERROR(InputError, "m.obj:4: texture coordinate index 1", read(three + "f 1/1 2/1 3/1"));
  EXPECT_ERROR(InputError, "m.obj:4: normal index 1", read(three + "f 1//1 2//1 3//1"));
  for (const char* corner : {"f", "1.5", "/1", "1/", "1//", "1/1/", "1/1/1/1"})
    EXPECT_ERROR(InputError, "m.obj:5: face corner '" + std::string(corner) + "'",
                 read(three + "vt 0 0\nf 2 3 " + corner + "\nvn 0 0 1\n"));
  EXPECT_ERROR(InputError, "m.obj: no vertices", read("hello\n"));
}

TEST(Obj, WritesWhatItReads) {
  EXPECT_EQ(write_obj(read(three + "f 1 2 3").points, {{0, 1, 2}}), three + "f 1 2 3\n");
}

}  // namespace
}  // namespace hooke
