#include "hooke/core/stopwatch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace hooke::stopwatch_test {

void work_for(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < end) continue;
}

TEST(Stopwatch, NamesStagesByTheOnesTheyAreIn) {
  Stopwatch watch;
  {
    const Stage outer(&watch, "read");
    { const Stage inner(&watch, "parse"); }
    { const Stage inner(&watch, "build"); }
    { const Stage inner(&watch, "parse"); }
  }
  { const Stage other(&watch, "parse"); }
  std::vector<std::string> names;
  std::vector<long long> calls;
  for (const StageTime& s : watch.stages()) {
    names.push_back(s.name);
    calls.push_back(s.calls);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"read", "read/parse", "read/build", "parse"}));
  EXPECT_EQ(calls, (std::vector<long long>{1, 2, 1, 1}));
}

TEST(Stopwatch, AStageLastsAtLeastAsLongAsThoseWithinIt) {
  Stopwatch watch;
  timed(&watch, "outer", [&] {
    timed(&watch, "busy", [] { work_for(.02); });
    timed(&watch, "asleep", [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); });
  });
  const auto& s = watch.stages();
  ASSERT_EQ(s.size(), 3u);
  EXPECT_GE(s[1].wall_s, .02);
  EXPECT_GE(s[2].wall_s, .02);
  EXPECT_GE(s[0].wall_s, s[1].wall_s + s[2].wall_s);
  EXPECT_GE(s[0].cpu_s, s[1].cpu_s);
  EXPECT_LT(s[2].cpu_s, .02);  // sleeping costs no processor
  EXPECT_GT(s[0].peak_rss_bytes, 0);
}

TEST(Stopwatch, CpuTimeIsThatOfAllThreads) {
  Stopwatch watch;
  timed(&watch, "threads", [] {
    std::thread other([] { work_for(.03); });
    other.join();
  });
  EXPECT_GT(watch.stages()[0].cpu_s, 0);
}

TEST(Stopwatch, AnExceptionEndsItsStages) {
  Stopwatch watch;
  try {
    const Stage outer(&watch, "outer");
    timed(&watch, "inner", [] { throw 1; });
  } catch (int) {
  }
  { const Stage next(&watch, "next"); }
  EXPECT_EQ(watch.stages().back().name, "next");
}

TEST(Stopwatch, ReturnsWhatTheWorkReturnsWithOrWithoutAWatch) {
  Stopwatch watch;
  EXPECT_EQ(timed(&watch, "a", [] { return 3; }), 3);
  EXPECT_EQ(timed(nullptr, "a", [] { return 3; }), 3);
}

TEST(Stopwatch, TraceHasALinePerStage) {
  EXPECT_EQ(trace_csv({{"read", 1, .5, 1.25, 4096}, {"read/parse", 2, 0, 0, 8192}}),
            "stage,calls,wall_s,cpu_s,peak_rss_bytes\n"
            "read,1,0.500000,1.250000,4096\n"
            "read/parse,2,0.000000,0.000000,8192\n");
}

}  // namespace hooke::stopwatch_test
