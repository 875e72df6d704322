// Which configuration a machine takes along a path, and what it says where there is none.
#include "core/motion/axes/machine_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/errors.hpp"
#include "needle_loop.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

RobotArm arm_of(const MachinePath& path) { return dynamic_cast<const RobotWinder&>(*path.kinematics).arm(); }

std::vector<std::shared_ptr<const Kinematics>> arms(const RobotWinderSizes& sizes, const std::vector<Limits>& limits) {
  return {std::make_shared<const RobotWinder>(sizes, RobotArm::lefty, limits),
          std::make_shared<const RobotWinder>(sizes, RobotArm::righty, limits)};
}

TEST(MachinePath, SpansAreThoseOfADenseSearch) {
  const test::NeedlePath path = test::stator_turn();
  for (const test::Winder& winder : test::winders()) {
    const MachinePath made = machine_path(path.tool, path.orientation, winder.configurations);
    ASSERT_EQ(made.spans.size(), 5u);
    std::vector<AxisSpan> dense(5, {unlimited, -unlimited});
    AxisArray last{};
    for (std::size_t i = 0; i < made.axes->size(); ++i)
      for (int j = 0; j <= 20000; ++j) {
        const Curve& curve = path.tool[i].curve();
        const AxisArray q = made.axes->at_parameter(i, curve.begin() + (curve.end() - curve.begin()) * j / 20000).value;
        for (std::size_t k = 0; k < 5; ++k) {
          dense[k].lowest = std::min(dense[k].lowest, q[k]), dense[k].highest = std::max(dense[k].highest, q[k]);
          if (i + static_cast<std::size_t>(j) > 0) dense[k].travel += std::abs(q[k] - last[k]);
        }
        last = q;
      }
    for (std::size_t k = 0; k < 5; ++k) {
      const double unit = 1 + dense[k].travel;
      EXPECT_NEAR(made.spans[k].lowest, dense[k].lowest, 1e-8 * unit) << winder.name << k;
      EXPECT_NEAR(made.spans[k].highest, dense[k].highest, 1e-8 * unit) << winder.name << k;
      EXPECT_NEAR(made.spans[k].travel, dense[k].travel, 1e-6 * unit) << winder.name << k;
      const std::size_t there = path.tool.find(made.spans[k].highest_at);
      EXPECT_NEAR(made.axes->at(there, made.spans[k].highest_at).value[k], made.spans[k].highest, 1e-8 * unit);
    }
  }
}

TEST(MachinePath, TheArmThatTravelsLessIsTaken) {
  RobotWinderSizes sizes = test::robot_sizes();
  const test::NeedlePath path = test::stator_turn();
  const std::vector<Limits> free(5);
  const auto both = arms(sizes, free);
  double least = unlimited;
  RobotArm expected = RobotArm::lefty;
  for (const auto& arm : both) {
    double sum = 0;
    for (const AxisSpan& span : axis_spans(KinematicAxisPath(path.tool, *arm, path.orientation))) sum += span.travel;
    if (sum < least) least = sum, expected = dynamic_cast<const RobotWinder&>(*arm).arm();
  }
  const MachinePath made = machine_path(path.tool, path.orientation, both);
  EXPECT_EQ(arm_of(made), expected);
  EXPECT_NEAR(made.travel, least, 1e-9);
  // The mirror image of the path takes the other arm.
  const test::NeedlePath mirrored = test::stator_turn(80, 180, -std::numbers::pi / 4);
  const double own = made.travel, other = machine_path(mirrored.tool, mirrored.orientation, both).travel;
  EXPECT_NEAR(own, other, 1e-6 * own);
  EXPECT_NE(arm_of(machine_path(mirrored.tool, mirrored.orientation, both)), expected);
}

TEST(MachinePath, RangesComeBeforeTravel) {
  const test::NeedlePath path = test::stator_turn();
  const RobotArm free =
      arm_of(machine_path(path.tool, path.orientation, arms(test::robot_sizes(), std::vector<Limits>(5))));
  std::vector<Limits> limits(5);
  (free == RobotArm::lefty ? limits[1].lowest : limits[1].highest) = 0;  // the elbow may not bend that way
  EXPECT_NE(arm_of(machine_path(path.tool, path.orientation, arms(test::robot_sizes(), limits))), free);
}

TEST(MachinePath, AnArmTooShortIsNamedWithItsPlace) {
  const test::NeedlePath path = test::stator_turn();
  RobotWinderSizes sizes = test::robot_sizes();
  sizes.l1 = 230, sizes.l2 = 240;
  try {
    machine_path(path.tool, path.orientation, arms(sizes, std::vector<Limits>(5)));
    ADD_FAILURE();
  } catch (const UnreachablePose& e) {
    EXPECT_NE(std::string(e.what()).find("470"), std::string::npos) << e.what();
    EXPECT_GE(e.path_length, 0);
    EXPECT_LE(e.path_length, path.tool.length());
    EXPECT_LE(norm(Vec{e.pose[0], e.pose[1], e.pose[2]} - path.tool.at(e.path_length).value), 1e-9);
  }
}

TEST(MachinePath, ARangeThatIsTooSmallIsNamedWithItsPlace) {
  const test::NeedlePath path = test::stator_turn();
  std::vector<Limits> limits = test::vertical_limits();
  limits[0].lowest = 400;  // the stroke would go higher
  try {
    machine_path(path.tool, path.orientation, {std::make_shared<const VerticalWinder>(VerticalWinderSizes{}, limits)});
    ADD_FAILURE();
  } catch (const UnreachablePose& e) {
    EXPECT_NE(std::string(e.what()).find("axis q1"), std::string::npos) << e.what();
    EXPECT_GT(e.path_length, 180);
    EXPECT_GT(e.pose[2], 180);
  }
  // A machine without swivel cannot wind a distributed winding.
  limits = test::horizontal_limits();
  limits[4].lowest = limits[4].highest = 0;
  const std::vector<std::shared_ptr<const Kinematics>> rigid{
      std::make_shared<const HorizontalWinder>(HorizontalWinderSizes{}, limits)};
  EXPECT_THROW(machine_path(path.tool, path.orientation, rigid), UnreachablePose);
  const test::NeedlePath about = test::helix(60, 1, 20);
  EXPECT_NO_THROW(machine_path(about.tool, about.orientation, rigid));
}

}  // namespace
}  // namespace bahnwerk
