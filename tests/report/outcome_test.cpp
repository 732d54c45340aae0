#include "hooke/report/outcome.h"

#include <gtest/gtest.h>

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
  EXPECT_NE(outcome_in_words(run).find("the worst is held by a sharp corner of the input"),
            std::string::npos);
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

}  // namespace hooke::outcome_test
