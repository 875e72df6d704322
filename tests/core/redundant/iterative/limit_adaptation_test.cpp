#include "core/redundant/iterative/limit_adaptation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

const AdaptationOptions constants;

TEST(LimitAdaptation, CoarseExcessLowersTheNeighboursToo) {
  std::vector<double> limits(7, 60000);
  const std::vector<double> coarse{0, 0, 0, 20000, 0, 0, 0}, fine(7, 0);
  EXPECT_TRUE(adapt(limits, 0, {coarse, 16000}, {fine, 60000}, 1, constants));
  EXPECT_EQ(limits, std::vector<double>({60000, 58400, 57200, 56000, 57200, 58400, 60000}));
}

/// 20 000 has to become 16 000: a fifth less.
TEST(LimitAdaptation, InProportionToTheCoarseExcess) {
  AdaptationOptions proportional;
  proportional.proportional = true;
  std::vector<double> limits(2, 60000);
  EXPECT_TRUE(adapt(limits, 0, {{20000, 0}, 16000}, {{0, 0}, 60000}, 1, proportional));
  EXPECT_NEAR(limits[0], 48000, 1e-9);
  EXPECT_NEAR(limits[1], 60000 - 0.7 * 12000, 1e-9);
}

TEST(LimitAdaptation, WithLargerStepsMoreFallsFromPassToPass) {
  double before = 0;
  for (int kept = 1; kept <= 40; ++kept) {
    const AdaptationOptions o = with_larger_steps(constants, kept);
    EXPECT_TRUE(o.proportional);
    EXPECT_GE(o.least_change, before);
    EXPECT_LE(o.least_change, 0.06 + 1e-12);
    before = o.least_change;
  }
  EXPECT_EQ(with_larger_steps(constants, 1).least_change, constants.least_change);
  EXPECT_NEAR(with_larger_steps(constants, 3).least_change, 2.25 * constants.least_change, 1e-12);
}

TEST(LimitAdaptation, FineExcessLowersItsBlock) {
  std::vector<double> limits(3, 60000);
  EXPECT_TRUE(adapt(limits, 0, {{0, 0, 0}, 16000}, {{0, 62000, 60000}, 60000}, 1, constants));
  EXPECT_EQ(limits, std::vector<double>({60000, 57700, 60000}));
}

/// (4.40): in the first iteration not below the coarse limit, then a twentieth less each time.
TEST(LimitAdaptation, TheAnchorHolds) {
  for (int iteration = 1; iteration <= 30; ++iteration) {
    std::vector<double> limits{60000};
    adapt(limits, 0, {{1e6}, 16000}, {{0}, 60000}, iteration, constants);
    EXPECT_NEAR(limits[0], 16000 * std::max(1 - (iteration - 1) / 20.0, 0.05), 1e-9);
  }
  std::vector<double> low{500};  // below the anchor already: it does not rise
  EXPECT_FALSE(adapt(low, 0, {{1e6}, 16000}, {{0}, 60000}, 1, constants));
  EXPECT_EQ(low[0], 500);
}

TEST(LimitAdaptation, NothingEverRises) {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> limits(12), coarse(8), fine(8);
    for (double& v : limits) v = random.uniform(1000, 60000);
    for (double& v : coarse) v = random.uniform(0, 20000);
    for (double& v : fine) v = random.uniform(0, 80000);
    const std::vector<double> before = limits;
    const bool fell =
        adapt(limits, 3, {coarse, 16000}, {fine, 60000}, 1 + static_cast<int>(random.below(25)), constants);
    bool any = false;
    for (std::size_t i = 0; i < limits.size(); ++i) {
      EXPECT_LE(limits[i], before[i]);
      EXPECT_GE(limits[i], std::min(before[i], 800.0));
      any = any || limits[i] < before[i];
      if (i < 3 || i >= 11) {
        EXPECT_EQ(limits[i], before[i]);
      }
    }
    EXPECT_EQ(any, fell);
  }
}

TEST(LimitAdaptation, FeedsFallByWhatVelocitiesExceed) {
  const CoarseFineMachine machine = test::md2();
  std::vector<SplitPeaks> peaks(2);
  double feed = 1000;
  EXPECT_FALSE(adapt_feed(feed, 1000, peaks, machine, constants));
  peaks[1].fine_velocity = 2100;
  EXPECT_TRUE(adapt_feed(feed, 1000, peaks, machine, constants));
  EXPECT_NEAR(feed, 890, 1e-9);
  peaks[0].coarse_velocity = 1e5;
  EXPECT_TRUE(adapt_feed(feed, 1000, peaks, machine, constants));
  EXPECT_EQ(feed, 50);  // the least one
}

/// End of [Bock 4.3.2].
TEST(LimitAdaptation, PositioningIsAsFastAsTheCoarseAxesAre) {
  const JointTask task = test::joint_task(test::straight(30, 40), test::md2());
  EXPECT_NEAR(first_feed(*task.path, 0, unlimited, task.machine), std::hypot(1800, 1800.0 * 30 / 40), 1e-9);
  EXPECT_EQ(first_feed(*task.path, 0, 400, task.machine), 400);
}

}  // namespace
}  // namespace bahnwerk
