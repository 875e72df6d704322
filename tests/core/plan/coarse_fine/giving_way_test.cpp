#include "core/plan/coarse_fine/giving_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk {
namespace {

Check check(const char* axis, double value, double limit) {
  return {{CheckedQuantity::axis, 1, "mm", axis}, limit, value, 0.5, value <= limit};
}

TEST(GivingWay, TheCheckThatFailedByMostIsTold) {
  Verification verdict;
  verdict.add(check("x", 3, 4));
  EXPECT_FALSE(failed_by_most(verdict));
  verdict.add(check("y", 1100, 1000));
  verdict.add(check("z", 3, 2));
  EXPECT_EQ(failed_by_most(verdict)->subject, "z");
  verdict.add(check("a", 1e-9, 0));
  EXPECT_EQ(failed_by_most(verdict)->subject, "a");
  Verification lost;
  lost.add(check("x", NAN, 1));
  lost.add(check("y", 5, 1));
  EXPECT_EQ(failed_by_most(lost)->subject, "x");
}

TEST(GivingWay, EachPlanIsReplacedByTheNextOne) {
  Verification verdict;
  verdict.add(check("xc", 12, 10));
  GivenUpPlans plans;
  EXPECT_TRUE(plans.empty());
  plans.add({{"filter", GivingWay::slower, 3, "joint", 2}});
  plans.add_failed("joint", 2, verdict);
  plans.add_without_motion("geometric");
  plans.add_failed("iterative", 1.5, verdict);
  const std::vector<GaveWay> table = plans.table({}, coarse_axes_alone, 4);
  ASSERT_EQ(table.size(), 4u);
  EXPECT_EQ(table[0].used, "joint");
  EXPECT_EQ(table[0].used_duration, 2);
  EXPECT_FALSE(table[0].failed);
  EXPECT_EQ(table[1].used, "geometric");
  EXPECT_EQ(table[1].used_duration, 0) << "it has no motion";
  EXPECT_EQ(table[1].failed->value, 12);
  EXPECT_EQ(table[2].reason, GivingWay::no_motion);
  EXPECT_EQ(table[2].used_duration, 1.5);
  EXPECT_EQ(table[3].used, coarse_axes_alone);
  EXPECT_EQ(table[3].used_duration, 4);
  EXPECT_EQ(plans.table({{"joint", GivingWay::no_motion, 0, coarse_axes_alone, 5}}, "joint", 5)[3].used, "joint");
}

}  // namespace
}  // namespace bahnwerk
