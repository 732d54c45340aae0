#include "hooke/report/report_keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

namespace hooke::report_keys_test {

std::string parent_of(const std::string& path) {
  const size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

/// The key of the table with this path, or the one that a path of a report names.
const ReportKey& key(const std::string& path) {
  const auto same = std::ranges::find(report_keys(), path, &ReportKey::path);
  if (same != report_keys().end()) return *same;
  const ReportKey* const found = find_report_key(path);
  if (found == nullptr) throw std::invalid_argument(path);
  return *found;
}

TEST(ReportKeys, StandOnceAfterWhatTheyAreIn) {
  std::set<std::string> seen = {""};
  for (const ReportKey& k : report_keys()) {
    EXPECT_TRUE(seen.contains(parent_of(k.path))) << k.path;
    EXPECT_TRUE(seen.insert(k.path).second) << k.path << " stands twice";
    EXPECT_FALSE(k.meaning.empty()) << k.path;
  }
}

TEST(ReportKeys, OnlyObjectsAndListsHaveKeysBelow) {
  for (const ReportKey& k : report_keys())
    if (!parent_of(k.path).empty()) {
      const ReportKey& parent = key(parent_of(k.path));
      EXPECT_EQ(parent.kind, k.path.ends_with("<n>") ? KeyKind::list : KeyKind::object) << k.path;
    }
}

TEST(ReportKeys, BeforeAndAfterHaveTheSame) {
  for (const ReportKey& k : report_keys())
    if (k.path.starts_with("before.")) {
      const ReportKey& after = key("after" + k.path.substr(6));
      EXPECT_EQ(after.kind, k.kind) << k.path;
      EXPECT_EQ(after.better, k.better) << k.path;
      EXPECT_TRUE(after.of_result);
      EXPECT_FALSE(k.of_result);
    }
}

TEST(ReportKeys, AreFoundByIndexAndName) {
  EXPECT_EQ(key("after.worst_faces.12.face").path, "after.worst_faces.<n>.face");
  EXPECT_EQ(key("resources.stages.remesh/fit.wall_s").path, "resources.stages.<name>.wall_s");
  for (const char* unknown : {"", "after.min_angel.min", "after.worst_faces.x.face", "after.min_angle.min.x",
                              "after..min", "after.min_angle.min."})
    EXPECT_EQ(find_report_key(unknown), nullptr) << unknown;
}

TEST(ReportKeys, AreGuessedFromWhatIsWrittenAlmostAlike) {
  EXPECT_EQ(nearest_number("after.min_angel.min"), "after.min_angle.min");
  EXPECT_EQ(nearest_number("geometry.fliped_faces"), "geometry.flipped_faces");
}

TEST(ReportKeys, SayWhichWayIsBetter) {
  EXPECT_EQ(key("after.min_angle.min").better, Better::higher);
  EXPECT_EQ(key("after.max_angle.max").better, Better::lower);
  EXPECT_EQ(key("after.length_error.std").better, Better::lower);
  EXPECT_EQ(key("geometry.area_change").better, Better::nearer_zero);
  EXPECT_EQ(key("after.edge_length.mean").better, Better::neither);
}

TEST(KeyListings, EveryValueStandsInTheTextOf80Columns) {
  std::istringstream text(keys_as_text());
  std::set<std::string> listed;
  for (std::string line; std::getline(text, line);) {
    EXPECT_LE(line.size(), 80U) << line;
    listed.insert(line.substr(0, line.find(' ')));
  }
  for (const ReportKey& k : report_keys())
    EXPECT_EQ(listed.contains(k.path), k.kind != KeyKind::object && k.kind != KeyKind::list) << k.path;
}

TEST(KeyListings, EveryKeyStandsOnThePage) {
  const std::string page = keys_as_page();
  for (const ReportKey& k : report_keys()) {
    const bool is_of_after = k.path == "after" || k.path.starts_with("after.");
    if (is_of_after || (k.path.starts_with("before.") && k.row == k.path)) continue;  // told for all at once
    EXPECT_NE(page.find("`" + k.path + "`"), std::string::npos) << k.path;
  }
}

}  // namespace hooke::report_keys_test
