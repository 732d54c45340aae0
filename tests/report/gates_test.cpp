#include "hooke/report/gates.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hooke/core/error.h"
#include "support/errors.h"

namespace hooke::gates_test {

const nlohmann::ordered_json report = {
    {"after", {{"min_angle", {{"min", 21.5}, {"median", nullptr}}}, {"worst_faces", {{{"face", 7}}}}}},
    {"promises", {{"kept", true}}},
    {"output", nullptr},
    {"status", "stalled"}};

bool passes(const std::string& condition) {
  return judge_gates({parse_gate(condition)}, report)[0].passed;
}

TEST(Gates, EachRelationIsTheNumbersOwn) {
  EXPECT_TRUE(passes("after.min_angle.min >= 21.5"));
  EXPECT_FALSE(passes("after.min_angle.min > 21.5"));
  EXPECT_TRUE(passes("after.min_angle.min<=21.5"));
  EXPECT_FALSE(passes("after.min_angle.min <21.5"));
  EXPECT_TRUE(passes(" after.min_angle.min==2.15e1 "));
  EXPECT_FALSE(passes("after.min_angle.min != 21.5"));
}

TEST(Gates, ReachListsAndWhatIsTrue) {
  EXPECT_TRUE(passes("after.worst_faces.0.face == 7"));
  EXPECT_TRUE(passes("promises.kept == 1"));
}

TEST(Gates, FailWhereTheReportHasNoValue) {
  EXPECT_FALSE(passes("after.min_angle.median > -1"));
  EXPECT_FALSE(passes("output.area != 0"));
  EXPECT_FALSE(judge_gates({parse_gate("output.area != 0")}, report)[0].value);
}

TEST(Gates, RefuseWhatIsNoConditionOrNoNumber) {
  for (const char* text : {"", "after", "after.min_angle.min", ">= 2", "a >= ", "a >= b", "a = 2",
                           "a >= 2 deg", "a >= inf", "a ! 2", "a >> 2"})
    EXPECT_ERROR(Error, fmt::format("'{}'; expected METRIC", text), parse_gate(text));
}

TEST(Gates, FailOnWhatIsNotThereAndOnWhatIsNoNumber) {
  for (const char* metric : {"after.min_angel.min", "after.min_angle", "after.worst_faces.1.face", "status",
                             "after.worst_faces.x", "after.min_angle.min.x", "after..min"})
    EXPECT_FALSE(passes(fmt::format("{} != 5", metric))) << metric;
}

TEST(Gates, AreRefusedBeforeTheWork) {
  for (const char* known :
       {"after.min_angle.min > 1", "before.worst_faces.9.face > 1", "resources.wall_s < 9",
        "promises.kept == 1", "resources.stages.remesh/fit.wall_s < 9"})
    EXPECT_NO_THROW(require_metrics({parse_gate(known)}, false)) << known;
  const auto refusal = [](const char* condition, bool check_only) {
    return test::message_of<Error>([&] { require_metrics({parse_gate(condition)}, check_only); });
  };
  EXPECT_TRUE(test::has(refusal("after.min_angel.min > 1", false), "did you mean after.min_angle.min?"));
  EXPECT_TRUE(test::has(refusal("after.min_angle > 1", false), "expected one such as after.min_angle.min"));
  EXPECT_TRUE(test::has(refusal("status == 1", false), "is not a number"));
  EXPECT_TRUE(test::has(refusal("after.min_angle.min > 1", true), "such as before.min_angle.min"));
  for (const char* of_result : {"geometry.flipped_faces == 0", "output.area > 0", "promises.kept == 1"})
    EXPECT_TRUE(test::has(refusal(of_result, true), "--check has none of")) << of_result;
  EXPECT_NO_THROW(require_metrics({parse_gate("before.min_angle.min > 1")}, true));
}

}  // namespace hooke::gates_test
