// The source's known methods: every split is valid, each does what it is known for, none is as fast as the joint plan.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/redundant/methods/method_table.hpp"
#include "core/redundant/redundancy.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/frames.hpp"
#include "tests/core/redundant/known/known_plans.hpp"
#include "tests/core/redundant/split_excess.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid, test::known_methods, test::plan;

TEST(KnownMethods, AreValidAndNoneIsFasterThanTheJointPlan) {
  for (const CoarseFineMachine& machine : {test::md1(), test::md2()}) {
    const RedundancyTask task = test::redundancy_task(test::holes(4, 3, 12, 2), machine);
    const double joint = plan(task, RedundancyMethod::joint).head->duration();
    for (const RedundancyMethod method : known_methods) {
      SCOPED_TRACE(name_of<RedundancyMethod>(method, redundancy_methods));
      const RedundancyResult r = plan(task, method);
      expect_valid(task, r);
      EXPECT_GT(r.head->duration(), joint * (1 - 1e-9));
    }
  }
}

TEST(KnownMethods, RandomContoursAreValid) {
  Random random(11);
  std::map<RedundancyMethod, double> total;  // times the fastest motion of the head
  const int contours = testing::cases(20);
  for (int n = 0; n < contours; ++n) {
    const Contour contour = test::random_contour(random, 100, 2, 5);
    const RedundancyTask task = test::redundancy_task(contour, random.below(2) ? test::md1() : test::md2());
    for (const RedundancyMethod method : known_methods) {
      SCOPED_TRACE(std::to_string(n) + std::string(" ") +
                   std::string(name_of<RedundancyMethod>(method, redundancy_methods)));
      const RedundancyResult r = plan(task, method);
      expect_valid(task, r);
      EXPECT_GE(r.head->duration(), r.fastest * (1 - 1e-9));
      total[method] += r.head->duration() / r.fastest;
    }
  }
  // What each costs in the mean: the head waits for nothing, for the filter's blocks, for the coarse axes' lag.
  EXPECT_NEAR(total[RedundancyMethod::geometric], contours, 1e-6 * contours);
  EXPECT_NEAR(total[RedundancyMethod::follow_up], contours, 1e-6 * contours);
  EXPECT_LT(total[RedundancyMethod::filter], 1.8 * contours);
  EXPECT_LT(total[RedundancyMethod::lag_compensation], 2.2 * contours);
}

TEST(KnownMethods, PlansDoNotDependOnTheFrame) {
  for (const RedundancyMethod method : known_methods)
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(std::to_string(seed) + std::string(name_of<RedundancyMethod>(method, redundancy_methods)));
      const auto duration = [&](const test::Frame& frame) {
        return plan(test::redundancy_task(test::framed(seed, frame), test::md2()), method).head->duration();
      };
      const double here = duration({});
      for (const test::Frame& frame : test::other_frames) EXPECT_NEAR(duration(frame), here, 1e-6 * here);
      // A lag is not symmetric in time.
      if (method != RedundancyMethod::lag_compensation) {
        EXPECT_NEAR(duration(test::backwards), here, 1e-5 * here);
      }
    }
}

/// Where an axis stands centred at rest it does so with every method, at both ends.
TEST(KnownMethods, FineAxesAreCentredAtBothEndsWhereTheyHaveToBe) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.centred = true;
  for (const std::uint64_t seed : {3u, 4u}) {
    const RedundancyTask task = test::redundancy_task(test::framed(seed, {}), machine);
    for (const auto& method : redundancy_methods) {
      if (method.value == RedundancyMethod::joint) continue;
      SCOPED_TRACE(method.name);
      const RedundancyResult r = plan(task, method.value);
      expect_valid(task, r);
      for (const double t : {0.0, r.head->duration()}) {
        const MotionState x = r.head->evaluate(t), c = r.coarse->evaluate(t);
        for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(x[0][k], c[0][k], 1e-8) << t;
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk
