#include "hooke/io/vertex_lists.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "support/errors.h"
#include "support/temporary_folder.h"

namespace hooke::vertex_lists_test {

TEST(IdList, ReadsOneIdALine) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "ids", "# corners\n0\n\n  7 # the tip\n3\n");
  EXPECT_EQ(read_id_list(folder / "ids", 8), (std::vector{0, 7, 3}));
}

TEST(IdList, NamesTheLineOfWhatIsNotAnId) {
  const test::TemporaryFolder folder;
  const auto read = [&](const char* text) {
    test::write_text(folder / "ids", text);
    return read_id_list(folder / "ids", 8);
  };
  const std::string name = (folder / "ids").string();
  EXPECT_ERROR(InputError, name + ":2: vertex id 8; expected 0 to 7", read("1\n8\n"));
  EXPECT_ERROR(InputError, name + ":1: vertex id -1; expected 0 to 7", read("-1\n"));
  EXPECT_ERROR(InputError, name + ":1: more than one value", read("1 2\n"));
  EXPECT_ERROR(InputError, name + ":3: ", read("1\n2\nx\n"));
  EXPECT_ERROR(InputError, (folder / "none").string(), read_id_list(folder / "none", 8));
}

TEST(EdgeLengths, ReadsTwoIdsAndALengthALine) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "lengths", "# a spring\n0 3 .5\n\n 7 1 2e-1 # another\n");
  const std::vector<EdgeLength> lengths = read_edge_lengths(folder / "lengths", 8);
  ASSERT_EQ(lengths.size(), 2u);
  EXPECT_EQ(lengths[0].ends, (Edge{0, 3}));
  EXPECT_EQ(lengths[0].length, .5);
  EXPECT_EQ(lengths[1].ends, (Edge{7, 1}));
  EXPECT_EQ(lengths[1].length, .2);
  EXPECT_EQ(lengths[1].line, 4);
}

TEST(EdgeLengths, NamesTheLineOfWhatIsNoEdgeWithALength) {
  const test::TemporaryFolder folder;
  const std::string name = (folder / "lengths").string();
  const auto read = [&](const char* text) {
    test::write_text(folder / "lengths", text);
    return read_edge_lengths(folder / "lengths", 8);
  };
  EXPECT_ERROR(InputError, name + ":2: vertex id 8; expected 0 to 7", read("0 1 1\n1 8 1\n"));
  EXPECT_ERROR(InputError, name + ":1: vertex id 3 twice", read("3 3 1\n"));
  EXPECT_ERROR(InputError, name + ":1: length 0; expected a positive number", read("0 1 0\n"));
  EXPECT_ERROR(InputError, name + ":1: more than three values", read("0 1 1 1\n"));
  EXPECT_ERROR(InputError, name + ":3: ", read("0 1 1\n0 2 1\n0 4\n"));
}

TEST(LengthList, ReadsOneLengthALine) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "lengths", "# m\n1\n\n  .25 # the tip\n3e-2\n");
  EXPECT_EQ(read_length_list(folder / "lengths", 3), (std::vector{1., .25, .03}));
}

TEST(LengthList, NamesTheLineOfWhatIsNoLength) {
  const test::TemporaryFolder folder;
  const std::string name = (folder / "lengths").string();
  const auto read = [&](const char* text) {
    test::write_text(folder / "lengths", text);
    return read_length_list(folder / "lengths", 3);
  };
  EXPECT_ERROR(InputError, name + ":2: length 0; expected a positive number", read("1\n0\n1\n"));
  EXPECT_ERROR(InputError, name + ":1: length -1; expected a positive number", read("-1\n1\n1\n"));
  for (const char* word : {"nan", "inf", "1e999", "x", "1,5"})
    EXPECT_ERROR(InputError, name + ":3: ", read((std::string("1\n2\n") + word + "\n").c_str()));
  EXPECT_ERROR(InputError, name + ":1: more than one value", read("1 2\n1\n1\n"));
  EXPECT_ERROR(InputError, name + ":5: more than 3 lengths", read("1\n1\n1\n\n1\n"));
  EXPECT_ERROR(InputError, name + ": 2 lengths for 3 vertices", read("1\n1\n"));
  EXPECT_ERROR(InputError, name, read(""));
  EXPECT_ERROR(InputError, (folder / "none").string(), read_length_list(folder / "none", 3));
}

}  // namespace hooke::vertex_lists_test
