// The robot against its chain of frames, and there and back at random poses.
#include "core/machine/robot_winder.hpp"

#include <gtest/gtest.h>

#include "frames.hpp"
#include "round_trip.hpp"
#include "winders.hpp"

namespace bahnwerk {
namespace {

using test::joint;

constexpr double pi = std::numbers::pi;

/// Poses that this arm takes, away from where it is straight.
auto reached_by(RobotArm arm) {
  return [arm](const AxisArray& q) {
    const double bend = arm == RobotArm::righty ? q[1] : -q[1];
    return bend > 0.02;
  };
}

/// [Herrmann table 3.1].
TEST(RobotWinder, ForwardIsTheProductOfItsFrames) {
  RobotWinderSizes sizes = test::robot_sizes();
  sizes.l2 = 330, sizes.part = {};
  const RobotWinder machine(sizes, RobotArm::lefty, test::robot_limits());
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    const AxisArray q = test::random_axes(machine, random, [](const AxisArray&) { return true; });
    const test::Frame chain = joint(0, 40, 0, 0) * joint(q[0], 0, sizes.l1, 0) * joint(q[1], 0, sizes.l2, 0) *
                              joint(0, q[2] - 40, 0, 0) * joint(q[3], 0, sizes.o_tool, -pi / 2) *
                              joint(q[4], 0, sizes.l_tool, 0);
    const ToolPose pose = machine.forward(q);
    EXPECT_LE(test::largest_difference(chain, test::euler(pose, -pi / 2)), 1e-12);
    ToolPose other = pose;  // Euler's angles with +π/2 in the middle
    other.phi += pi, other.psi += pi;
    EXPECT_LE(test::largest_difference(chain, test::euler(other, pi / 2)), 1e-12);
    const Vec along = pose.direction();
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(along[k], static_cast<double>(chain[k][0]), 1e-14);
  }
}

TEST(RobotWinder, ThePartMayStandAnywhere) {
  RobotWinderSizes sizes = test::robot_sizes(), moved = sizes;
  sizes.part = {}, moved.part = {{300, -40, 25}, 0.7};
  const RobotWinder bare(sizes, RobotArm::lefty, test::robot_limits()),
      machine(moved, RobotArm::lefty, test::robot_limits());
  const AxisArray q{0.3, -1.2, 120, 0.8, 0.4};
  const ToolPose in_machine = bare.forward(q), in_part = machine.forward(q);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Vec back = Vec{c * in_part.position.x - s * in_part.position.y, s * in_part.position.x + c * in_part.position.y,
                       in_part.position.z} +
                   Vec{300, -40, 25};
  EXPECT_LE(norm(back - in_machine.position), 1e-12);
  EXPECT_NEAR(in_part.phi + 0.7, in_machine.phi, 1e-15);
}

TEST(RobotWinder, PosesComeBack) {
  for (const RobotArm arm : {RobotArm::lefty, RobotArm::righty})
    test::poses_come_back(*test::robot(arm), reached_by(arm));
}

TEST(RobotWinder, ArmsOfUnequalLengthsToo) {
  for (const double l2 : {330.0, 470.0})
    for (const RobotArm arm : {RobotArm::lefty, RobotArm::righty}) {
      RobotWinderSizes sizes = test::robot_sizes();
      sizes.l2 = l2;
      const RobotWinder machine(sizes, arm, test::robot_limits());
      const auto bent_by = [arm](double least) {
        return [arm, least](const AxisArray& q) { return (arm == RobotArm::righty ? q[1] : -q[1]) > least; };
      };
      test::poses_come_back(machine, bent_by(0.02));
      test::derivatives_are_differences(machine, bent_by(0.15));
      test::bounds_hold(machine, bent_by(0.3));
    }
}

TEST(RobotWinder, DerivativesAreDifferences) {
  for (const RobotArm arm : {RobotArm::lefty, RobotArm::righty})
    test::derivatives_are_differences(
        *test::robot(arm), [arm](const AxisArray& q) { return (arm == RobotArm::righty ? q[1] : -q[1]) > 0.15; });
}

TEST(RobotWinder, BoundsHold) {
  test::bounds_hold(*test::robot(RobotArm::lefty), [](const AxisArray& q) { return q[1] < -0.3; });
}

TEST(RobotWinder, TheArmsDifferInTheElbowsSign) {
  const ToolPose pose{{40, 30, 100}, 0.6, 0.3};
  const AxisJet left = test::robot(RobotArm::lefty)->inverse(test::standing(pose)),
                right = test::robot(RobotArm::righty)->inverse(test::standing(pose));
  EXPECT_LT(left.value[1], 0);
  EXPECT_NEAR(right.value[1], -left.value[1], 1e-14);
  EXPECT_EQ(right.value[2], left.value[2]);
  EXPECT_EQ(right.value[4], left.value[4]);
  for (const AxisJet& q : {left, right}) EXPECT_NEAR(q.value[0] + q.value[1] + q.value[3], pose.phi, 1e-15);
}

TEST(RobotWinder, UnreachablePosesAreNamed) {
  const auto machine = test::robot(RobotArm::lefty);
  for (const ToolPose& pose : {ToolPose{{600, 0, 10}, 0, 0}, ToolPose{{420, 0, 10}, 0, 0.2}}) {
    try {
      machine->inverse(test::standing(pose));
      ADD_FAILURE();
    } catch (const UnreachablePose& e) {
      EXPECT_EQ(e.pose, pose.coordinates());
      EXPECT_TRUE(std::isnan(e.path_length));
      EXPECT_NE(std::string(e.what()).find("800"), std::string::npos) << e.what();
    }
  }
  // 1e-3 rad from straight: within reach, but singular. The quill 800 mm · cos(0.0005) from the shoulder.
  const ToolPose straight{{800 * std::cos(0.0005) - 450 + 70, 0, 10}, 0, 0};
  EXPECT_THROW(machine->inverse(test::standing(straight)), UnreachablePose);
  const ToolPose bent{{800 * std::cos(0.0055) - 450 + 70, 0, 10}, 0, 0};
  EXPECT_NO_THROW(machine->inverse(test::standing(bent)));
  // The quill in the shoulder's axis: folded.
  EXPECT_THROW(machine->inverse(test::standing({{-450 + 70, 0, 0}, 0, 0})), UnreachablePose);
}

TEST(RobotWinder, HasFiveAxes) {
  const auto machine = test::robot(RobotArm::lefty);
  ASSERT_EQ(machine->axes().size(), 5u);
  EXPECT_EQ(machine->axes()[2].name, "q3");
  EXPECT_EQ(machine->axes()[2].unit, "mm");
  EXPECT_EQ(machine->axes()[4].unit, "rad");
  EXPECT_EQ(machine->period(2), 0);
  EXPECT_EQ(machine->period(0), 2 * pi);
  EXPECT_EQ(machine->period(4), 0);  // the swivel does not come round
  EXPECT_THROW(RobotWinder(test::robot_sizes(), RobotArm::lefty, std::vector<Limits>(4)), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
