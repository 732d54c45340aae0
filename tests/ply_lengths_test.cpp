#include "hooke/io/ply.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "errors.h"
#include "hooke/core/error.h"

namespace hooke {
namespace {

std::string header(const std::string& format, const std::string& properties) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n" + properties +
         "element face 0\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string properties =
    "property list uchar float near\nproperty float size\nproperty double other\nproperty uchar red\n";

std::vector<double> read(const std::string& bytes, const std::string& property = "size") {
  return read_ply_lengths(bytes, "m.ply", property);
}

template <typename T>
void put(std::string& bytes, T value) {
  bytes.append(std::bit_cast<std::array<char, sizeof(T)>>(value).data(), sizeof(T));
}

TEST(PlyLengths, AreThoseOfTheNamedProperty) {
  const std::string text = header("ascii", properties) + "0 0 0 1 9 .5 7 255\n1 0 0 0 .25 8 255\n";
  EXPECT_EQ(read(text), (std::vector{.5, .25}));
  EXPECT_EQ(read(text, "other"), (std::vector{7., 8.}));
}

TEST(PlyLengths, AreTheSameInABinaryFile) {
  const bool little = std::endian::native == std::endian::little;
  std::string bytes = header(little ? "binary_little_endian" : "binary_big_endian", properties);
  for (float length : {.5F, .25F}) {
    for (int k = 0; k < 3; ++k) put(bytes, 0.F);
    put(bytes, std::uint8_t{1});
    put(bytes, 9.F);
    put(bytes, length);
    put(bytes, 7.);
    put(bytes, std::uint8_t{255});
  }
  EXPECT_EQ(read(bytes), (std::vector{.5, .25}));
  bytes.resize(bytes.size() - 1);
  EXPECT_ERROR(InputError, "m.ply: vertex 1", read(bytes));
}

TEST(PlyLengths, AMissingPropertyIsToldWithThoseThereAre) {
  const std::string text = header("ascii", properties) + "0 0 0 0 1 1 1\n0 0 0 0 1 1 1\n";
  const std::string names = "; expected one of target lengths; there are 'size', 'other'";
  for (const char* property : {"siz", "red", "near", "x"})
    EXPECT_ERROR(InputError,
                 "m.ply: vertices have no float or double property '" + std::string(property) + "'" + names,
                 read(text, property));
  const std::string bare = header("ascii", "property uchar size\n") + "0 0 0 1\n0 0 0 1\n";
  EXPECT_TRUE(test::has(test::message_of<InputError>([&] { read(bare); }), "there is none"));
}

TEST(PlyLengths, AreFiniteAndPositive) {
  for (const char* value : {"0", "-1", "nan", "inf", "x", ""})
    EXPECT_ERROR(InputError, "m.ply:12: ",
                 read(header("ascii", "property float size\n") + "0 0 0 1\n0 0 0 " + value + "\n"));
}

TEST(PlyLengths, ComeFromAnElementOfVertices) {
  EXPECT_ERROR(InputError, "m.ply: no element 'vertex'",
               read("ply\nformat ascii 1.0\nelement face 0\nend_header\n"));
}

}  // namespace
}  // namespace hooke
