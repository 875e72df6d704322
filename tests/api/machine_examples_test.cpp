// The machines under examples/machines: what they say is what the tests of the kinematics calculate with.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/api/documents.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

json machine(const std::string& name) { return test::read_json(test::source("examples/machines/" + name + ".json")); }

void expect_axes(const json& document, const std::vector<AxisLimits>& axes) {
  ASSERT_EQ(document.at("axes").size(), axes.size());
  EXPECT_GT(document.at("cycle_time").get<double>(), 0);
  for (const AxisLimits& axis : axes) {
    const json& said = document.at("axes").at(axis.name);
    const double unit = axis.unit == "rad" ? std::numbers::pi / 180 : 1;
    EXPECT_NEAR(said.at("velocity").get<double>() * unit, axis.velocity, 1e-9 * axis.velocity) << axis.name;
    EXPECT_NEAR(said.at("acceleration").get<double>() * unit, axis.acceleration, 1e-9 * axis.acceleration) << axis.name;
    EXPECT_NEAR(said.at("jerk").get<double>() * unit, axis.jerk, 1e-9 * axis.jerk) << axis.name;
    if (const json& range = said.at("range"); range.is_null()) {
      EXPECT_EQ(axis.lowest, -unlimited);
      EXPECT_EQ(axis.highest, unlimited);
    } else {
      EXPECT_NEAR(range.at(0).get<double>() * unit, axis.lowest, 1e-9);
      EXPECT_NEAR(range.at(1).get<double>() * unit, axis.highest, 1e-9);
    }
  }
}

void expect_part(const json& document, const PartPlace& part) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(document.at("part").at("origin").at(k).get<double>(), part.origin[k]);
  EXPECT_EQ(document.at("part").at("angle").get<double>() * std::numbers::pi / 180, part.angle);
}

TEST(MachineExamples, Robot) {
  const json document = machine("robot");
  const RobotWinderSizes sizes = bahnwerk::test::robot_sizes();
  EXPECT_EQ(document.at("type"), "robot");
  EXPECT_EQ(document.at("l1").get<double>(), sizes.l1);
  EXPECT_EQ(document.at("l2").get<double>(), sizes.l2);
  EXPECT_EQ(document.at("o_tool").get<double>(), sizes.o_tool);
  EXPECT_EQ(document.at("l_tool").get<double>(), sizes.l_tool);
  EXPECT_NEAR(document.at("least_bend").get<double>() * std::numbers::pi / 180, sizes.least_bend, 1e-15);
  expect_part(document, sizes.part);
  expect_axes(document, bahnwerk::test::robot(RobotArm::lefty)->axes());
}

TEST(MachineExamples, Vertical) {
  const json document = machine("vertical");
  const VerticalWinderSizes sizes;
  EXPECT_EQ(document.at("type"), "vertical");
  EXPECT_EQ(document.at("d_upper").get<double>(), sizes.d_upper);
  EXPECT_EQ(document.at("a_upper").get<double>(), sizes.a_upper);
  EXPECT_EQ(document.at("d_lower").get<double>(), sizes.d_lower);
  EXPECT_EQ(document.at("a_lower").get<double>(), sizes.a_lower);
  EXPECT_EQ(document.at("o_tool").get<double>(), sizes.o_tool);
  EXPECT_EQ(document.at("l_tool").get<double>(), sizes.l_tool);
  expect_part(document, sizes.part);
  expect_axes(document, bahnwerk::test::vertical()->axes());
}

TEST(MachineExamples, Horizontal) {
  const json document = machine("horizontal");
  const HorizontalWinderSizes sizes;
  EXPECT_EQ(document.at("type"), "horizontal");
  EXPECT_EQ(document.at("z_part").get<double>(), sizes.z_part);
  EXPECT_EQ(document.at("l_tool").get<double>(), sizes.l_tool);
  expect_part(document, sizes.part);
  expect_axes(document, bahnwerk::test::horizontal()->axes());
}

}  // namespace
}  // namespace bahnwerk::api
