#include "core/winding/needle/wire_pull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;

Vec3 unit(Vec3 a) { return (1 / norm(a)) * a; }

TEST(WirePull, AForceThatHardlyPullsIsNamed) {
  Pull pull;
  pull.force = 1e-9, pull.bending_moment = 10;
  try {
    bend_radius(pull);
    FAIL() << "nothing was thrown";
  } catch (const InvalidInput& e) {
    ASSERT_EQ(e.faults.size(), 1u);
    EXPECT_EQ(e.faults[0].place, (std::vector<std::string>{"pull", "force"}));
  }
}

// The wire followed from the tip: out along the needle, round the circle, straight to its place.
TEST(WirePull, TheBendJoinsNeedleAndFreeWire) {
  Random random(3);
  int seen = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto direction = [&] { return unit({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}); };
    const Vec3 u = direction(), d = direction();
    const double radius = random.uniform(0, 9), length = random.uniform(0, 5);
    const double angle = std::acos(-dot(u, d));
    if (angle < 1e-3 || angle > 3) continue;
    ++seen;
    const TipOffset tip = *tip_offset(u, d, radius, length);
    EXPECT_NEAR(tip.exit_angle, angle, 1e-9);
    const Vec3 side = (1 / std::sin(angle)) * (-1.0 * u - std::cos(angle) * d);
    const Vec3 end = tip.offset + radius * std::sin(angle) * d + radius * (1 - std::cos(angle)) * side;
    EXPECT_NEAR(norm(end - length * u), 0, 1e-9 * (1 + std::tan(angle / 2))) << "end of the circle on the free wire";
  }
  EXPECT_GT(seen, 15000);
}

TEST(WirePull, ClosedForms) {
  const Vec3 out{1, 0, 0}, up{0, 0, 1};
  // A right angle: radius ahead and radius back.
  TipOffset tip = *tip_offset(up, out, 5, 2);
  EXPECT_NEAR(norm(tip.offset - Vec3{-5, 0, 7}), 0, 1e-14);
  EXPECT_NEAR(tip.exit_angle, pi / 2, 1e-15);
  // Straight out of the needle: the tip is `free_length` before the place.
  tip = *tip_offset(up, {0, 0, -1}, 5, 2);
  EXPECT_NEAR(norm(tip.offset - Vec3{0, 0, 2}), 0, 1e-14);
  EXPECT_NEAR(tip.exit_angle, 0, 1e-15);
  // 60° and 120°: tan 30° and tan 60°.
  tip = *tip_offset({std::sqrt(0.75), 0, 0.5}, {0, 0, -1}, 3, 0);
  EXPECT_NEAR(tip.exit_angle, pi / 3, 1e-15);
  EXPECT_NEAR(norm(tip.offset - Vec3{1.5, 0, std::sqrt(3) * 1.5}), 0, 1e-14);
  // No radius, no length: the tip at the wire's place.
  EXPECT_EQ(norm(tip_offset(up, out, 0, 0)->offset), 0);
  EXPECT_FALSE(tip_offset(up, up, 5, 2));
}

TEST(WirePull, RadiusFollowsFromTheMomentAtTheMouth) {
  const Wire wire{.copper = 0.9, .outer = 0.989, .tolerance = 0.03};
  const double moment = bending_moment(wire, 200);
  EXPECT_NEAR(moment, 200 * 0.729 / 6, 1e-12);
  // Circular section, yielding all over: twice the integral of σ y over the upper half.
  double sum = 0;
  const int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    const double y = 0.45 * (i + 0.5) / steps;
    sum += 2 * 200 * y * 2 * std::sqrt(0.45 * 0.45 - y * y) * 0.45 / steps;
  }
  EXPECT_NEAR(moment, sum, 1e-3);
  Pull pull{.force = 3, .bend_radius = 5, .bending_moment = moment};
  EXPECT_EQ(bend_radius(pull), moment / 3) << "a slack wire bends wider";
  pull.force = 30;
  EXPECT_EQ(bend_radius(pull), 5) << "a tight one as narrow as it may";
  // Lever of the tension about the mouth.
  const TipOffset tip = *tip_offset({0, 0, 1}, {1, 0, 0}, moment / 3, 1);
  EXPECT_NEAR(-tip.offset.x * 3, moment, 1e-12);
}

TEST(WirePull, ImpossibleOnesAreRefusedByName) {
  const auto refused = [](Pull pull) -> std::string {
    try {
      bend_radius(pull);
    } catch (const InvalidInput& e) {
      std::string all;
      for (const InputFault& f : e.faults) all += f.place.at(0) + "." + f.place.at(1) + " ";
      return all;
    }
    return "";
  };
  EXPECT_EQ(refused({}), "");
  EXPECT_EQ(refused({.force = 0}), "pull.force ");
  EXPECT_EQ(refused({.force = -1, .bend_radius = -1}), "pull.force pull.bend_radius ");
  EXPECT_EQ(refused({.bending_moment = std::numeric_limits<double>::quiet_NaN()}), "pull.bending_moment ");
  EXPECT_EQ(refused({.free_length = std::numeric_limits<double>::infinity()}), "pull.free_length ");
}

}  // namespace
}  // namespace bahnwerk::winding
