#include "core/plan/motion_law/planned_law.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

cam::MotionPoint at(double angle, cam::Range position) {
  cam::MotionPoint point;
  point.at = {angle, angle};
  point.values = {position};
  return point;
}

/// A rise of 10 mm within 90° of a second's turn: 40 mm/s in the mean.
TEST(PlannedLaw, TheMeanVelocityBetweenTwoPointsIsABound) {
  cam::MotionLawProblem law;
  law.cycle_duration = 1;
  law.objective.weight = {0, 2, 0, 0};
  law.points = {at(0, {0, 0}), at(90, {10, 10}), at(360, {0, 0})};
  EXPECT_DOUBLE_EQ(mean_velocity_bound(law), 2 * 40);
  law.points[1].values[0] = {6, 10};  // the least way counts
  EXPECT_DOUBLE_EQ(mean_velocity_bound(law), 2 * 24);
  law.points[1].values[0] = {-1, 10};
  EXPECT_EQ(mean_velocity_bound(law), 0) << "it may stay where it is";
  law.points[1] = at(90, {10, 10});
  law.points[1].at = {60, 120};  // and the widest angle
  EXPECT_DOUBLE_EQ(mean_velocity_bound(law), 2 * 30);
}

}  // namespace
}  // namespace bahnwerk
