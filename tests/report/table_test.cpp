#include "hooke/report/table.h"

#include <gtest/gtest.h>

#include <sstream>

#include "support/solids.h"

#include "hooke/mesh/adjacency.h"

namespace hooke::table_test {

Quality quality_of(const test::Triangles& t) {
  return measure_quality(t.points, test::connect(t), {});
}

/// Characters of a UTF-8 line: bytes that do not continue one.
size_t width(const std::string& line) {
  size_t n = 0;
  for (char c : line) n += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  return n;
}

void expect_narrow(const std::string& table) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(width(line), 80u) << line;
}

TEST(QualityTable, ShowsBothSidesWithin80Columns) {
  const test::Triangles a = test::sphere(2, .3), b = test::sphere(2);
  const Adjacency c = test::connect(a);
  const std::string table =
      quality_table(quality_of(a), quality_of(b), measure_deviation(a.points, c, b.points, c));
  expect_narrow(table);
  for (const char* part : {"before", "after", "minimum angle", "folded edges", "self-intersections",
                           "maximum displacement", "flipped faces", "█"})
    EXPECT_NE(table.find(part), std::string::npos) << part;
  EXPECT_EQ(table.find("nan"), std::string::npos);
}

TEST(QualityTable, WhatDoesNotExistIsADash) {
  const std::string table = quality_table(quality_of({Mat3X(3, 0), {}}));
  expect_narrow(table);
  EXPECT_EQ(table.find("nan"), std::string::npos);
  EXPECT_NE(table.find(" -\n"), std::string::npos);
}

TEST(TextHistogram, EmptyBinsAreBlankAndOthersAreNot) {
  EXPECT_EQ(text_histogram({{0, 1, 2, 3, 4}, {0, 1, 1000, 500}}), " ▁█▄");
  EXPECT_EQ(text_histogram({{0, 1}, {0}}), " ");
  EXPECT_EQ(text_histogram({}), "");
}

}  // namespace hooke::table_test
