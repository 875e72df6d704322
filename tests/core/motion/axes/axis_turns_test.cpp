// Rotary axes that come round more than once.
#include "core/motion/axes/axis_turns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/motion/axes/machine_path.hpp"
#include "needle_loop.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = std::numbers::pi;

/// A machine that gives its angle between −π and π, as atan2 does, and turns with the tool's azimuth.
class Turret final : public Kinematics {
 public:
  explicit Turret(double lowest = -unlimited, double highest = unlimited) {
    axes_ = {{"turn", 3}, {"radius", 900}};
    axes_[0].unit = "rad", axes_[0].lowest = lowest, axes_[0].highest = highest;
  }
  const std::vector<AxisLimits>& axes() const override { return axes_; }
  double period(std::size_t axis) const override { return axis == 0 ? 2 * pi : 0; }
  AxisJet inverse(const ToolJet& tool) const override {
    using T = Taylor<3>;
    const Jet& p = tool.position;
    const T x = T::from(p.value.x, p.d1.x, p.d2.x, p.d3.x), y = T::from(p.value.y, p.d1.y, p.d2.y, p.d3.y);
    const T q[] = {atan2(y, x), sqrt(x * x + y * y)};
    AxisJet jet;
    for (std::size_t k = 0; k < 2; ++k) {
      jet.value[k] = q[k].value();
      jet.d1[k] = q[k].derivative(1), jet.d2[k] = q[k].derivative(2), jet.d3[k] = q[k].derivative(3);
    }
    return jet;
  }
  ToolPose forward(const AxisArray& q) const override { return {{q[1] * std::cos(q[0]), q[1] * std::sin(q[0]), 0}}; }
  MapBounds bounds(const ToolPose& centre, double radius) const override {
    using M = Majorant<4>;
    const M x = M::coordinate(centre.position.x, radius), y = M::coordinate(centre.position.y, radius);
    const M q[] = {atan2(y, x), sqrt(x * x + y * y)};
    MapBounds b;
    for (std::size_t n = 1; n <= 4; ++n)
      for (std::size_t k = 0; k < 2; ++k) b.order[n - 1][k] = q[k].derivative(n);
    return b;
  }

 private:
  std::vector<AxisLimits> axes_;
};

void expect_continuous(const KinematicAxisPath& path, double most) {
  AxisArray last{};
  for (std::size_t i = 0; i < path.size(); ++i)
    for (int j = 0; j <= 2000; ++j) {
      const Curve& curve = path[i].curve();
      const AxisArray q = path.at_parameter(i, curve.begin() + (curve.end() - curve.begin()) * j / 2000).value;
      for (std::size_t k = 0; k < path.axes(); ++k)
        if (i + static_cast<std::size_t>(j) > 0) {
          ASSERT_LE(std::abs(q[k] - last[k]), most) << "axis " << k << " of segment " << i << " at " << j;
        }
      last = q;
    }
}

TEST(AxisTurns, AnAngleGoesOnOverFullTurns) {
  const test::NeedlePath path = test::helix(30, 3.25, 12);
  const Turret machine;
  const KinematicAxisPath axes(path.tool, machine);
  expect_continuous(axes, 0.1);
  EXPECT_NEAR(axes.at(0, 0).value[0], 0, 1e-12);
  EXPECT_NEAR(axes.at(0, path.tool.length()).value[0], 3.25 * 2 * pi, 1e-12);
  EXPECT_NEAR(axes.raw_at_parameter(0, 1).value[0], pi / 2, 1e-12);
  // What the planners see is what there is.
  std::vector<double> out(8);
  axes.write_at(0, path.tool.length() / 2, out.data());
  EXPECT_NEAR(out[0], 3.25 * pi, 1e-12);
}

TEST(AxisTurns, WholeTurnsBringItIntoItsRange) {
  const test::NeedlePath path = test::helix(30, 1.5, 12);  // 0 … 3π
  for (const int turns : {-3, 0, 2}) {
    const double middle = 1.5 * pi + 2 * pi * turns;
    const Turret machine(middle - 1.6 * pi, middle + 1.6 * pi);
    const KinematicAxisPath axes(path.tool, machine);
    EXPECT_NEAR(axes.at(0, 0).value[0], 2 * pi * turns, 1e-12);
  }
}

TEST(AxisTurns, EveryWinderFollowsThreeTurnsAboutItsPart) {
  const test::NeedlePath path = test::helix(60, 3, 40);
  for (const auto& machine : {test::vertical(), test::horizontal()}) {
    const KinematicAxisPath axes(path.tool, *machine, path.orientation);
    expect_continuous(axes, 0.2);
    const AxisArray first = axes.at(0, 0).value, last = axes.at(0, path.tool.length()).value;
    EXPECT_NEAR(last[3] - first[3], -6 * pi, 1e-12);
    EXPECT_LE(std::abs(first[3]), pi);
  }
  RobotWinderSizes sizes = test::robot_sizes();
  sizes.part.origin = {-500, 3, 0};  // where the shoulder's angle passes from π to −π again and again
  for (const RobotArm arm : {RobotArm::lefty, RobotArm::righty}) {
    const RobotWinder machine(sizes, arm, std::vector<Limits>(5));
    const KinematicAxisPath axes(path.tool, machine, path.orientation);
    expect_continuous(axes, 0.2);
    const AxisArray first = axes.at(0, 0).value, last = axes.at(0, path.tool.length()).value;
    EXPECT_NEAR(last[0], first[0], 1e-12);  // it comes back, the quill has turned
    EXPECT_NEAR(last[3] - first[3], 6 * pi, 1e-12);
    for (const double s : {0.0, 100.0, 777.0, 1130.0}) {
      const ToolPose pose = machine.forward(axes.at(0, s).value), wanted = axes.pose(0, path.tool[0].parameter(s));
      EXPECT_LE(norm(pose.position - wanted.position), 1e-11);
      EXPECT_NEAR(std::remainder(pose.phi - wanted.phi, 2 * pi), 0, 1e-13);
    }
  }
}

TEST(AxisTurns, ThroughASingularityNothingCanBeFollowed) {
  Path path;
  path.append(std::make_shared<Line>(Vec{-10, 0, 0}, Vec{20, 0, 0}), 0);
  const Turret machine;
  try {
    const KinematicAxisPath axes(path, machine);
    ADD_FAILURE();
  } catch (const UnreachablePose& e) {
    EXPECT_NEAR(e.path_length, 10, 1e-6);
    EXPECT_NEAR(e.pose[0], 0, 1e-6);
  }
}

}  // namespace
}  // namespace bahnwerk
