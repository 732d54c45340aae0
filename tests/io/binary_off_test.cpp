#include "hooke/io/binary_off.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "hooke/io/binary_numbers.h"
#include "hooke/io/off.h"
#include "support/errors.h"

namespace hooke::binary_off_test {

constexpr NumberType whole = NumberType::int32, real = NumberType::float32;

std::string bytes(NumberType type, std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    char word[4];
    char* end = word;
    put_binary(end, type, value, swaps_bytes(std::endian::big));
    text.append(word, end);
  }
  return text;
}

const std::string vertices = bytes(real, {0, 0, 0, 1, 0, 0, 0, 1.5, 0});
const std::string face = bytes(whole, {3, 0, 1, 2, 0});

MeshFile read(const std::string& keyword, const std::string& body) {
  return read_off(keyword + body, "m.off");
}

TEST(BinaryOff, IsTheMeshThatItsTextIs) {
  for (const char* keyword : {"OFF BINARY\n", "OFF BINARY\r\n", "# c\noff binary \n"}) {
    const MeshFile file = read(keyword, bytes(whole, {3, 1, 0}) + vertices + face);
    EXPECT_EQ(file.points, (Mat3X(3, 3) << 0, 1, 0, 0, 0, 1.5, 0, 0, 0).finished());
    EXPECT_EQ(file.polygons.items, (std::vector{0, 1, 2}));
    EXPECT_TRUE(file.content.anew.empty());
  }
}

TEST(BinaryOff, DataOfVerticesFollowTheCoordinates) {
  const std::string vertex = bytes(real, {0, 0, 0, 0, 0, 1, .5, .25, 0, 1, .75, 2});
  const MeshFile file =
      read("STCNOFF BINARY\n", bytes(whole, {3, 1, 0}) + vertex + vertex + vertex +
                                   bytes(whole, {3, 0, 1, 2, 3}) + bytes(real, {1, 0, 0}) + "\n");
  ASSERT_EQ(file.vertex_data.size(), 9u);
  EXPECT_EQ(find_channel(file.vertex_data, "nz")->values, (std::vector<double>(3, 1)));
  EXPECT_EQ(find_channel(file.vertex_data, "green")->values, (std::vector<double>(3, .25)));
  EXPECT_EQ(find_channel(file.vertex_data, "t")->values, (std::vector<double>(3, 2)));
  ASSERT_EQ(file.content.anew.size(), 1u);
  EXPECT_TRUE(test::has(file.content.anew[0].message, "face colours"));
}

TEST(BinaryOff, ErrorsNameTheByte) {
  const std::string counts = bytes(whole, {3, 1, 0});
  const auto expect = [](const std::string& start, const std::string& body) {
    EXPECT_ERROR(InputError, "m.off: byte " + start, read("OFF BINARY\n", body));
  };
  EXPECT_ERROR(InputError, "m.off:1: text after BINARY", read("OFF BINARY 3\n", counts));
  expect("11: the file ends here", "");
  expect("15: vertex count is -1", bytes(whole, {-1, 1, 0}) + vertices + face);
  expect("15: vertex count is 1000000000", bytes(whole, {1e9, 1, 0}) + vertices + face);
  expect("19: face count is 1000000000", bytes(whole, {3, 1e9, 0}) + vertices + face);
  expect("23: the file ends before its last vertex", counts + vertices.substr(0, 32));
  expect("75: the file ends here", counts + vertices + bytes(whole, {3, 0, 1, 2}) + face.substr(0, 1));
  expect("63: face 0 with 2 corners", counts + vertices + bytes(whole, {2, 0, 1, 2, 0}));
  expect("75: face 0 has vertex index 3", counts + vertices + bytes(whole, {3, 0, 1, 3, 0}));
  expect("79: face 0 with a colour of 7", counts + vertices + bytes(whole, {3, 0, 1, 2, 7}));
  expect("79: 4 bytes after the last face", counts + vertices + face + "more");
  expect("27: vertex 0 is not finite",
         counts + bytes(real, {std::numeric_limits<double>::infinity()}) + vertices.substr(4) + face);
}

}  // namespace hooke::binary_off_test
