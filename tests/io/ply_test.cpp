#include "hooke/io/ply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "hooke/core/error.h"
#include "support/errors.h"

namespace hooke::ply_test {

std::string header_with(const std::string& format, const std::string& properties) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n" + properties +
         "element face 0\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string properties =
    "property list uchar float near\nproperty float size\nproperty double other\nproperty uchar red\n";

std::vector<double> read_lengths(const std::string& bytes, const std::string& property = "size") {
  return read_ply_lengths(bytes, "m.ply", property);
}

template <typename T>
void put(std::string& bytes, T value) {
  bytes.append(std::bit_cast<std::array<char, sizeof(T)>>(value).data(), sizeof(T));
}

TEST(PlyLengths, AreThoseOfTheNamedProperty) {
  const std::string text = header_with("ascii", properties) + "0 0 0 1 9 .5 7 255\n1 0 0 0 .25 8 255\n";
  EXPECT_EQ(read_lengths(text), (std::vector{.5, .25}));
  EXPECT_EQ(read_lengths(text, "other"), (std::vector{7., 8.}));
}

TEST(PlyLengths, AreTheSameInABinaryFile) {
  const bool little = std::endian::native == std::endian::little;
  std::string bytes = header_with(little ? "binary_little_endian" : "binary_big_endian", properties);
  for (float length : {.5F, .25F}) {
    for (int k = 0; k < 3; ++k) put(bytes, 0.F);
    put(bytes, std::uint8_t{1});
    put(bytes, 9.F);
    put(bytes, length);
    put(bytes, 7.);
    put(bytes, std::uint8_t{255});
  }
  EXPECT_EQ(read_lengths(bytes), (std::vector{.5, .25}));
  bytes.resize(bytes.size() - 1);
  EXPECT_ERROR(InputError, "m.ply: vertex 1", read_lengths(bytes));
}

TEST(PlyLengths, AMissingPropertyIsToldWithThoseThereAre) {
  const std::string text = header_with("ascii", properties) + "0 0 0 0 1 1 1\n0 0 0 0 1 1 1\n";
  const std::string names = "; expected one of target lengths; there are 'size', 'other'";
  for (const char* property : {"siz", "red", "near", "x"})
    EXPECT_ERROR(InputError,
                 "m.ply: vertices have no float or double property '" + std::string(property) + "'" + names,
                 read_lengths(text, property));
  const std::string bare = header_with("ascii", "property uchar size\n") + "0 0 0 1\n0 0 0 1\n";
  EXPECT_TRUE(test::has(test::message_of<InputError>([&] { read_lengths(bare); }), "there is none"));
}

TEST(PlyLengths, AreFiniteAndPositive) {
  for (const char* value : {"0", "-1", "nan", "inf", "x", ""})
    EXPECT_ERROR(
        InputError, "m.ply:12: ",
        read_lengths(header_with("ascii", "property float size\n") + "0 0 0 1\n0 0 0 " + value + "\n"));
}

TEST(PlyLengths, ComeFromAnElementOfVertices) {
  EXPECT_ERROR(InputError, "m.ply: no element 'vertex'",
               read_lengths("ply\nformat ascii 1.0\nelement face 0\nend_header\n"));
}

MeshFile read(const std::string& bytes) {
  return read_ply(bytes, "m.ply");
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string list = "property list uchar int vertex_indices\n";
const std::string ascii = "ply\nformat ascii 1.0\n";
const std::string header = ascii + "element vertex 3\n" + xyz + "element face 1\n" + list + "end_header\n";
const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

// A binary file with the byte order of `format`; numbers are put in as they come.
struct Binary {
  std::string bytes;
  bool big;
  Binary(const std::string& format, const std::string& rest)
      : bytes("ply\nformat " + format + " 1.0\n" + rest + "end_header\n"),
        big(format == "binary_big_endian") {}
  template <typename T>
  Binary& put(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
    return *this;
  }
};

void expect_the_triangle(const MeshFile& file) {
  EXPECT_EQ(file.points.cols(), 3);
  EXPECT_EQ(Vec3(file.points.col(1)), Vec3(1, 0, 0));
  EXPECT_EQ(Vec3(file.points.col(2)), Vec3(0, 1, 0));
  EXPECT_EQ(file.polygons.items, (std::vector{0, 1, 2}));
}

std::string crlf(std::string text, const std::string& end) {
  for (size_t at = 0; (at = text.find('\n', at)) != text.npos; at += end.size()) text.replace(at, 1, end);
  return text;
}

TEST(Ply, DialectsAreTheSameMesh) {
  expect_the_triangle(read(header + body));
  expect_the_triangle(read(crlf(header + body, "\r\n")));
  expect_the_triangle(read(crlf(header + body, "\r")));
  expect_the_triangle(read(header + "\n" + crlf(body, "\n\n")));
  expect_the_triangle(read(header + crlf(body, " ")));  // all on one line
  expect_the_triangle(read(ascii + "comment element face 9\nobj_info x\nelement face 1\n" + list +
                           "element vertex 3\n" + xyz + "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n"));
  EXPECT_EQ(read(header + body).lines, (std::vector{13}));
}

TEST(Ply, EveryScalarTypeInBothByteOrders) {
  for (const char* format : {"binary_little_endian", "binary_big_endian"}) {
    Binary shorts(format,
                  "element vertex 3\nproperty short x\nproperty uchar y\nproperty char z\nelement face "
                  "1\nproperty list uint ushort vertex_index\n");
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}})
      shorts.put(static_cast<short>(x)).put(static_cast<unsigned char>(y)).put(static_cast<signed char>(0));
    shorts.put(3u);
    for (const int id : {0, 1, 2}) shorts.put(static_cast<unsigned short>(id));
    expect_the_triangle(read(shorts.bytes));
    Binary mixed(format,
                 "element vertex 3\nproperty float x\nproperty double y\nproperty int z\nelement face "
                 "1\nproperty list char uint vertex_indices\n");
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}})
      mixed.put(static_cast<float>(x)).put(static_cast<double>(y)).put(0);
    mixed.put(static_cast<signed char>(3));
    for (const int id : {0, 1, 2}) mixed.put(static_cast<unsigned>(id));
    expect_the_triangle(read(mixed.bytes));
  }
}

TEST(Ply, OtherPropertiesAndElementsArePassedOverAndNamed) {
  const std::string rest =
      "element camera 2\nproperty float a\nproperty list uchar short b\nelement vertex 3\nproperty float "
      "nx\n" +
      xyz + "property list int float w\nelement face 1\nproperty uchar red\n" + list +
      "property float quality\n";
  Binary file("binary_little_endian", rest);
  for (const int n : {0, 2}) {
    file.put(1.f).put(static_cast<unsigned char>(n));
    for (int k = 0; k < n; ++k) file.put(static_cast<short>(7));
  }
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}})
    file.put(9.f)
        .put(static_cast<float>(x))
        .put(static_cast<float>(y))
        .put(0.f)
        .put(x)
        .bytes.append(4 * static_cast<size_t>(x), 'w');
  file.put(static_cast<unsigned char>(255)).put(static_cast<unsigned char>(3)).put(0).put(1).put(2).put(.5f);
  const MeshFile mesh = read(file.bytes);
  expect_the_triangle(mesh);
  ASSERT_EQ(mesh.content.anew.size(), 1u);
  EXPECT_EQ(mesh.content.anew[0].message,
            "m.ply: not kept in the output: element 'camera', vertex property 'w', face property "
            "'quality'");
  EXPECT_EQ(mesh.content.anew[0].code, "attributes_not_kept");
  ASSERT_EQ(mesh.vertex_data.size(), 1u);
  EXPECT_EQ(mesh.vertex_data[0].name, "nx");
  EXPECT_EQ(mesh.vertex_data[0].values, (std::vector<double>{9, 9, 9}));
}

TEST(Ply, BodyBeginsRightAfterTheHeadersOwnLineEnd) {
  // The first byte of the body is 10, which would be a line end in the header.
  Binary file(
      "binary_little_endian",
      "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\nelement face 1\n" + list);
  file.bytes += std::string("\n\0\0\0\0\0\0\1\0", 9);
  file.put('\3').put(0).put(1).put(2);
  EXPECT_EQ(read(file.bytes).points(0, 0), 10);
  std::string cr = crlf(file.bytes.substr(0, file.bytes.find("end_header\n") + 11), "\r") +
                   file.bytes.substr(file.bytes.find("end_header\n") + 11);
  EXPECT_EQ(read(cr).points(0, 0), 10);
}

TEST(Ply, HeaderErrorsNameTheLine) {
  EXPECT_ERROR(InputError, "m.ply:1: no 'ply'", read("plx\n"));
  EXPECT_ERROR(InputError, "m.ply:2: the file ends in its header", read("ply\n"));
  EXPECT_ERROR(InputError, "m.ply:2: format 'binary'", read("ply\nformat binary 1.0\n"));
  EXPECT_ERROR(InputError, "m.ply:2: format version '2.0'", read("ply\nformat ascii 2.0\n"));
  EXPECT_ERROR(InputError, "m.ply:3: no format line", read("ply\ncomment\nend_header\n"));
  EXPECT_ERROR(InputError, "m.ply:3: element without a name", read(ascii + "element\n"));
  EXPECT_ERROR(InputError, "m.ply:3: element count is 'many'", read(ascii + "element vertex many\n"));
  EXPECT_ERROR(InputError, "m.ply:3: element count -1", read(ascii + "element vertex -1\n"));
  EXPECT_ERROR(InputError, "m.ply:3: property before any element", read(ascii + xyz));
  EXPECT_ERROR(InputError, "m.ply:4: type 'quad'", read(ascii + "element vertex 1\nproperty quad x\n"));
  EXPECT_ERROR(InputError, "m.ply:4: list length of a floating type",
               read(ascii + "element face 1\nproperty list float int x\n"));
  EXPECT_ERROR(InputError, "m.ply:7: property 'x' declared twice",
               read(ascii + "element vertex 1\n" + xyz + "property int x\n"));
  EXPECT_ERROR(InputError, "m.ply:4: element 'face' declared twice",
               read(ascii + "element face 1\nelement face 1\n"));
  EXPECT_ERROR(InputError, "m.ply:3: header line 'frob'", read(ascii + "frob\n"));
  EXPECT_ERROR(InputError, "m.ply: no element 'face'",
               read(ascii + "element vertex 1\n" + xyz + "end_header\n0 0 0\n"));
  EXPECT_ERROR(InputError, "m.ply: vertices have no scalar property 'x'",
               read(ascii + "element vertex 0\nelement face 0\n" + list + "end_header\n"));
  EXPECT_ERROR(InputError, "m.ply: faces without one integer list",
               read(ascii + "element vertex 0\n" + xyz + "element face 0\nend_header\n"));
  EXPECT_ERROR(InputError, "m.ply: faces without one integer list",
               read(ascii + "element vertex 0\n" + xyz +
                    "element face 0\nproperty list uchar float vertex_indices\nend_header\n"));
}

TEST(Ply, TextBodyErrorsNameTheLine) {
  EXPECT_ERROR(InputError, "m.ply:11: y is 'nan'", read(header + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.ply:11: z is missing", read(header + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.ply:10: '7' after the last value",
               read(header + "0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.ply:13: vertex index 3", read(header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"));
  EXPECT_ERROR(InputError, "m.ply:13: face with 2 corners", read(header + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n"));
  EXPECT_ERROR(InputError, "m.ply:13: face corner is missing",
               read(header + "0 0 0\n1 0 0\n0 1 0\n4000000000 0 1\n"));
  EXPECT_ERROR(InputError, "m.ply:14: text after the last element", read(header + body + "3 0 1 2\n"));
  EXPECT_ERROR(InputError, "m.ply:10: text after the last element", read(header + crlf(body, " ") + "3"));
  EXPECT_ERROR(InputError, "m.ply:13: the file ends before 'face' 0 of 1",
               read(header + "0 0 0\n1 0 0\n0 1 0\n"));
  EXPECT_ERROR(
      InputError, "m.ply:10: 1000000000 'vertex' elements, but only",
      read(ascii + "element vertex 1000000000\n" + xyz + "element face 1\n" + list + "end_header\n" + body));
}

TEST(Ply, BinaryBodyErrorsNameElementAndByte) {
  for (const char* format : {"binary_little_endian", "binary_big_endian"}) {
    const auto make = [&](float y, unsigned char size, int last) {
      Binary file(format, "element vertex 3\n" + xyz + "element face 1\n" + list);
      for (const auto& [a, b] : {std::pair{0.f, 0.f}, {1.f, y}, {0.f, 1.f}}) file.put(a).put(b).put(0.f);
      return file.put(size).put(0).put(1).put(last).bytes;
    };
    expect_the_triangle(read(make(0, 3, 2)));
    expect_the_triangle(read(make(0, 3, 2) + "\n"));
    EXPECT_ERROR(InputError, "m.ply: vertex 1, byte ",
                 read(make(std::numeric_limits<float>::quiet_NaN(), 3, 2)));
    EXPECT_ERROR(InputError, "m.ply: vertex 1, byte ",
                 read(make(std::numeric_limits<float>::infinity(), 3, 2)));
    EXPECT_ERROR(InputError, "m.ply: face 0, byte ", read(make(0, 3, 3)));
    EXPECT_ERROR(InputError, "m.ply: face 0, byte ", read(make(0, 3, -1)));
    EXPECT_ERROR(InputError, "m.ply: face 0, byte ", read(make(0, 4, 2)));
    EXPECT_ERROR(InputError, "m.ply: 100 bytes after the last element",
                 read(make(0, 3, 2) + std::string(100, 'x')));
    const std::string whole = make(0, 3, 2);
    for (size_t size = 0; size < whole.size(); ++size)
      EXPECT_THROW(read(whole.substr(0, size)), InputError) << size;
  }
}

}  // namespace hooke::ply_test
