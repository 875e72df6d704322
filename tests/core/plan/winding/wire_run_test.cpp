// The wire of a finished plan: its tension, length and resistance.
#include "core/plan/winding/wire_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/read_rows.hpp"
#include "tests/core/plan/winding/winding_plans.hpp"

namespace bahnwerk {
namespace {

/// Differences of rows that are far apart are means, and lower than what becomes of the wire between them.
TEST(WireRun, TheWiresPeaksDoNotDependOnTheCycle) {
  WindingRequest r = rotor_request(1);
  r.tension.mass = 0.1;
  r.cycle_time = 0.0005;
  const WindingPlan fine = planned(r);
  r.cycle_time = 0.01;
  const WindingPlan coarse = planned(r);
  EXPECT_GT(coarse.wire.constant_peak - 30, 0.93 * (fine.wire.constant_peak - 30));
  EXPECT_GT(30 - coarse.wire.constant_least, 0.93 * (30 - fine.wire.constant_least));
}

TEST(WireRun, TheBrakeKeepsTheWiresTension) {
  for (const bool stator : {true, false}) {
    WindingRequest r = stator ? stator_request(1) : rotor_request(2);
    r.tension.mass = 0.1;
    const WindingPlan p = planned(r);
    expect_verified(p, "wire");
    // What is left is what the acceleration changes within two cycles.
    EXPECT_LE(std::max(p.wire.peak - 30, 30 - p.wire.least), 0.6);
    EXPECT_GE(p.wire.constant_peak, 32);
    EXPECT_LE(p.wire.constant_least, 29);
    EXPECT_NEAR(p.wire.constant_peak - 30, 30 - p.wire.constant_least, p.wire.acceleration * 1e-4);
    if (stator) continue;
    r.tension.permitted = 30.01;
    EXPECT_FALSE(find(planned(r), "wire pull")->passed);
    r.tension = {.mass = 3, .range = 30};
    EXPECT_FALSE(find(planned(r), "wire slack")->passed);
  }
}

std::vector<double> column_of(const SetpointSource& source, std::string_view name) {
  const std::size_t width = source.columns().size(), column = column_index(source.columns(), name);
  std::vector<double> all(source.count() * width), values;
  source.read(0, source.count(), all.data());
  for (std::size_t at = column; at < all.size(); at += width) values.push_back(all[at]);
  return values;
}

/// The rows' tension is the one that is checked, with differences of rows beside it.
TEST(WireRun, RowsTellTheTension) {
  for (const bool saturated : {false, true}) {
    WindingRequest r = rotor_request(2);
    r.tension.mass = saturated ? 3 : 0.1;
    if (saturated) r.tension.range = 30;
    const WindingPlan p = planned(r);
    const std::vector<double> tension = column_of(*p.motion.setpoints, "tension");
    const auto [least, peak] = std::minmax_element(tension.begin(), tension.end());
    EXPECT_LE(*peak, p.wire.peak + 1e-9);
    EXPECT_GE(*least, p.wire.least - 1e-9);
    if (!saturated) continue;
    EXPECT_GT(*peak - 30, 0.9 * (p.wire.peak - 30)) << "the brake is open, and the wire's path accelerates";
    EXPECT_LT(*least, 0) << "the brake pulls with all that it has";
  }
}

TEST(WireRun, TellsWireAndTimes) {
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
  EXPECT_NEAR(three.strokes_per_minute, 3 * 60 / three.motion.duration, 1e-9);
}

}  // namespace
}  // namespace bahnwerk
