#include "api/check_text.hpp"

#include <gtest/gtest.h>

#include <set>

namespace bahnwerk::api {
namespace {

std::string name(const Checked& what, double limit = 1) { return check_name(what, limit); }

TEST(CheckText, SubjectsStandWhereTheyAreSaid) {
  using enum CheckedQuantity;
  EXPECT_EQ(name({axis, 0, "mm", "x"}), "range x");
  EXPECT_EQ(name({axis, 3, "rad", "q2"}), "jerk q2");
  EXPECT_EQ(name({axis, 4, "mm", "y"}), "snap y");
  EXPECT_EQ(name({continuity, 1}), "continuity of velocity");
  EXPECT_EQ(name({continuity, 1, "mm", "coarse"}), "coarse continuity of velocity");
  EXPECT_EQ(name({rows, 2, "mm", "coarse"}), "coarse setpoints acceleration");
  EXPECT_EQ(name({wires_missing, 0, "1", "raabe, head"}), "wires missing raabe, head");
  EXPECT_EQ(name({path, 2}), "path acceleration");
  EXPECT_EQ(name({path_differences, 1}), "setpoint path velocity");
}

TEST(CheckText, FeedsAreTheirLimits) {
  EXPECT_EQ(name({CheckedQuantity::feed, 1}, 400), "path velocity (feed 400)");
  EXPECT_EQ(name({CheckedQuantity::feed, 1}, 0.125), "path velocity (feed 0.125)");
}

TEST(CheckText, GroupsAreLimitsGeometryContinuitySetpointsAndBound) {
  using enum CheckedQuantity;
  EXPECT_STREQ(check_group({axis, 2, "mm", "x"}), "limit");
  EXPECT_STREQ(check_group({deviation}), "geometry");
  EXPECT_STREQ(check_group({wire_overlap}), "geometry");
  EXPECT_STREQ(check_group({corner_rest, 1}), "continuity");
  EXPECT_STREQ(check_group({rows, 1}), "setpoints");
  EXPECT_STREQ(check_group({axis_differences, 2}), "setpoints");
  EXPECT_STREQ(check_group({bound, 0, "s"}), "bound");
  const auto named_group = [](const char* name) { return std::string(check_group({named, 0, "1", name})); };
  EXPECT_EQ(named_group("continuity jerk"), "continuity");
  EXPECT_EQ(named_group("table v"), "setpoints");
  EXPECT_EQ(named_group("section limit velocity"), "limit");
  EXPECT_EQ(named_group("cam undercut"), "geometry");
  EXPECT_EQ(named_group("objective"), "bound");
}

TEST(CheckText, UnitsFollowTheOrder) {
  const CheckedQuantity axis = CheckedQuantity::axis;
  EXPECT_EQ(check_unit({axis, 0, "rad"}), "rad");
  EXPECT_EQ(check_unit({axis, 1, "mm"}), "mm/s");
  EXPECT_EQ(check_unit({axis, 2, "mm"}), "mm/s²");
  EXPECT_EQ(check_unit({axis, 3, "mm"}), "mm/s³");
  EXPECT_EQ(check_unit({axis, 4, "deg"}), "deg/s⁴");
}

TEST(CheckText, EveryQuantityHasANameOfItsOwn) {
  std::set<std::string> names;
  int count = 0;
  for (int q = 1; q <= static_cast<int>(CheckedQuantity::path_differences); ++q, ++count) {
    const std::string text = name({static_cast<CheckedQuantity>(q), 1, "mm", "x"});
    EXPECT_NE(text, "x") << q;
    EXPECT_TRUE(names.insert(text).second) << text;
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(count));
}

}  // namespace
}  // namespace bahnwerk::api
