#include "hooke/io/text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "hooke/io/obj.h"
#include "hooke/io/off.h"
#include "hooke/io/ply.h"
#include "support/errors.h"
#include "support/meshes.h"

namespace hooke::text_test {

// Several megabytes, so that there are several pieces.
const test::Triangles& large() {
  static const test::Triangles mesh = test::grid(220, test::paraboloid, .2);
  return mesh;
}

std::string with_crlf(const std::string& text) {
  std::string out;
  for (char c : text) out += c == '\n' ? "\r\n" : std::string(1, c);
  return out;
}

void expect_large(const MeshFile& file) {
  const test::Triangles& t = large();
  EXPECT_EQ(file.points, t.points);
  ASSERT_EQ(file.polygons.first.size(), t.faces.size() + 1);
  for (size_t f = 0; f < t.faces.size(); ++f) {
    const auto corners = file.polygons[static_cast<int>(f)];
    ASSERT_TRUE(std::ranges::equal(corners, t.faces[f]));
  }
}

TEST(TextPieces, HoldAllLinesOnceInOrder) {
  std::string text = "first line\n";
  for (int k = 0; k < 400000; ++k) text += k % 7 == 0 ? "\n" : "row " + std::to_string(k) + "\n";
  Scanner in(text, "name", {});
  in.next_line();
  const std::vector<TextPiece> pieces = remaining_pieces(in);
  ASSERT_GT(pieces.size(), 2u);
  int k = 0;
  long long rows = 0;
  for (const TextPiece& piece : pieces) {
    EXPECT_EQ(piece.first_row, rows);
    Scanner rest = piece.scanner;
    for (long long row = 0; row < piece.rows; ++row, ++rows, ++k) {
      if (k % 7 == 0) ++k;
      ASSERT_TRUE(rest.next_line());
      ASSERT_EQ(rest.line(), k + 2);
      rest.token();
      ASSERT_EQ(rest.token(), std::to_string(k));
    }
    EXPECT_FALSE(rest.next_line());
  }
  EXPECT_EQ(k, 400000);
}

TEST(TextPieces, NoContinuedLineIsCut) {
  std::string text;
  while (text.size() < 3000000) text += "v 1 \\\n2 \\\r\n 3\nf 1 \\\n 2 3\n";
  const MeshFile file = read_obj(text, "name");
  EXPECT_EQ(file.points.col(file.points.cols() - 1), Vec3(1, 2, 3));
  EXPECT_EQ(file.polygons.items.size(), 3 * (file.polygons.first.size() - 1));
}

TEST(TextPieces, ALargeFileReadsAsItWasWritten) {
  const test::Triangles& t = large();
  expect_large(read_obj(write_obj(t.points, t.faces), "name"));
  expect_large(read_off(write_off(t.points, t.faces), "name"));
  expect_large(read_ply(write_ply(t.points, t.faces, PlyEncoding::ascii), "name"));
  expect_large(read_obj(with_crlf(write_obj(t.points, t.faces)), "name"));
  expect_large(read_off(with_crlf(write_off(t.points, t.faces)), "name"));
}

TEST(TextPieces, ThreadsChangeNothing) {
  const test::Triangles& t = large();
  const std::string text = write_off(t.points, t.faces);
  const ThreadLimit one(1);
  EXPECT_EQ(write_off(t.points, t.faces), text);
  expect_large(read_off(text, "name"));
}

TEST(TextPieces, NumbersOfVerticesStayWithTheirVertices) {
  const test::Triangles& t = large();
  VertexData data;
  for (const char* name : {"red", "green", "blue", "s", "t"}) data.push_back({.name = name});
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    for (size_t k = 0; k < 5; ++k)
      data[k].values.push_back(static_cast<double>(v) + static_cast<double>(k) / 8);
  for (const MeshFile& file : {read_obj(write_obj(t.points, t.faces, data), "name"),
                               read_off(write_off(t.points, t.faces, data), "name")}) {
    expect_large(file);
    ASSERT_EQ(file.vertex_data.size(), 5u);
    for (size_t k = 0; k < 5; ++k) EXPECT_EQ(file.vertex_data[k].values, data[k].values);
  }
}

TEST(TextPieces, CornersWithoutATextureCoordinateAreCountedInAllPieces) {
  const test::Triangles& t = large();
  const std::string text = write_obj(t.points, t.faces) + "vt 0 0\nf 1/1 2/1 3/1\nf 1/1 2 3\n";
  EXPECT_EQ(read_obj(text, "name").content.no_obj.at(0).message,
            fmt::format("name: not kept in the output: texture coordinates ({} of {} face corners have none)",
                        3 * t.faces.size() + 2, 3 * t.faces.size() + 6));
}

TEST(TextPieces, LinesOfFacesAreThoseOfTheFile) {
  const test::Triangles& t = large();
  const int vertices = static_cast<int>(t.points.cols());
  const MeshFile obj = read_obj(write_obj(t.points, t.faces), "name");
  const MeshFile off = read_off(write_off(t.points, t.faces), "name");
  for (size_t f = 0; f < t.faces.size(); ++f) {
    ASSERT_EQ(obj.lines[f], vertices + static_cast<int>(f) + 1);
    ASSERT_EQ(off.lines[f], vertices + static_cast<int>(f) + 3);
  }
}

// The text with two rows spoiled: the message tells of the first one.
std::string spoiled(std::string text, size_t row_from_end, size_t later) {
  for (size_t back : {row_from_end, later}) {
    size_t at = text.size() - 1;
    for (size_t k = 0; k < back; ++k) at = text.rfind('\n', at - 1);
    text[at + 1] = '?';
  }
  return text;
}

TEST(TextPieces, TheFirstErrorIsTold) {
  const test::Triangles& t = large();
  const int faces = static_cast<int>(t.faces.size()), vertices = static_cast<int>(t.points.cols());
  const std::string off = spoiled(write_off(t.points, t.faces), 90000, 10);
  const std::string line = std::to_string(2 + vertices + faces - 90000 + 1);
  EXPECT_ERROR(InputError, "name:" + line + ": ", read_off(off, "name"));
  const std::string ply = spoiled(write_ply(t.points, t.faces, PlyEncoding::ascii), 90000, 10);
  const std::string ply_line = std::to_string(9 + vertices + faces - 90000 + 1);
  EXPECT_ERROR(InputError, "name:" + ply_line + ": ", read_ply(ply, "name"));
}

TEST(TextPieces, NegativeIndicesCountFromWhereTheyStand) {
  std::string text;
  for (size_t k = 0; k < 60000; ++k)
    text += "v 0 0 1\nv 1 0 0.5\nv 0 1 0.25\nvn 0 0 1\nf -3//-1 -2//-1 -1//-1\n";
  const MeshFile file = read_obj(text, "name");
  for (size_t k = 0; k < file.polygons.items.size(); ++k)
    ASSERT_EQ(file.polygons.items[k], static_cast<int>(k));
  EXPECT_TRUE(file.content.anew.empty());
  ASSERT_EQ(file.vertex_data.size(), 3u);
  for (double z : file.vertex_data[2].values) ASSERT_EQ(z, 1);
  EXPECT_ERROR(InputError, "name:300001: normal index", read_obj(text + "f 1//60001 2 3\n", "name"));
  EXPECT_ERROR(InputError, "name:1: vertex index", read_obj("f 1 2 180001\n" + text, "name"));
}

}  // namespace hooke::text_test
