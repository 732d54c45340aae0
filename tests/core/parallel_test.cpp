#include "hooke/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace hooke::parallel_test {

TEST(Parallel, EveryIndexIsVisitedOnce) {
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    for (size_t count : {size_t{0}, size_t{1}, size_t{63}, size_t{64}, size_t{65}, size_t{1000}}) {
      std::vector<std::atomic<int>> visits(count);
      parallel_for(count, 64, [&](size_t begin, size_t end) {
        EXPECT_LT(begin, end);
        for (size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (size_t i = 0; i < count; ++i) EXPECT_EQ(visits[i], 1) << i << " of " << count;
    }
  }
}

TEST(Parallel, SumsHaveTheSameBitsForAnyNumberOfThreads) {
  const auto harmonic = [](size_t begin, size_t end) {
    double sum = 0;
    for (size_t i = begin; i < end; ++i) sum += 1 / (1. + static_cast<double>(i));
    return sum;
  };
  std::vector<double> sums;
  for (int threads : {1, 2, 0}) {
    const ThreadLimit limit(threads);
    sums.push_back(parallel_sum(100001, 128, harmonic));
  }
  EXPECT_EQ(sums[0], sums[1]);
  EXPECT_EQ(sums[0], sums[2]);
  EXPECT_NEAR(sums[0], std::log(100001) + .57721566490153286 + .5 / 100001, 1e-10);
  EXPECT_EQ(parallel_sum(0, 128, harmonic), 0);
}

TEST(Parallel, BothAreInvokedAndAnExceptionOfEitherArrives) {
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    int first = 0, second = 0;
    parallel_invoke([&] { ++first; }, [&] { ++second; });
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 1);
    const auto fails = [] { throw std::runtime_error("one of two"); };
    EXPECT_THROW(parallel_invoke(fails, [] {}), std::runtime_error);
    EXPECT_THROW(parallel_invoke([] {}, fails), std::runtime_error);
  }
}

TEST(Parallel, AnExceptionOfTheBodyArrives) {
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const auto fails = [](size_t begin, size_t end) {
      if (begin <= 777 && 777 < end) throw std::runtime_error("777");
    };
    EXPECT_THROW(parallel_for(1000, 10, fails), std::runtime_error);
    EXPECT_THROW(parallel_sum(1000, 10,
                              [&](size_t begin, size_t end) {
                                fails(begin, end);
                                return 0.;
                              }),
                 std::runtime_error);
    std::vector<int> pieces(1000);
    size_t made = 0;
    const auto make = [&] { return made < pieces.size() ? &pieces[made++] : nullptr; };
    EXPECT_THROW(parallel_pipeline<int>(make, [](int&) { throw std::runtime_error("use"); }),
                 std::runtime_error);
    EXPECT_THROW(parallel_pipeline<int>([]() -> int* { throw std::runtime_error("make"); }, [](int&) {}),
                 std::runtime_error);
  }
}

TEST(Parallel, APipelineUsesEveryPieceOnceAndMakesThemOneByOne) {
  for (int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    std::atomic<int> makers = 0;
    int made = 0;
    std::vector<std::atomic<int>> used(1000);
    parallel_pipeline<std::atomic<int>>(
        [&]() -> std::atomic<int>* {
          EXPECT_EQ(++makers, 1);
          std::atomic<int>* piece = made < 1000 ? &used[made++] : nullptr;
          --makers;
          return piece;
        },
        [](std::atomic<int>& piece) { ++piece; });
    for (const auto& u : used) EXPECT_EQ(u, 1);
  }
}

TEST(Parallel, ALimitEndsWithItsLifeAndANestedOneDoesNotRaiseIt) {
  const int before = thread_count();
  {
    const ThreadLimit one(1);
    EXPECT_EQ(thread_count(), 1);
    const ThreadLimit two(2);
    EXPECT_EQ(thread_count(), 1);
  }
  EXPECT_EQ(thread_count(), before);
  EXPECT_GE(before, 1);
}

}  // namespace hooke::parallel_test
