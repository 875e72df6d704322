#include "core/motion/setpoints/motion_setpoints.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

/// Two axes of degree 4 in one piece of 1 s, then at rest for 1 s.
std::shared_ptr<const Motion> motion() {
  return std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{1, {{1, 2, 3, 4, 5}, {0, 0, 0, 0, -1}}}, {2, {{15}, {-1}}}});
}
const Machine machine{{AxisLimits("x", 1), AxisLimits("b", 1)}, 0.25};

TEST(MotionSetpoints, RowsAreTheStatesJustAfterEachCycle) {
  const MotionSetpoints rows(motion(), machine, 8, 4);
  ASSERT_EQ(rows.count(), 9u);
  EXPECT_EQ(rows.duration(), 2);
  ASSERT_EQ(rows.columns().size(), 10u);
  EXPECT_EQ(rows.columns()[3].name, "vb");
  EXPECT_EQ(rows.columns()[6].name, "jx");
  EXPECT_EQ(rows.columns()[8].unit, "mm/s⁴");
  std::vector<double> all(90);
  rows.read(0, 9, all.data());
  const double t = 0.5;
  const double* row = &all[20];
  EXPECT_DOUBLE_EQ(row[0], 1 + t * (2 + t * (3 + t * (4 + t * 5))));
  EXPECT_DOUBLE_EQ(row[2], 2 + t * (6 + t * (12 + t * 20)));
  EXPECT_DOUBLE_EQ(row[4], 6 + t * (24 + t * 60));
  EXPECT_DOUBLE_EQ(row[6], 24 + t * 120);
  EXPECT_DOUBLE_EQ(row[8], 120);
  EXPECT_DOUBLE_EQ(row[9], -24);
  EXPECT_EQ(all[40], 15) << "where pieces meet the later one counts";
  EXPECT_EQ(all[42], 0);
  std::vector<double> slice(30);
  rows.read(3, 3, slice.data());
  for (std::size_t i = 0; i < slice.size(); ++i) EXPECT_EQ(slice[i], all[30 + i]);
}

TEST(MotionSetpoints, MotionsOfOtherAxesOrOrdersAreRefused) {
  const Machine one{{AxisLimits("x", 1)}, 0.25};
  EXPECT_THROW(MotionSetpoints(motion(), one, 8), std::invalid_argument);
  EXPECT_THROW(MotionSetpoints(motion(), machine, 8, 5), std::invalid_argument);
  EXPECT_THROW(MotionSetpoints(motion(), machine, 8, -1), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
