#include "hooke/io/off.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "support/errors.h"

namespace hooke::off_test {

const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

MeshFile read(const std::string& text) {
  return read_off(text, "m.off");
}

void expect_the_triangle(const std::string& text) {
  const MeshFile file = read(text);
  EXPECT_EQ(file.points.cols(), 3) << text;
  EXPECT_EQ(Vec3(file.points.col(1)), Vec3(1, 0, 0)) << text;
  EXPECT_EQ(file.polygons.items, (std::vector{0, 1, 2})) << text;
  EXPECT_TRUE(file.content.anew.empty()) << text;
}

TEST(Off, DialectsOfTheHeaderAreTheSameMesh) {
  for (const char* header : {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF\n3 1\n", "off\r\n3 1 0\r\n", "3 1 0\n",
                             "\n# c\nOFF # c\n# c\n\n3 1 0 # c\n"})
    expect_the_triangle(header + body);
}

const std::vector<Triangle> triangle = {{0, 1, 2}};

TEST(Off, WritesTheNumbersOfVerticesAsItReadThem) {
  const std::string face = "3 0 1 2\n";
  for (const std::string& text :
       {"COFF\n3 1 0\n0 0 0 9 8 7 255\n1 0 0 0 1 2 3\n0 1 0 9 9 9 9\n" + face,
        "COFF\n3 1 0\n0 0 0 0.5 1 0\n1 0 0 0 0.25 0.3\n0 1 0 0.1 0.2 0.3\n" + face,
        "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0.6 0.8\n0 1 0 0 0 1\n" + face,
        "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 0 1e-20\n0 1 0 -0.3 1\n" + face,
        "STCNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 5 6\n1 0 0 0 1 0 9 9 9 7 8\n0 1 0 1 0 0 9 9 9 9 10\n" + face}) {
    const MeshFile file = read(text);
    EXPECT_TRUE(file.content.anew.empty()) << text;
    EXPECT_EQ(write_off(file.points, triangle, file.vertex_data), text);
  }
}

TEST(Off, WholeNumbersAreColoursUpTo255UnlessAllAreZeroOrOne) {
  const auto type = [](const std::string& colour) {
    return read("COFF\n3 1 0\n0 0 0 0 0 0 1\n1 0 0 " + colour + "\n0 1 0 0 0 0 1\n3 0 1 2\n")
        .vertex_data.at(3)
        .type;
  };
  EXPECT_EQ(type("0 255 0 1"), NumberType::uint8);
  EXPECT_EQ(type("0 2.0 0 1"), NumberType::uint8);
  for (const char* colour : {"1 1 0 1", "0 .5 200 1", "0 256 0 1", "0 200 0 -1"})
    EXPECT_EQ(type(colour), NumberType::float64) << colour;
}

TEST(Off, WhatIsNotKeptIsNamed) {
  const auto warning = [](const std::string& text) {
    const Warnings warnings = read(text).content.anew;
    return warnings.size() == 1 ? warnings[0].message : "";
  };
  const std::string start = "m.off: not kept in the output: ";
  EXPECT_EQ(warning("OFF\n3 1 0\n0 0 0 7\n1 0 0 7\n0 1 0 7\n3 0 1 2\n"),
            start + "1 more numbers on each vertex line");
  EXPECT_EQ(warning("STCOFF\n3 1 0\n0 0 0 7 1 1\n1 0 0 7 1 1\n0 1 0 7 1 1\n3 0 1 2\n"),
            start + "vertex colours, texture coordinates");
  EXPECT_EQ(warning("NOFF\n3 1 0\n0 0 0 0 0 1 7\n1 0 0 0 0 1 7\n0 1 0 0 0 1 7\n3 0 1 2\n"),
            start + "normals");
  for (const char* colour : {"3", "255 0 0", ".1 .2 .3 1"})
    EXPECT_EQ(warning("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 " + std::string(colour)),
              start + "face colours");
}

TEST(Off, ErrorsNameTheLine) {
  const std::string h = "OFF\n3 1 0\n";
  EXPECT_ERROR(InputError, "m.off:2: no content", read("# only\n"));
  EXPECT_ERROR(InputError, "m.off:2: the file ends after its keyword", read("OFF\n"));
  EXPECT_ERROR(InputError, "m.off:1: keyword '4OFF'", read("4OFF\n3 1 0\n" + body));
  EXPECT_ERROR(InputError, "m.off:1: keyword 'nOFF'", read("nOFF\n3\n3 1 0\n" + body));
  EXPECT_ERROR(InputError, "m.off: byte 11: the file ends here", read("OFF BINARY\n"));
  EXPECT_ERROR(InputError, "m.off:2: vertex count is '3.5'", read("OFF\n3.5 1 0\n" + body));
  EXPECT_ERROR(InputError, "m.off:2: vertex count is -3", read("OFF\n-3 1 0\n" + body));
  EXPECT_ERROR(InputError, "m.off:2: vertex count is 1000000000, but only",
               read("OFF\n1000000000 1 0\n" + body));
  EXPECT_ERROR(InputError, "m.off:2: face count is 2147483648, but only",
               read("OFF\n3 2147483648 0\n" + body));
  EXPECT_ERROR(InputError, "m.off:2: face count is missing", read("OFF\n3\n" + body));
  EXPECT_ERROR(InputError, "m.off:2: '7' after the counts", read("OFF\n3 1 0 7\n" + body));
  EXPECT_ERROR(InputError, "m.off:4: y is '1,5'", read(h + "0 0 0\n1 1,5 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.off:4: z is missing", read(h + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.off:6: vertex 3 with 4 numbers", read("OFF\n4 1 0\n" + body));
  EXPECT_ERROR(InputError, "m.off:5: face size is '0.0'",
               read("OFF\n2 1 0\n0 0 0\n1 0 0\n0.0 1 0\n3 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.off:7: text after the last of 1 faces", read(h + body + "3 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.off:7: the file ends before face 1 of 2", read("OFF\n3 2 0\n" + body));
  EXPECT_ERROR(InputError, "m.off:6: face 0 has vertex index 3", read(h + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"));
  EXPECT_ERROR(InputError, "m.off:6: face 0 has vertex index -1",
               read(h + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"));
  EXPECT_ERROR(InputError, "m.off:6: face 0 with 2 corners", read(h + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n"));
  EXPECT_ERROR(InputError, "m.off:6: face corner is missing",
               read(h + "0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.off:6: 2 numbers after face 0", read(h + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0 1\n"));
  EXPECT_ERROR(InputError, "m.off:5: vertices have 3 numbers; expected at least 6",
               read("NOFF\n3 1 0\n" + body));
}

TEST(Off, WritesWhatItReads) {
  EXPECT_EQ(write_off(read("OFF\n3 1 0\n" + body).points, {{0, 1, 2}}), "OFF\n3 1 0\n" + body);
}

}  // namespace hooke::off_test
