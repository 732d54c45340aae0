#include "hooke/io/rewrite.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "hooke/core/error.h"
#include "hooke/io/binary_numbers.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/read_mesh.h"
#include "hooke/io/sha256.h"
#include "support/errors.h"
#include "support/temporary_folder.h"

namespace hooke::rewrite_test {

struct File {
  MeshFormat format;
  std::string bytes;
};

MeshFile parse(const File& file) {
  return parse_mesh_file(file.bytes, "m", file.format);
}

using Edit = std::function<void(Mat3X&)>;
void nothing(Mat3X&) {}

/// The file with its points edited. Reads the result again: it must have these points.
std::string edited(const File& file, const Edit& edit) {
  Mat3X points = parse(file).points;
  edit(points);
  const RewrittenMesh result = rewrite_mesh(file.bytes, "m", file.format, points);
  EXPECT_EQ(result.obstacle, "");
  EXPECT_EQ(parse({file.format, result.bytes}).points, points);
  return result.bytes;
}

/// `text` with `before`, which must stand there once, replaced.
std::string with(std::string text, const std::string& before, const std::string& after) {
  const size_t at = text.find(before);
  EXPECT_NE(at, text.npos) << before;
  EXPECT_EQ(text.find(before, at + 1), text.npos) << before;
  return text.replace(at, before.size(), after);
}

// Binary numbers of a file, in either byte order.
struct Bytes {
  std::endian order;
  std::string text = {};

  Bytes& operator()(NumberType type, std::initializer_list<double> values) {
    for (const double value : values) {
      char bytes[8];
      char* end = bytes;
      put_binary(end, type, value, swaps_bytes(order));
      text.append(bytes, end);
    }
    return *this;
  }
};

constexpr NumberType u8 = NumberType::uint8, i16 = NumberType::int16, i32 = NumberType::int32,
                     f32 = NumberType::float32, f64 = NumberType::float64;

const std::string obj =
    "\xef\xbb\xbf# made by hand\r\nmtllib a b.mtl\r\no Body\r\n\r\n"
    "v  0.000 -0 1.50e0 # first\r\nv\t1. +0.0 .5 1.0\r\n"
    "v 0 1 \\\r\n  0.25\r\nv 1 1 0 .5 .5 .5\r\n"
    "vt 0 0\r\nvt 1 0.50\r\ng left\r\nusemtl red\r\ns 1\r\n"
    "f 1/1 2/2 4/1 3/2\r\nl 1 2 3\r\np 4\r\nfrob 1.0 2\r\nv 9 9 9\r\n  # the end, without a line end";

const std::string off =
    "# c\nSTCOFF # k\r\n4 1 0 # n\n\n0.0 0 0 255 0 0 255 0.50 1\n1 0 1e-3 255 0 0 255 0 1\r"
    "1 1 0. 1 2 3 4 0 1 # v\n 0 1 0 1 2 3 4 0 1\n4 0 1 2 3 0.5 .5 .50\n# more\n\n";

std::string ply(const char* encoding, const std::string& body) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment  kept  \nobj_info as it is\nelement camera 1\nproperty float x\n"
      "element vertex 3\nproperty uchar red\nproperty float x\nproperty list uchar short seen\n"
      "property double y\nproperty double z\nelement face 1\nproperty short part\n"
      "property list uchar int vertex_indices\nproperty list uchar float texcoord\nelement edge 1\n"
      "property int vertex1\nproperty int vertex2\nend_header\n{}",
      encoding, body);
}

const std::string ascii_body =
    "5.0\n255 0.50 0 0e0 1\n0 1 2 7 8 +.5 1.000\n1 0 1 9 1 1\n\n12 3 0 1 2 6 0 0 1 0 .5 1.50\n0  1\n";

std::string binary_body(std::endian order) {
  Bytes b{order};
  b(f32, {5});
  b(u8, {255})(f32, {.5})(u8, {0})(f64, {0, 1});
  b(u8, {0})(f32, {1})(u8, {2})(i16, {7, 8})(f64, {.1, 1});
  b(u8, {1})(f32, {0})(u8, {1})(i16, {9})(f64, {1, 1. / 3});
  b(i16, {12})(u8, {3})(i32, {0, 1, 2})(u8, {6})(f32, {0, 0, 1, 0, .5, 1.5});
  return b(i32, {0, 1}).text;
}

std::string binary_off(const char* keyword, bool normals) {
  Bytes b{std::endian::big};
  b(i32, {4, 1, 0});
  for (int v = 0; v < 4; ++v) {
    b(f32, {v % 3 ? 1. : 0, v / 2 ? 1. : 0, .1f});
    if (normals) b(f32, {0, 0, 1});
  }
  return keyword + std::string(" BINARY\n") + b(i32, {4, 0, 1, 2, 3, 3})(f32, {.5, .5, 1}).text;
}

const std::vector<File> files = {
    {MeshFormat::obj, obj},
    {MeshFormat::off, off},
    {MeshFormat::off, "3 1\n0 0 0 7\n1 0 0 7\n0 1 0 7\n3 0 1 2"},
    {MeshFormat::off, binary_off("OFF", false)},
    {MeshFormat::off, binary_off("NOFF", true)},
    {MeshFormat::ply, ply("ascii", ascii_body)},
    {MeshFormat::ply,
     "ply\rformat ascii 1.0\relement vertex 3\rproperty int x\rproperty int y\rproperty int z\r"
     "element face 1\rproperty list uchar int vertex_index\rend_header\r0 0 0 1 0 0 0 1 0 3 0 1 2"},
    {MeshFormat::ply, ply("binary_little_endian", binary_body(std::endian::little))},
    {MeshFormat::ply, ply("binary_big_endian", binary_body(std::endian::big) + "\n")}};

TEST(Rewrite, WithPointsAsTheyAreTheFileIsAsItWas) {
  for (const File& file : files) EXPECT_EQ(edited(file, nothing), file.bytes) << file.bytes;
}

TEST(Rewrite, OfTextOnlyTheDigitsOfOtherNumbersChange) {
  const Edit move = [](Mat3X& x) {
    x(1, 0) = -1. / 3;
    x(2, 2) = 1e-300;
  };
  EXPECT_EQ(edited({MeshFormat::obj, obj}, move),
            with(with(obj, "0.000 -0 1.50e0", "0.000 -0.3333333333333333 1.50e0"), "  0.25\r", "  1e-300\r"));
  EXPECT_EQ(edited({MeshFormat::off, off}, move),
            with(with(off, "\n0.0 0 0 255", "\n0.0 -0.3333333333333333 0 255"), "1 1 0. 1", "1 1 1e-300 1"));
  const std::string text = ply("ascii", ascii_body);
  EXPECT_EQ(edited({MeshFormat::ply, text}, move),
            with(with(text, "0.50 0 0e0 1", "0.50 0 -0.3333333333333333 1"), " 9 1 1\n", " 9 1 1e-300\n"));
}

TEST(Rewrite, OfBinaryFilesOnlyTheBytesOfOtherNumbersChange) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const char* encoding = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    const File file{MeshFormat::ply, ply(encoding, binary_body(order))};
    const std::string result = edited(file, [](Mat3X& x) { x(1, 1) = 7. / 3; });
    EXPECT_EQ(result, with(file.bytes, Bytes{order}(f64, {.1}).text, Bytes{order}(f64, {7. / 3}).text));
  }
}

TEST(Rewrite, FloatsAreRoundedAndDoublesAreNot) {
  const auto moved = [](const File& file) {
    Mat3X points = parse(file).points;
    points.col(1) = Vec3(.1, .1, .1);
    const RewrittenMesh result = rewrite_mesh(file.bytes, "m", file.format, points);
    EXPECT_EQ(result.rounded.col(2), points.col(2));
    EXPECT_EQ(result.rounded, parse({file.format, result.bytes}).points) << "as they are read again";
    return Vec3(result.rounded.col(1));
  };
  const double rounded = .1f;
  EXPECT_EQ(moved({MeshFormat::ply, ply("binary_big_endian", binary_body(std::endian::big))}),
            Vec3(rounded, .1, .1));
  EXPECT_EQ(moved({MeshFormat::off, binary_off("OFF", false)}), Vec3(rounded, rounded, rounded));
  const std::string text = ply("ascii", ascii_body);
  EXPECT_EQ(moved({MeshFormat::ply, text}), Vec3(.1, .1, .1)) << "the shortest text of the float reads as .1";
  EXPECT_EQ(rewrite_mesh(text, "m", MeshFormat::ply, parse({MeshFormat::ply, text}).points).rounded.size(),
            0);
}

TEST(Rewrite, ATypeThatCannotHoldTheResultIsAnObstacle) {
  const File& ints = files[6];
  const File floats{MeshFormat::off, binary_off("OFF", false)};
  const auto obstacle = [](const File& file, double x) {
    Mat3X points = parse(file).points;
    points(0, 0) = x;
    return rewrite_mesh(file.bytes, "m", file.format, points).obstacle;
  };
  EXPECT_NE(obstacle(ints, .5), "");
  EXPECT_NE(obstacle(ints, 3e9), "");
  EXPECT_EQ(obstacle(ints, -7), "");
  EXPECT_NE(obstacle(floats, 1e39), "");
  EXPECT_NE(obstacle({MeshFormat::ply, ply("ascii", ascii_body)}, 1e39), "");
}

// A long text with vertices before and after faces, and other lines among them: several pieces.
TEST(Rewrite, LongTextsAreRewrittenInPieces) {
  std::string text, expected;
  const auto both = [&](const std::string& line) { text += line, expected += line; };
  constexpr int count = 30000;
  for (int v = 0; v < count; ++v) {
    text += fmt::format("v {} \\\n 0 1.0 # {}\n", v, v % 7);
    expected += fmt::format("v {} \\\n {} 1.0 # {}\n", v, v % 3 ? "0" : "0.5", v % 7);
    if (v % 5 == 4) both(fmt::format("vt 0 0\ng g{}\nf {} {} {}\n", v, v - 3, v - 2, v - 1));
  }
  ASSERT_GT(text.size(), size_t{1} << 19);
  EXPECT_TRUE(edited({MeshFormat::obj, text}, [](Mat3X& x) {
                for (int v = 0; v < count; v += 3) x(1, v) = .5;
              }) == expected);
}

// Two triangles, folded along the edge from vertex 2 to vertex 3, over a floor of one.
const std::string hard_edge =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 0 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\n"
    "vn 0.0 0.0 1.00\nvn 1 0 0\nvn 0 0 2\nvn nan 0 0\n"
    "f 1//1 2//1 3//1\nf 2//2 4//2 3//2\nf 5//3 6//3 7//3\n";

TEST(Rewrite, HardEdgesStayHardAndOnlyTouchedNormalsChange) {
  EXPECT_EQ(edited({MeshFormat::obj, hard_edge}, nothing), hard_edge);
  const std::string result = edited({MeshFormat::obj, hard_edge}, [](Mat3X& x) { x(2, 0) = 1; });
  EXPECT_EQ(result,
            with(with(hard_edge, "v 0 0 0", "v 0 0 1"), "vn 0.0 0.0 1.00", "vn 0.70710677 0.0 0.70710677"));
}

TEST(Rewrite, OneSmoothNormalPerVertexIsThatOfAllItsFaces) {
  std::string smooth = hard_edge;
  smooth = with(smooth, "f 2//2 4//2 3//2", "f 2//1 4//2 3//1");
  const std::string result = edited({MeshFormat::obj, smooth}, [](Mat3X& x) { x(0, 3) = 1.5; });
  EXPECT_FALSE(test::has(result, "vn 0.0 0.0 1.00")) << result;
  EXPECT_TRUE(test::has(result, "vn 0 0 2\nvn nan 0 0\n")) << result;
}

TEST(Rewrite, NormalsThatCannotSuitAllTheirCornersAreCounted) {
  const std::string shared = with(hard_edge, "f 5//3 6//3 7//3", "f 5//1 6//1 7//1");
  Mat3X points = parse({MeshFormat::obj, shared}).points;
  points(2, 0) = 1;
  const RewrittenMesh result = rewrite_mesh(shared, "m", MeshFormat::obj, points);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].code, "normals_shared");
}

TEST(Rewrite, NormalsOfVerticesAndFacesFollow) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty float nx\n"
      "property float ny\nproperty list uchar int vertex_indices\nproperty float nz\nend_header\n";
  const std::string rows = "0 0 0 0 0 1.0\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 3 0 1 2 1.0\n";
  EXPECT_EQ(edited({MeshFormat::ply, header + rows}, nothing), header + rows);
  const Edit turn = [](Mat3X& x) { x.col(2) = Vec3(0, 0, 1); };
  EXPECT_EQ(edited({MeshFormat::ply, header + rows}, turn),
            header + "0 0 0 0 -1 0\n1 0 0 0 -1 0\n0 0 1 0 -1 0\n0 -1 3 0 1 2 0\n");
  const std::string cnoff =
      "CNOFF\n3 1 0\n0 0 0 0 0 1 1 0 .0\n1 0 0 0 0 1 1 0 .0\n0 1 0 0 0 1 1 0 .0\n3 0 1 2\n";
  EXPECT_EQ(edited({MeshFormat::off, cnoff}, turn),
            "CNOFF\n3 1 0\n0 0 0 0 -1 0 1 0 .0\n1 0 0 0 -1 0 1 0 .0\n0 0 1 0 -1 0 1 0 .0\n3 0 1 2\n");
  const MeshFile binary = parse({MeshFormat::off, edited({MeshFormat::off, binary_off("NOFF", true)},
                                                         [](Mat3X& x) { x.row(2) = x.row(0); })});
  ASSERT_TRUE(has_normals(binary.vertex_data));
  EXPECT_FLOAT_EQ(static_cast<float>(find_channel(binary.vertex_data, "nx")->values[0]), -std::sqrt(.5f));
}

TEST(Rewrite, AnIntegerNormalStaysAsItIs) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property char nx\nproperty char ny\nproperty char nz\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 0 0 127\n1 0 0 0 0 127\n0 1 0 0 0 127\n3 0 "
      "1 2\n";
  EXPECT_EQ(edited({MeshFormat::ply, text}, [](Mat3X& x) { x(1, 2) = 2; }),
            with(text, "\n0 1 0 ", "\n0 2 0 "));
}

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

SourceFile source_of(const std::filesystem::path& path, const LoadedMesh& loaded) {
  return {path, loaded.format, loaded.sha256, loaded.connectivity_sha256};
}

const std::string sheet = "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1.0 0\nf 1 2 3 4\n";

TEST(Preserve, WritesTheSourceWithThePointsOfTheMesh) {
  const TemporaryFolder folder;
  write_text(folder / "in.obj", sheet);
  LoadedMesh loaded = read_mesh(folder / "in.obj");
  vertex_points(loaded.mesh).col(0).x() = -.5;
  PreservedMesh result =
      prepare_preserved_mesh(folder / "out.obj", loaded.mesh, source_of(folder / "in.obj", loaded));
  ASSERT_TRUE(result.mesh);
  EXPECT_EQ(result.obstacle, "");
  EXPECT_EQ(folder.file_count(), 2u) << "not yet in its place";
  result.mesh->file.commit();
  EXPECT_EQ(read_text(folder / "out.obj"), "o a\nv -0.5 0 0\nv 1 0 0\nv 1 1 0\nv 0 1.0 0\nf 1 2 3 4\n");
  EXPECT_EQ(result.mesh->sha256, sha256(read_text(folder / "out.obj")));
  EXPECT_EQ(result.mesh->connectivity_sha256, loaded.connectivity_sha256);
}

TEST(Preserve, ASourceThatChangedIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "in.obj";
  write_text(path, sheet);
  const LoadedMesh loaded = read_mesh(path);
  const auto write = [&] {
    prepare_preserved_mesh(folder / "out.obj", loaded.mesh, source_of(path, loaded));
  };
  for (const std::string& other : {sheet + "\n", sheet.substr(0, 40), std::string("v 0 0 0\n")}) {
    write_text(path, other);
    EXPECT_ERROR(InputError, path.native() + ": has changed since it was read", write());
  }
  std::filesystem::remove(path);
  EXPECT_ERROR(InputError, path.native() + ": cannot be opened", write());
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(Preserve, SinglePrecisionThatTurnsFacesOverIsAnObstacle) {
  const TemporaryFolder folder;
  const auto path = folder / "in.ply";
  std::string rows;
  for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}})
    rows += fmt::format("{} {} 0\n", 4 * x + 16777216, y);
  write_text(path,
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 2\nproperty list uchar int vertex_index\nend_header\n" +
                 rows + "3 0 1 2\n3 0 2 3\n");
  LoadedMesh loaded = read_mesh(path);
  vertex_points(loaded.mesh)(0, 2) = 16777216.25;  // then all of a triangle has the same x
  vertex_points(loaded.mesh)(0, 1) = 16777216.5;
  const PreservedMesh result =
      prepare_preserved_mesh(folder / "out.ply", loaded.mesh, source_of(path, loaded));
  EXPECT_FALSE(result.mesh);
  EXPECT_TRUE(test::has(result.obstacle, "single precision")) << result.obstacle;
}

const std::string msh2_text =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nby hand\n$EndComments\n$PhysicalNames\n2\n1 3 "
    "\"rim\"\n2 7 \"lid\"\n$EndPhysicalNames\n$Nodes\n4\n10 0 0 0\n900  1.50 0\t0\n5 9 9 9\n3 1 1 0\n"
    "$EndNodes\n$Elements\n3\n1 15 2 4 1 10\n2 1 2 3 1 10 900\n8 2 2 7 4 10 900 3\n$EndElements\n"
    "$NodeData\n1\n\"T\"\n1\n0\n3\n0\n1\n1\n10 .5\n$EndNodeData\n";

void move_second(Mat3X& points) {
  points.col(1) = Vec3(1.25, 0, -.5);
}

TEST(Rewrite, MshKeepsNumbersOfNodesOtherElementsAndSections) {
  const File file{MeshFormat::msh2, msh2_text};
  EXPECT_EQ(edited(file, nothing), msh2_text);
  EXPECT_EQ(edited(file, move_second), with(msh2_text, "900  1.50 0\t0", "900  1.25 0\t-0.5"));
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 4 2 90\n0 1 0 1\n90\n0 0 0\n2 9 0 3\n4\n2\n7\n"
      "1.50 0 0\n2 2 2\n1 1 0\n$EndNodes\n$Elements\n1 1 1 1\n2 9 2 1\n1 90 4 7\n$EndElements\n";
  EXPECT_EQ(edited({MeshFormat::msh, text}, move_second), with(text, "1.50 0 0", "1.25 0 -0.5"));
}

TEST(Rewrite, MshKeepsBinaryFilesOfBothByteOrders) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const auto file = [&](const Vec3& second) {
      Bytes bytes{order};
      bytes.text = "$MeshFormat\n2.2 1 8\n";
      bytes(NumberType::int32, {1}).text += "\n$EndMeshFormat\n$Nodes\n3\n";
      bytes(NumberType::int32, {10})(NumberType::float64, {0, 0, 0});
      bytes(NumberType::int32, {12})(NumberType::float64, {second[0], second[1], second[2]});
      bytes(NumberType::int32, {11})(NumberType::float64, {0, 1, 0}).text += "\n$EndNodes\n$Elements\n2\n";
      bytes(NumberType::int32, {15, 1, 1, 1, 4, 10});
      bytes(NumberType::int32, {2, 1, 2, 2, 6, 9, 10, 12, 11}).text += "\n$EndElements\n";
      return File{MeshFormat::msh2, bytes.text};
    };
    EXPECT_EQ(edited(file({1, 0, 0}), nothing), file({1, 0, 0}).bytes);
    EXPECT_EQ(edited(file({1, 0, 0}), move_second), file({1.25, 0, -.5}).bytes);
  }
}

TEST(Rewrite, MshIsAnObstacleWhereMoreThanItsPolygonsDependsOnItsNodes) {
  const auto obstacle = [](const std::string& before, const std::string& after) {
    const File file{MeshFormat::msh2, with(msh2_text, before, after)};
    return rewrite_mesh(file.bytes, "m", file.format, parse(file).points).obstacle;
  };
  EXPECT_EQ(obstacle("2 1 2 3 1 10 900", "2 8 2 3 1 10 900 5"),
            "its second-order lines would not fit moved nodes");
  EXPECT_EQ(obstacle("2 1 2 3 1 10 900", "2 4 2 3 1 10 900 3 5"), "its tetrahedra would not fit moved nodes");
  EXPECT_EQ(
      obstacle("$NodeData\n1\n\"T\"\n1\n0\n3\n0\n1\n1\n10 .5\n$EndNodeData", "$Periodic\n0\n$EndPeriodic"),
      "its section $Periodic would not fit moved nodes");
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 3 1 3\n2 9 1 3\n1\n2\n3\n0 0 0 .5 .5\n1 0 0 .5 .5\n"
      "0 1 0 .5 .5\n$EndNodes\n$Elements\n1 1 1 1\n2 9 2 1\n1 1 2 3\n$EndElements\n";
  EXPECT_EQ(rewrite_mesh(text, "m", MeshFormat::msh, parse({MeshFormat::msh, text}).points).obstacle,
            "its parametric coordinates would not fit moved nodes");
}

}  // namespace hooke::rewrite_test
