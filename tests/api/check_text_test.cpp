#include "api/check_text.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

std::string name(const Checked& what, double limit = 1) { return check_name(what, limit); }

TEST(CheckText, SubjectsStandWhereTheyAreSaid) {
  EXPECT_EQ(name({quantity::axis, 0, "mm", "x"}), "range x");
  EXPECT_EQ(name({quantity::axis, 3, "rad", "q2"}), "jerk q2");
  EXPECT_EQ(name({quantity::axis, 4, "mm", "y"}), "snap y");
  EXPECT_EQ(name({quantity::continuity, 1}), "continuity of velocity");
  EXPECT_EQ(name({quantity::continuity, 1, "mm", "coarse"}), "coarse continuity of velocity");
  EXPECT_EQ(name({quantity::rows, 2, "mm", "coarse"}), "coarse setpoints acceleration");
  EXPECT_EQ(name({{"wires missing", CheckGroup::geometry, true}, 0, "1", "raabe, head"}), "wires missing raabe, head");
  EXPECT_EQ(name({quantity::path, 2}), "path acceleration");
  EXPECT_EQ(name(named(CheckGroup::limit, "drive torque", "N m")), "drive torque");
}

TEST(CheckText, FeedsAreTheirLimits) {
  EXPECT_EQ(name({quantity::feed, 1}, 400), "path velocity (feed 400)");
  EXPECT_EQ(name({quantity::feed, 1}, 0.125), "path velocity (feed 0.125)");
}

TEST(CheckText, GroupsAreLimitsGeometryContinuitySetpointsAndBound) {
  EXPECT_STREQ(check_group({quantity::axis, 2, "mm", "x"}), "limit");
  EXPECT_STREQ(check_group({quantity::tip_position}), "geometry");
  EXPECT_STREQ(check_group({quantity::end_rest, 1}), "continuity");
  EXPECT_STREQ(check_group({quantity::rows, 1}), "setpoints");
  EXPECT_STREQ(check_group(named(CheckGroup::bound, "objective", "")), "bound");
}

TEST(CheckText, UnitsFollowTheOrder) {
  const Quantity& axis = quantity::axis;
  EXPECT_EQ(check_unit({axis, 0, "rad"}), "rad");
  EXPECT_EQ(check_unit({axis, 1, "mm"}), "mm/s");
  EXPECT_EQ(check_unit({axis, 2, "mm"}), "mm/s²");
  EXPECT_EQ(check_unit({axis, 3, "mm"}), "mm/s³");
  EXPECT_EQ(check_unit({axis, 4, "deg"}), "deg/s⁴");
}

}  // namespace
}  // namespace bahnwerk::api
