#include "hooke/report/comparison.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hooke/core/error.h"
#include "support/errors.h"

namespace hooke::comparison_test {

using Json = nlohmann::ordered_json;

Json report(double angle, double distance = .1, double area = .01, const Json& folds = 0) {
  return {{"schema", "hooke-remesh/report/1"},
          {"input", {{"sha256", "ab"}, {"connectivity_sha256", "cd"}, {"bbox_diagonal", 2.}}},
          {"parameters", {{"L", .5}}},
          {"before", {{"min_angle", {{"min", 1.}}}}},
          {"after", {{"min_angle", {{"min", angle}}}, {"folded_edges", folds}}},
          {"geometry", {{"distance_to_input", {{"max", distance}}}, {"area_change", area}}}};
}

Comparison compared(const Json& base, const Json& now, double rtol = 0) {
  return compare(figures_of(base), figures_of(now), rtol);
}

std::vector<std::string> worse(const Json& base, const Json& now, double rtol = 0) {
  std::vector<std::string> keys;
  for (const Worsening& w : compared(base, now, rtol).worse) keys.push_back(w.key);
  return keys;
}

using Keys = std::vector<std::string>;

TEST(Comparison, NothingIsWorseThanItself) {
  const Comparison same = compared(report(20), report(20));
  EXPECT_EQ(same.compared, 4U);
  EXPECT_TRUE(same.worse.empty());
  EXPECT_TRUE(same.not_comparable.empty());
}

TEST(Comparison, EachFigureHasItsDirection) {
  EXPECT_EQ(worse(report(20), report(19)), Keys{"after.min_angle.min"});
  EXPECT_EQ(worse(report(20), report(21)), Keys{});
  EXPECT_EQ(worse(report(20, .1), report(20, .2)), Keys{"geometry.distance_to_input.max"});
  EXPECT_EQ(worse(report(20, .1), report(20, .05)), Keys{});
  EXPECT_EQ(worse(report(20, .1, .01), report(20, .1, -.02)), Keys{"geometry.area_change"});
  EXPECT_EQ(worse(report(20, .1, .01), report(20, .1, -.01)), Keys{});
  EXPECT_EQ(worse(report(20), report(20, .1, .01, 1)), Keys{"after.folded_edges"});
}

TEST(Comparison, IsWithinTheTolerance) {
  EXPECT_EQ(worse(report(20), report(19), .05), Keys{});
  EXPECT_EQ(worse(report(20), report(18.9), .05), Keys{"after.min_angle.min"});
  EXPECT_EQ(worse(report(20, 0), report(20, 1e-9)), Keys{});  // of a diagonal of 2
  EXPECT_EQ(worse(report(20, 0), report(20, 3e-9)), Keys{"geometry.distance_to_input.max"});
}

TEST(Comparison, OfOneThatIsWorseTheOtherIsNot) {
  for (double now : {10., 19.9, 20., 20.1, 40.})
    EXPECT_FALSE(!worse(report(20), report(now)).empty() && !worse(report(now), report(20)).empty());
}

TEST(Comparison, SaysWhatIsNotComparable) {
  Json other = report(20);
  other["input"]["sha256"] = "ef";
  other["parameters"]["L"] = .25;
  other["parameters"]["polish"] = true;
  other["after"]["folded_edges"] = nullptr;
  const Keys always = {"it has no parameters.polish", "there is no after.folded_edges now"};
  Keys reasons = compared(report(20), other).not_comparable;
  EXPECT_EQ(reasons, (Keys{"it is of another input", always[0], always[1]}));
  other["input"]["sha256"] = "ab";
  reasons = compared(report(20), other).not_comparable;
  EXPECT_EQ(reasons, (Keys{"parameters.L was 0.5, and is 0.25", always[0], always[1]}));
  reasons = compared(other, report(20)).not_comparable;
  EXPECT_EQ(reasons[1], "parameters.polish was true, and is not there now");
}

TEST(Comparison, OfACheckIsOfTheInputs) {
  Json check = report(20);
  check["after"] = check["geometry"] = nullptr;
  check["before"]["min_angle"]["min"] = .5;
  const Comparison c = compared(report(20), check);
  EXPECT_EQ(c.compared, 1U);
  ASSERT_EQ(c.worse.size(), 1U);
  EXPECT_EQ(in_words(c.worse[0]), "before.min_angle.min: 1 -> 0.5 (50 % worse)");
}

TEST(Comparison, SharesAreOfTheDistanceGone) {
  EXPECT_EQ(in_words({"after.min_angle.min", 10, -5}), "after.min_angle.min: 10 -> -5 (150 % worse)");
  EXPECT_EQ(in_words({"geometry.area_change", .1, -.2}), "geometry.area_change: 0.1 -> -0.2 (100 % worse)");
}

TEST(Comparison, RefusesWhatIsNoReport) {
  for (const char* text : {"1", "[]", "{}", R"({"schema": "other", "input": {}, "parameters": {}})"})
    EXPECT_ERROR(Error, "is no report", figures_of(Json::parse(text)));
}

}  // namespace hooke::comparison_test
