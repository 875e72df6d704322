// From a slot to the setpoints of a winding machine.
#include "core/plan/winding/winding_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/motion/setpoints/needle_setpoints.hpp"
#include "core/winding/fill.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/plan/winding/winding_plans.hpp"

namespace bahnwerk {
namespace {

TEST(WindingPlan, EveryMachineWindsBothPartsWithEveryFeed) {
  for (const bool stator : {true, false})
    for (const test::Winder& winder : test::winders()) {
      std::vector<double> durations;
      for (const auto& [feed, name] : feed_methods) {
        WindingRequest r = stator ? stator_request(1) : rotor_request(1);
        r.configurations = winder.configurations;
        r.feed = feed;
        const WindingPlan p = planned(r);
        const std::string what = winder.name + (stator ? " stator " : " rotor ") + name;
        expect_verified(p, what);
        const Check* forward = find(p, "forward kinematics position");
        ASSERT_NE(forward, nullptr);
        EXPECT_LE(forward->value, 1e-6) << what;
        EXPECT_LE(p.motion.bound.value, p.motion.duration * (1 + 1e-9)) << what;
        durations.push_back(p.motion.duration);
      }
      ASSERT_EQ(durations.size(), 4u);  // natural, constant, critical_points, optimised
      EXPECT_LT(durations[3], durations[0]) << winder.name;
      EXPECT_LT(durations[3], durations[2]) << winder.name;
      EXPECT_LT(durations[2], durations[1]) << winder.name;
    }
}

/// What part of the job is done when the planner of the feed sets out, and whether it fell on the way there.
struct BeforeTheFeed final : ProgressSink {
  double most = 0, fallen = 0;
  bool planning = false;
  std::set<std::string> stages;
  void report(std::string_view stage, double fraction, std::string_view) override {
    planning = planning || stage == "bound";
    if (planning) return;
    stages.emplace(stage);
    fallen = std::max(fallen, most - fraction), most = std::max(most, fraction);
  }
};

TEST(WindingPlan, ProgressIsThatOfTheWholeJob) {
  for (const bool minimum_time : {false, true}) {
    WindingRequest r = stator_request(2);
    r.minimum_time = minimum_time;
    BeforeTheFeed progress;
    plan_winding(r, progress);
    EXPECT_TRUE(progress.planning);
    for (const char* stage : {"layout", "support points", "link", "clearance", "machine"})
      EXPECT_EQ(progress.stages.count(stage), 1u) << stage;
    EXPECT_LE(progress.most, 0.3);
    if (!minimum_time) {  // which makes links, and measures their clearance, several times
      EXPECT_EQ(progress.fallen, 0);
    }
  }
}

TEST(WindingPlan, TheSplineFeedIsVerifiedAndSlowerThanTheOptimum) {
  WindingRequest r = rotor_request(1);
  const double optimum = planned(r).motion.duration;
  r.law = FeedLaw::bspline;
  const WindingPlan p = planned(r);
  expect_verified(p, "bspline");
  EXPECT_GT(p.motion.duration, optimum);
  EXPECT_GT(p.jerk.along, 0);
  EXPECT_GT(p.jerk.total, 0);
  EXPECT_LT(p.motion.duration, 1.25 * optimum);
  r.turns = max_spline_turns + 1;
  try {
    planned(r);
    ADD_FAILURE() << "planned";
  } catch (const InvalidInput& error) {
    ASSERT_EQ(error.faults.size(), 1U);
    EXPECT_EQ(error.faults[0].place, (std::vector<std::string>{"feed", "law"}));
  }
}

/// The limits of the source's example [Herrmann 4.4.2].
WindingRequest with_source_limits(WindingRequest r) {
  r.along.velocity = 150, r.along.acceleration = 450, r.along.jerk = 2500;
  r.chord_tolerance = 0.005, r.half_speed_curvature = 0.2;
  return r;
}

TEST(WindingPlan, LimitsByCurvatureHoldWithEveryFeedAndProfile) {
  for (const bool stator : {true, false}) {
    double before = 0;
    for (const PlanningMethod feed :
         {PlanningMethod::jerk_limited, PlanningMethod::critical_points, PlanningMethod::constant}) {
      WindingRequest r = with_source_limits(stator ? stator_request(1) : rotor_request(1));
      r.feed = feed;
      const WindingPlan p = planned(r);
      expect_verified(p, name_of<PlanningMethod>(feed, feed_methods));
      for (const char* check : {"chord error", "half-speed feed", "path velocity", "path acceleration", "path jerk"})
        EXPECT_NE(find(p, check), nullptr) << check;
      EXPECT_GT(p.motion.duration, before);
      EXPECT_LE(p.fastest, 150 * (1 + 1e-9));
      before = p.motion.duration;
    }
    for (const auto& [profile, name] : speed_profiles) {
      WindingRequest r = with_source_limits(stator ? stator_request(1) : rotor_request(1));
      r.feed = PlanningMethod::critical_points, r.profile = profile;
      const WindingPlan p = planned(r);
      expect_verified(p, name);
      // What has no limit of jerk is not said to keep one.
      const bool jerk = profile != SpeedProfile::trapezoid;
      EXPECT_EQ(find(p, "path jerk") != nullptr, jerk);
      EXPECT_EQ(find(p, "jerk q1") != nullptr, jerk);
      EXPECT_EQ(find(p, "continuity of acceleration") != nullptr, jerk);
      EXPECT_NE(find(p, "path acceleration"), nullptr);
    }
  }
}

TEST(WindingPlan, AConstantFeedThatIsTooFastIsNamedWithTurnRegionAndLimit) {
  WindingRequest r = rotor_request(1);
  r.feed = PlanningMethod::constant;
  const double largest = planned(r).fastest;
  r.along.velocity = 2 * largest;
  try {
    planned(r);
    ADD_FAILURE() << "planned";
  } catch (const FeedTooFastAtTurn& error) {
    EXPECT_NEAR(error.limit.speed, largest, 1e-4 * largest);
    EXPECT_EQ(error.turn, 0u);
    for (const char* word : {"feed.velocity", "turn 1 of coil 1", "slot", "limit of q", "largest constant feed"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
  r.along.velocity = 0.9 * largest;
  const WindingPlan p = planned(r);
  expect_verified(p, "asked for");
  EXPECT_NEAR(p.fastest, 0.9 * largest, 1e-3 * largest);  // slowed to whole cycles
  // A tolerance of the chord alone can be what is broken.
  r.along.velocity = 0.99 * largest;
  r.chord_tolerance = 1e-8;
  try {
    planned(r);
    ADD_FAILURE() << "planned";
  } catch (const FeedTooFastAtTurn& error) {
    EXPECT_EQ(error.limit.kind, FeedLimit::Kind::segment_feed);
    EXPECT_NE(std::string(error.what()).find("chord_tolerance"), std::string::npos) << error.what();
  }
}

/// The slowest and the fastest that the schema admits.
TEST(WindingPlan, ExtremeFeedsAreVerifiedOrNamed) {
  std::size_t profiles = 0;
  for (const PlanningMethod feed : {PlanningMethod::constant, PlanningMethod::critical_points})
    for (const auto& [profile, name] : speed_profiles) {
      // One profile with each feed; all of them in a long run.
      if (testing::case_factor() < 5 &&
          profiles++ % std::size(speed_profiles) != (feed == PlanningMethod::constant ? 0 : 1))
        continue;
      WindingRequest r = rotor_request(1);
      r.feed = feed, r.profile = profile;
      r.along = {1e6, 1e9, 1e12};
      r.half_speed_curvature = 1e6;  // 1e6 mm/s is a limit, no feed
      expect_verified(planned(r), name);
      r = rotor_request(1);
      r.feed = feed, r.profile = profile;
      r.along = {unlimited, 1e-3, 1e-3};
      r.max_setpoints = 1e6;
      expect_verified(planned(r), name);
      r.along.velocity = 1e-3;
      try {
        planned(r);
        ADD_FAILURE() << name << ": too many setpoints";
      } catch (const InvalidInput& refused) {
        ASSERT_EQ(refused.faults.size(), 1u);
        EXPECT_NE(refused.faults[0].message.find("setpoints"), std::string::npos) << refused.faults[0].message;
      }
      r.cycle_time = 1, r.max_setpoints = 2e6;
      expect_verified(planned(r), name);
    }
}

TEST(WindingPlan, SetpointsAreInDegreesAndBelongTogether) {
  const WindingPlan p = planned(rotor_request(1));
  const SetpointSource& rows = *p.motion.setpoints;
  ASSERT_EQ(rows.columns().size(), 34u);
  EXPECT_EQ(rows.columns()[3].unit, "deg");
  EXPECT_EQ(rows.columns()[18].name, "jq4");
  EXPECT_EQ(rows.columns()[18].unit, "deg/s³");
  EXPECT_EQ(rows.columns()[27].name, "brake");
  const std::size_t width = 34;
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
  EXPECT_EQ(rows.columns()[33].name, "tension");
  EXPECT_EQ(all[33], 30);
  EXPECT_NEAR(all[23], degrees * p.support[0].begin.pose.phi, 1e-9);
  const std::size_t last = (rows.count() - 1) * width;
  for (std::size_t c = 5; c < 20; ++c) EXPECT_EQ(all[last + c], 0);
}

TEST(WindingPlan, InterpolatorsThatScatterFailByName) {
  WindingRequest r = rotor_request(1);
  r.interpolator = Interpolator::taylor1;
  const WindingPlan p = planned(r);
  EXPECT_FALSE(p.motion.verification.passed);
  // The motion is sound; it is the setpoints that exceed its limits.
  for (const Check& check : p.motion.verification.checks)
    EXPECT_TRUE(check.passed || check_name(check).starts_with("setpoint ")) << check_name(check);
  EXPECT_FALSE(find(p, "setpoint jerk q3")->passed);
}

TEST(WindingPlan, QuarticKeepsTheLimitsAtAFeedFarBelowThem) {
  WindingRequest r = rotor_request(1);
  r.interpolator = Interpolator::quartic;
  r.feed = PlanningMethod::natural;
  const WindingPlan p = planned(r);
  expect_verified(p, "quartic");
  EXPECT_NE(find(p, "setpoint jerk q1"), nullptr);
}

TEST(WindingPlan, TellsTheFeedFluctuationOfAllInterpolators) {
  for (const bool stator : {true, false}) {
    const WindingPlan p = planned(stator ? stator_request(1) : rotor_request(1));
    ASSERT_EQ(p.fluctuation.size(), std::size(interpolators));
    const auto& [exact, taylor1, taylor2, quartic] =
        std::array{p.fluctuation[0], p.fluctuation[1], p.fluctuation[2], p.fluctuation[3]};
    EXPECT_LE(exact.largest, 1e-6);
    EXPECT_LE(quartic.mean, 1e-3);
    EXPECT_LE(quartic.chord_mean, 1e-3);
    EXPECT_LE(10 * quartic.mean, taylor1.mean);
    EXPECT_LT(quartic.mean, taylor2.mean);
    // Nothing moves with the wire: the brake stays at its force.
    EXPECT_EQ(p.wire.peak, 30);
    EXPECT_EQ(p.wire.least, 30);
    // Rows of the exact interpolator are held to the limits, too, and keep them.
    ASSERT_NE(find(p, "setpoint jerk q3"), nullptr);
    EXPECT_TRUE(find(p, "setpoint jerk q3")->passed);
  }
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

/// What memory and time grow with, counted: nodes and cells of the bound, pieces of the law, setpoints, Newton steps
/// per cell. Each of many coils takes what one takes.
TEST(WindingPlan, WhatAPlanTakesGrowsLinearlyWithTheTurns) {
  constexpr std::size_t turns = 4;
  struct Taken {
    double nodes = 0, cells = 0, pieces = 0, setpoints = 0, iterations = 0;
  };
  const auto taken = [](const WindingRequest& request, const std::string& what) {
    const WindingPlan p = planned(request);
    expect_verified(p, what);
    std::size_t nodes = 0, cells = 0;
    EXPECT_EQ(
        std::sscanf(p.motion.bound.basis.c_str(),
                    "axis energies between %zu nodes of the path, jerk by duality over %zu cells", &nodes, &cells),
        2)
        << p.motion.bound.basis;
    std::printf("%s: %zu nodes, %zu cells, %zu pieces, %zu setpoints, %zu steps\n", what.c_str(), nodes, cells,
                p.motion.pieces, p.motion.setpoints->count(), p.motion.iterations);
    return Taken{static_cast<double>(nodes), static_cast<double>(cells), static_cast<double>(p.motion.pieces),
                 static_cast<double>(p.motion.setpoints->count()), static_cast<double>(p.motion.iterations)};
  };
  for (const bool stator : {true, false}) {
    WindingRequest r = stator ? stator_request(turns) : rotor_request(turns);
    r.feed = PlanningMethod::jerk_limited;
    const winding::Coil coil = r.coils.front();
    const int places =
        stator ? std::get<winding::StatorPart>(r.part).slots : std::get<winding::RotorPart>(r.part).poles;
    const std::string what = stator ? "stator" : "rotor";
    // One coil alone has no way to the next one, whose sharp turns take many nodes and steps.
    std::array<Taken, 3> all;
    for (const std::size_t i : {0, 1, 2}) {
      const std::size_t coils = std::size_t{1} << i;
      r.coils = winding::repeated(coil, places, stator ? 12 : 1, coils, true);
      ASSERT_EQ(r.coils.size(), coils);
      all[i] = taken(r, what + ", coils: " + std::to_string(coils));
    }
    const auto doubles = [&](double Taken::*count, const char* name) {
      EXPECT_LE(all[1].*count, 3 * (all[0].*count)) << what << ' ' << name;
      EXPECT_GE(all[2].*count, 1.7 * (all[1].*count)) << what << ' ' << name;
      EXPECT_LE(all[2].*count, 2.3 * (all[1].*count)) << what << ' ' << name;
    };
    doubles(&Taken::nodes, "nodes"), doubles(&Taken::cells, "cells");
    doubles(&Taken::pieces, "pieces"), doubles(&Taken::setpoints, "setpoints");
    EXPECT_LE(all[2].iterations, 1.3 * all[1].iterations) << what;
  }
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
  const WindingPlan p = planned(r);
  expect_verified(p, "half the stator");
  EXPECT_LE(p.motion.bound.gap, 0.01);
}

TEST(WindingPlan, SameRequestSameBits) {
  const WindingPlan a = planned(rotor_request(2)), b = planned(rotor_request(2));
  ASSERT_EQ(a.motion.duration, b.motion.duration);
  ASSERT_EQ(a.motion.setpoints->count(), b.motion.setpoints->count());
  std::vector<double> one(a.motion.setpoints->columns().size() * a.motion.setpoints->count()), other(one.size());
  a.motion.setpoints->read(0, a.motion.setpoints->count(), one.data());
  b.motion.setpoints->read(0, b.motion.setpoints->count(), other.data());
  EXPECT_EQ(one, other);
}

}  // namespace
}  // namespace bahnwerk
