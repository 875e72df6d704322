#include "core/numeric/large_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <thread>

namespace bahnwerk {
namespace {

TEST(LargePages, ArraysGrowAndKeepTheirContent) {
  LargeVector<double> v;
  for (int i = 0; i < 600'000; ++i) v.push_back(i);
  const LargeVector<double> copy = v;
  v.resize(3'000'000, 7);
  v.shrink_to_fit();
  EXPECT_EQ(std::accumulate(copy.begin(), copy.end(), 0.0), 600'000.0 * 599'999.0 / 2);
  EXPECT_EQ(v[599'999], 599'999);
  EXPECT_EQ(v.back(), 7);
}

TEST(LargePages, FreedMemoryIsReused) {
  const std::size_t bytes = 3 * large_pages::least;
  void* const first = large_pages::take(bytes);
  large_pages::give(first, bytes);
  void* const second = large_pages::take(bytes - 100);  // the same size class
  EXPECT_EQ(first, second);
  void* const third = large_pages::take(bytes);
  EXPECT_NE(third, second);
  large_pages::give(second, bytes - 100);
  large_pages::give(third, bytes);
}

TEST(LargePages, GiveBackLeavesNothingKept) {
  { const LargeVector<double> array(1'000'000); }
  EXPECT_GE(large_pages::kept(), 8'000'000U);
  large_pages::give_back();
  EXPECT_EQ(large_pages::kept(), 0U);
  const LargeVector<double> again(1'000'000, 3);
  EXPECT_EQ(again.back(), 3);
}

TEST(LargePages, NoTwoTakersShareMemory) {
  const auto work = [](double id) {
    for (int round = 0; round < 50; ++round) {
      LargeVector<double> v(20'000 + 5'000 * static_cast<std::size_t>(round % 7), id);
      for (const double x : v) ASSERT_EQ(x, id);
    }
  };
  std::thread a(work, 1), b(work, 2), c(work, 3);
  a.join();
  b.join();
  c.join();
}

TEST(LargePages, RefusesWhatNobodyHas) {
  LargeVector<double> v;
  EXPECT_ANY_THROW(v.reserve(SIZE_MAX / 16));
}

}  // namespace
}  // namespace bahnwerk
