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
  for (const char* metric : {"after.min_angel.min", "after.min_angle", "after.worst_faces.1.face",
                             "after.worst_faces.x", "status", "after.min_angle.min.x", "", "after..min"})
    EXPECT_ERROR(Error, fmt::format("'{}': ", metric), metric_of(report, metric));
}

TEST(Gates, AreRefusedBeforeTheWork) {
  const nlohmann::ordered_json& block = report["after"];
  for (const char* known : {"after.min_angle.min > 1", "before.min_angle.min > 1",
                            "before.worst_faces.9.face > 1", "resources.wall_s < 9"})
    EXPECT_NO_THROW(require_metrics({parse_gate(known)}, block)) << known;
  EXPECT_THROW(require_metrics({parse_gate("before.angle.min > 1")}, block), Error);
}

TEST(Gates, NameTheKeysThatThereAre) {
  EXPECT_TRUE(test::has(test::message_of<Error>([] { metric_of(report, "after.min_angel.min"); }),
                        "expected one of min_angle, worst_faces"));
}

}  // namespace hooke::gates_test
