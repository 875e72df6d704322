// Which of many values is kept.
#include "core/verify/worst.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();

TEST(Strained, KeepsTheLargestShareOfItsLimit) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> size(-18, 2);
  for (int round = 0; round < 200; ++round) {
    Strained kept;
    double share = -1, value = 0, limit = 0, at = 0;
    for (int i = 0; i < 100; ++i) {
      const double bound = std::exp(size(random)), candidate = i % 7 == 3 ? 0 : bound * std::exp(size(random));
      kept.raise(candidate, bound, i);
      if (candidate / bound > share) share = candidate / bound, value = candidate, limit = bound, at = i;
    }
    EXPECT_EQ(kept.value, value);
    EXPECT_EQ(kept.limit, limit);
    EXPECT_EQ(kept.at, at);
  }
}

TEST(Strained, ALimitThatIsNoneCountsAsZero) {
  for (const double bound : {infinite, none, -infinite, 0.0}) {
    Strained kept;
    kept.raise(1, 2, 0);
    kept.raise(1e-9, bound, 1);
    EXPECT_EQ(kept.value, 1e-9);
    EXPECT_EQ(kept.limit, 0);
    EXPECT_EQ(kept.at, 1);
    kept.raise(5, 1, 2);  // not more strained than infinitely
    EXPECT_EQ(kept.at, 1);
  }
}

TEST(Strained, NotANumberStays) {
  Strained kept;
  kept.raise(3, 1, 0);
  kept.raise(none, 1, 1);
  kept.raise(1e9, 1, 2);
  kept.raise(1, 0, 3);
  EXPECT_TRUE(std::isnan(kept.value));
  EXPECT_EQ(kept.at, 1);
  EXPECT_FALSE(make_check(named(CheckGroup::limit, "a", "1"), kept).passed);
}

TEST(Strained, NothingStrainsNothing) {
  Strained kept;
  kept.raise(0, 0, 4);
  EXPECT_EQ(kept.value, 0);
  EXPECT_TRUE(make_check(named(CheckGroup::limit, "a", "1"), kept).passed);
}

TEST(Worst, KeepsTheLargestAndWhatIsNotANumber) {
  Worst worst;
  worst.raise(2, 1);
  worst.raise(1, 2);
  EXPECT_EQ(worst.value, 2);
  EXPECT_EQ(worst.at, 1);
  worst.raise(none, 3);
  worst.raise(9, 4);
  EXPECT_TRUE(std::isnan(worst.value));
  EXPECT_EQ(worst.at, 3);
}

}  // namespace
}  // namespace bahnwerk::verify
