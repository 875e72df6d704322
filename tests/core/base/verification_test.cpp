// Checks as data: how they are found, which of them a slower motion helps; and bounds from both sides.
#include "core/base/verification.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

Check check(const Quantity& quantity, int order, std::string subject, bool passed = true) {
  Check made;
  made.quantity = quantity, made.order = order, made.subject = std::move(subject), made.passed = passed;
  return made;
}

TEST(Verification, ChecksAreFoundByQuantityOrderAndSubject) {
  Verification verdict{true, {}, {}};
  verdict.add(
      std::vector<Check>{check(quantity::axis, 2, "x"), check(quantity::axis, 3, "x"), check(quantity::axis, 2, "y")});
  EXPECT_EQ(verdict.find(quantity::axis, 2, "y"), &verdict.checks[2]);
  EXPECT_EQ(verdict.find(quantity::axis, 3, "x"), &verdict.checks[1]);
  EXPECT_EQ(verdict.find(quantity::axis, 4, "x"), nullptr);
  EXPECT_EQ(verdict.find(quantity::path, 2, "x"), nullptr);
  EXPECT_EQ(verdict.find(quantity::axis, 2), nullptr);
}

TEST(Verification, OneCheckThatFailsFailsTheWhole) {
  Verification verdict{true, {}, {}};
  verdict.add(check(quantity::axis, 1, "x"));
  EXPECT_TRUE(verdict.passed);
  verdict.add(check(quantity::axis, 1, "y", false));
  verdict.add(check(quantity::axis, 1, "z"));
  EXPECT_FALSE(verdict.passed);
}

TEST(Check, DerivativesFallWhereTheMotionIsSlower) {
  for (int order = 1; order <= 4; ++order)
    for (const Quantity& quantity : {quantity::axis, quantity::path, quantity::joint_step})
      EXPECT_TRUE(falls_with_speed(check(quantity, order, "x"))) << order;
  EXPECT_FALSE(falls_with_speed(check(quantity::axis, 0, "x"))) << "a range is left at any speed";
  EXPECT_FALSE(falls_with_speed(check(quantity::continuity, 1, "")));
  EXPECT_FALSE(falls_with_speed(check(quantity::rows, 1, "")));
  EXPECT_FALSE(falls_with_speed(check(quantity::rows_end, 0, "")));
}

TEST(Bound, GapsAreFractionsFromBothSides) {
  EXPECT_NEAR(with_gap({2, 0, "a"}, 3).gap, 0.5, 1e-15);
  const Bound wires{12, 0, "b", BoundQuantity::count, BoundSense::upper, "1"};
  EXPECT_NEAR(with_gap(wires, 10).gap, 0.2, 1e-15);
  EXPECT_LT(with_gap(wires, 13).gap, 0);
  EXPECT_EQ(with_gap(wires, 0).gap, 0);
  EXPECT_EQ(with_gap({0, 0, "c"}, 3).gap, 0);
  EXPECT_EQ(with_gap({1, 0, "d"}, 1 - 1e-15).gap, 0) << "rounding";
  EXPECT_LT(with_gap({1, 0, "e"}, 1 - 1e-12).gap, 0);
}

}  // namespace
}  // namespace bahnwerk
