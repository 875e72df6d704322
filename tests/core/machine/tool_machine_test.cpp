// The machines that run contours: there and back, derivatives against differences, bounds, and places that are refused.
#include "core/machine/tool_machine.hpp"

#include <gtest/gtest.h>

#include "core/machine/linear_delta.hpp"
#include "core/machine/linear_machine.hpp"
#include "core/machine/polar_machine.hpp"
#include "core/machine/rotary_delta.hpp"
#include "core/machine/scara_machine.hpp"
#include "round_trip.hpp"

namespace bahnwerk {
namespace {

constexpr double degree = std::numbers::pi / 180;

AxisLimits axis(const char* name, double low, double high, const char* unit = "mm") {
  AxisLimits limits(name, 100, 1000);
  limits.lowest = low, limits.highest = high, limits.unit = unit;
  return limits;
}
bool anywhere(const AxisArray&) { return true; }

const LinearMachine skewed({axis("A", -300, 300), axis("B", -300, 300), axis("C", -300, 300)},
                           {{1, 0.1, 0}, {0.2, -1, 0.3}, {0, 0.1, 2}}, 3);
const PolarMachine polar({{10, 20, 5}, 2}, {axis("theta", -10, 10, "rad"), axis("r", 20, 300), axis("z", -50, 50)});
const ScaraMachine scara({{10, -20, 5}, 220, 180, degree, true},
                         {axis("theta1", -3, 3, "rad"), axis("theta2", 0.4, 2.6, "rad"), axis("z", -50, 50)});
const ScaraMachine left({{10, -20, 5}, 200, 200, degree, false},
                        {axis("theta1", -3, 3, "rad"), axis("theta2", -2.6, -0.4, "rad"), axis("z", -50, 50)});
const LinearDelta columns({{5, -5, 0}, 150, 320, 10 * degree}, {axis("A", 0, 80), axis("B", 0, 80), axis("C", 0, 80)});
const RotaryDelta arms({{5, -5, 300}, 100, 150, 360, 5 * degree},
                       {axis("theta1", -0.3, 1, "rad"), axis("theta2", -0.3, 1, "rad"),
                        axis("theta3", -0.3, 1, "rad")});
const std::vector<const Kinematics*> machines{&skewed, &polar, &scara, &left, &columns, &arms};

TEST(ToolMachine, PosesComeBack) {
  for (const Kinematics* machine : machines) test::poses_come_back(*machine, anywhere);
}

TEST(ToolMachine, DerivativesAreDifferences) {
  for (const Kinematics* machine : machines) {
    SCOPED_TRACE(machine->axes().front().name);
    test::derivatives_are_differences(*machine, anywhere);
  }
}

TEST(ToolMachine, BoundsHold) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Kinematics* machine : machines) {
    SCOPED_TRACE(machine->axes().front().name);
    for (int i = 0; i < 300; ++i) {
      const ToolPose centre = machine->forward(test::random_axes(*machine, random, anywhere));
      const double radius = 5 * uniform(random);
      const MapBounds bounds = machine->bounds(centre, radius);
      for (int j = 0; j < 10; ++j) {
        Vec off{normal(random), normal(random), normal(random)}, e{normal(random), normal(random), normal(random)};
        ToolJet tool = test::standing(centre);
        tool.position.value += radius * uniform(random) / norm(off) * off;
        tool.position.d1 = e / norm(e);
        AxisJet q;
        try {
          q = machine->inverse(tool);
        } catch (const UnreachablePose&) {
          continue;
        }
        for (std::size_t k = 0; k < machine->axes().size(); ++k) {
          EXPECT_LE(std::abs(q.d1[k]), bounds.order[0][k] * (1 + 1e-12) + 1e-15) << k;
          EXPECT_LE(std::abs(q.d2[k]), bounds.order[1][k] * (1 + 1e-12) + 1e-15) << k;
          EXPECT_LE(std::abs(q.d3[k]), bounds.order[2][k] * (1 + 1e-12) + 1e-15) << k;
        }
      }
    }
  }
}

TEST(ToolMachine, CoreXyAddsAndSubtracts) {
  const LinearMachine machine({axis("A", -1, 1), axis("B", -1, 1)}, {{1, 1, 0}, {1, -1, 0}}, 2);
  const AxisJet q = machine.inverse(test::standing({{30, 10, 7}}));
  EXPECT_EQ(q.value[0], 40);
  EXPECT_EQ(q.value[1], 20);
  EXPECT_EQ(machine.forward(q.value).position, (Vec{30, 10, 0}));
}

TEST(ToolMachine, TwoMotorsMayMoveOnePortal) {
  const LinearMachine machine({axis("A", -1, 1), axis("B", -1, 1), axis("C", -1, 1)}, {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                              2);
  const AxisJet q = machine.inverse(test::standing({{3, 4, 0}}));
  EXPECT_EQ(q.value[1], 3);
  EXPECT_EQ(machine.forward(q.value).position, (Vec{3, 4, 0}));
}

TEST(ToolMachine, AxesThatDoNotDetermineTheToolAreRefused) {
  const std::vector<AxisLimits> two{axis("A", -1, 1), axis("B", -1, 1)};
  EXPECT_THROW(LinearMachine(two, {{1, 1, 0}, {2, 2, 0}}, 2), std::invalid_argument);
  EXPECT_THROW(LinearMachine(two, {{1, 1, 0}}, 2), std::invalid_argument);
  EXPECT_THROW(LinearMachine(two, {{1, 1, 0}, {1, 0, 0}}, 3), std::invalid_argument);
}

TEST(ToolMachine, SingularAndFarPlacesAreUnreachable) {
  const auto refused = [](const Kinematics& machine, Vec at) {
    EXPECT_THROW(machine.inverse(test::standing({at})), UnreachablePose);
  };
  refused(polar, {11, 20, 0});    // nearer to the table's axis than 2 mm
  refused(polar, {10, 20, 0});    // on it
  refused(scara, {410, -20, 0});  // stretched
  refused(scara, {420, -20, 0});  // out of reach
  refused(scara, {49, -20, 0});   // folded
  refused(columns, {5, 212, 0});  // rods flatter than 10°
  refused(columns, {5, 900, 0});
  refused(arms, {5, -5, -300});  // below the reach of the rods
}

}  // namespace
}  // namespace bahnwerk
