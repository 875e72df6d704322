// From a slot to the setpoints of a winding machine.
#include "core/plan/winding/winding_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/errors.hpp"
#include "core/motion/setpoints/needle_setpoints.hpp"
#include "core/winding/fill.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

WindingRequest stator_request(std::size_t turns) {
  WindingRequest r;
  winding::StatorPart part;
  r.part = part;
  r.wire = *winding::standard_wire(0.9, 2);
  r.coils = {winding::coil_between(part, 0, 5)};
  r.turns = turns;
  r.model.pivot_limit = 0.2;
  r.least_clearance = -100;  // whether the needle passes is another test's matter
  r.configurations = test::winders()[0].configurations;
  return r;
}
WindingRequest rotor_request(std::size_t turns) {
  WindingRequest r = stator_request(turns);
  winding::RotorPart part;
  r.part = part;
  r.coils = {winding::coil_between(part, 0, 1)};
  r.model.pivot_limit.reset();
  r.configurations = test::winders()[2].configurations;
  return r;
}

WindingPlan planned(const WindingRequest& request) {
  SilentProgress progress;
  return plan_winding(request, progress);
}

void expect_verified(const WindingPlan& p, const std::string& what) {
  for (const Check& check : p.motion.verification.checks)
    EXPECT_TRUE(check.passed) << what << ": " << check.name << ' ' << check.value << " against " << check.limit
                              << " at " << check.at;
  EXPECT_TRUE(p.motion.verification.passed) << what;
}
const Check* find(const WindingPlan& p, const std::string& name) {
  for (const Check& check : p.motion.verification.checks)
    if (check.name == name) return &check;
  return nullptr;
}

TEST(WindingPlan, EveryMachineWindsBothPartsWithBothFeeds) {
  for (const bool stator : {true, false})
    for (const test::Winder& winder : test::winders()) {
      double natural = 0;
      for (const FeedMethod feed : {FeedMethod::natural, FeedMethod::optimised}) {
        WindingRequest r = stator ? stator_request(1) : rotor_request(1);
        r.configurations = winder.configurations;
        r.feed = feed;
        const WindingPlan p = planned(r);
        const std::string what =
            winder.name + (stator ? " stator " : " rotor ") + name_of<FeedMethod>(feed, feed_methods);
        expect_verified(p, what);
        const Check* forward = find(p, "forward kinematics position");
        ASSERT_NE(forward, nullptr);
        EXPECT_LE(forward->value, 1e-6) << what;
        EXPECT_LE(p.motion.bound.duration, p.motion.duration * (1 + 1e-9)) << what;
        if (feed == FeedMethod::natural) natural = p.motion.duration;
        if (feed == FeedMethod::optimised) {
          EXPECT_LT(p.motion.duration, natural) << what;
        }
      }
    }
}

TEST(WindingPlan, SetpointsAreInDegreesAndBelongTogether) {
  const WindingPlan p = planned(rotor_request(1));
  const SetpointSource& rows = *p.motion.setpoints;
  ASSERT_EQ(rows.columns().size(), 28u);
  EXPECT_EQ(rows.columns()[3].unit, "deg");
  EXPECT_EQ(rows.columns()[18].name, "jq4");
  EXPECT_EQ(rows.columns()[18].unit, "deg/s³");
  EXPECT_EQ(rows.columns()[27].name, "brake");
  const std::size_t width = 28;
  std::vector<double> all(rows.count() * width);
  rows.read(0, rows.count(), all.data());
  const double h = rows.cycle_time(), degrees = 180 / std::numbers::pi;
  double velocity = 0, jerk = 0;
  for (std::size_t i = 1; i + 1 < rows.count(); ++i)
    for (std::size_t k = 0; k < 5; ++k) {
      const auto at = [&](std::size_t row, std::size_t column) { return all[row * width + column]; };
      // Central differences of position against velocity: off by h²/6 of the jerk.
      velocity = std::max(velocity, std::abs((at(i + 1, k) - at(i - 1, k)) / (2 * h) - at(i, 5 + k)));
      jerk = std::max(jerk, std::abs(at(i, 15 + k)));
    }
  EXPECT_LE(velocity, h * h / 6 * 700000);
  EXPECT_LE(jerk, 600000 * (1 + 1e-9));
  EXPECT_EQ(all[27], 30);
  EXPECT_NEAR(all[23], degrees * p.support[0].begin.pose.phi, 1e-9);
  const std::size_t last = (rows.count() - 1) * width;
  for (std::size_t c = 5; c < 20; ++c) EXPECT_EQ(all[last + c], 0);
}

TEST(WindingPlan, TellsWireAndTimes) {
  const WindingPlan one = planned(rotor_request(1)), three = planned(rotor_request(3));
  // About two slots of 202 mm and the caps above and below.
  EXPECT_GT(one.wire_length, 2 * 202);
  EXPECT_LT(one.wire_length, 2 * 202 + 250);
  EXPECT_NEAR(three.wire_length / one.wire_length, 3, 0.2);
  EXPECT_NEAR(three.resistance / three.wire_length * 1000,
              winding::resistance_per_metre(*winding::standard_wire(0.9, 2), 1, 20), 1e-9);
  ASSERT_EQ(three.turn_begins.size(), 3u);
  EXPECT_EQ(three.turn_begins[0], 0);
  EXPECT_LT(three.turn_begins[1], three.turn_begins[2]);
  EXPECT_LT(three.turn_begins[2], three.motion.duration);
  EXPECT_NEAR(three.strokes_per_minute, 6 * 60 / three.motion.duration, 1e-9);
}

TEST(WindingPlan, SeveralCoils) {
  WindingRequest r = rotor_request(1);
  const auto& part = std::get<winding::RotorPart>(r.part);
  r.coils = winding::repeated(r.coils[0], part.poles, 1, 3, true);
  const WindingPlan p = planned(r);
  expect_verified(p, "three coils");
  EXPECT_EQ(p.turns.size(), 3u);
  EXPECT_EQ(p.turn_begins.size(), 3u);
}

TEST(WindingPlan, NamesWhatCannotBe) {
  WindingRequest r = rotor_request(1000);
  const auto refused = [](const WindingRequest& request) -> std::string {
    try {
      planned(request);
    } catch (const InvalidInput& e) {
      std::string place;
      for (const std::string& member : e.faults[0].place) place += "/" + member;
      return place;
    }
    return "planned";
  };
  EXPECT_EQ(refused(r), "/coil/turns");
  r = rotor_request(1);
  r.wire = {20, 21, 0};
  EXPECT_EQ(refused(r), "/wire");
  r = rotor_request(1);
  r.coils.clear();
  EXPECT_EQ(refused(r), "/coil");
  r = rotor_request(1);
  r.links.continuity = 9;
  EXPECT_EQ(refused(r), "/path/continuity");
}

TEST(WindingPlan, AnArmTooShortNamesTurnRegionAndPose) {
  WindingRequest r = stator_request(1);
  RobotWinderSizes sizes = test::robot_sizes();
  sizes.l1 = sizes.l2 = 250;
  r.configurations = {std::make_shared<const RobotWinder>(sizes, RobotArm::righty, test::robot_limits())};
  try {
    planned(r);
    FAIL() << "planned";
  } catch (const UnreachableTurn& e) {
    EXPECT_EQ(e.turn, 0u);
    EXPECT_EQ(e.coil, 0u);
    EXPECT_NE(std::string(e.what()).find("turn 1 of coil 1"), std::string::npos) << e.what();
    EXPECT_GT(std::hypot(e.pose[0], e.pose[1]), 50);
  }
}

TEST(WindingPlan, ANeedleWiderThanTheOpeningFailsItsCheck) {
  WindingRequest r = stator_request(1);
  r.least_clearance = 0;
  r.needle.width = 5;
  const WindingPlan p = planned(r);
  const Check* check = find(p, "needle clearance");
  ASSERT_NE(check, nullptr);
  EXPECT_FALSE(check->passed);
  EXPECT_LT(check->value, -0.5);
  EXPECT_FALSE(p.motion.verification.passed);
}

TEST(WindingPlan, OneWireAndACoilOverHalfTheStator) {
  WindingRequest r = stator_request(1);
  auto part = std::get<winding::StatorPart>(r.part);
  r.coils = {winding::coil_between(part, 0, part.slots / 2)};
  r.configurations = test::winders()[1].configurations;
  expect_verified(planned(r), "half the stator");
}

TEST(WindingPlan, SameRequestSameBits) {
  const WindingPlan a = planned(rotor_request(2)), b = planned(rotor_request(2));
  ASSERT_EQ(a.motion.duration, b.motion.duration);
  ASSERT_EQ(a.motion.setpoints->count(), b.motion.setpoints->count());
  std::vector<double> one(28 * a.motion.setpoints->count()), other(one.size());
  a.motion.setpoints->read(0, a.motion.setpoints->count(), one.data());
  b.motion.setpoints->read(0, b.motion.setpoints->count(), other.data());
  EXPECT_EQ(one, other);
}

}  // namespace
}  // namespace bahnwerk
