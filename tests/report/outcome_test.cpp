#include "hooke/report/outcome.h"

#include <gtest/gtest.h>

#include <sstream>

#include "hooke/mesh/adjacency.h"
#include "support/solids.h"

namespace hooke::outcome_test {

/// A run that made one mesh of another.
RunRecord run_of(const test::Triangles& before, const test::Triangles& after,
                 std::vector<std::string> reasons = {}) {
  const Adjacency b = test::connect(before), a = test::connect(after);
  RunRecord run;
  run.before = measure_quality(before.points, b, {});
  run.after = measure_quality(after.points, a, {});
  run.after->worst_faces.front().reasons = std::move(reasons);
  run.deviation = measure_deviation(before.points, b, after.points, a);
  return run;
}

TEST(Outcome, TellsAnglesFacesAndHowFarTheSurfaceWent) {
  const test::Triangles before = test::grid(12, test::flat, .45), after = test::grid(12, test::flat);
  const std::string text = outcome_in_words(run_of(before, after));
  EXPECT_NE(text.find("-> 45 degrees; 0 of 288 faces below 20 ("), std::string::npos) << text;
  EXPECT_NE(text.find("the surface did not move"), std::string::npos) << text;
  EXPECT_EQ(text.find("held by"), std::string::npos) << text;
}

TEST(Outcome, SaysWhatHoldsTheWorstFaceAndWhatWouldHelp) {
  const test::Triangles bad = test::grid(12, test::flat, .45);
  const RunRecord run = run_of(bad, bad, {"guard", "corner"});
  EXPECT_NE(outcome_in_words(run).find("the worst is held by a corner of the input"), std::string::npos);
  EXPECT_NE(advice_in_words(run, ConnectivityMode::fixed).find("--connectivity flip"), std::string::npos);
  EXPECT_NE(advice_in_words(run, ConnectivityMode::flip).find("--connectivity adapt"), std::string::npos);
  EXPECT_EQ(advice_in_words(run, ConnectivityMode::adapt), "");
  RunRecord creased = run_of(bad, bad);
  for (WorstFace& face : creased.after->worst_faces) face.reasons = {"corner", "crease"};
  EXPECT_EQ(advice_in_words(creased, ConnectivityMode::fixed).find("--connectivity flip"), std::string::npos);
  EXPECT_NE(advice_in_words(creased, ConnectivityMode::fixed).find("--connectivity adapt"),
            std::string::npos);
  const test::Triangles good = test::sphere(2);
  EXPECT_EQ(advice_in_words(run_of(good, good), ConnectivityMode::fixed), "");
}

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

}  // namespace hooke::outcome_test
