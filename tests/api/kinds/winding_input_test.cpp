// What is read from the document of a winding.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "api/kinds/winding/winding.hpp"
#include "core/base/errors.hpp"
#include "core/machine/robot_winder.hpp"
#include "tests/api/kinds/winding_documents.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;

std::vector<std::string> fault_places(const json& spec) {
  std::vector<std::string> places;
  try {
    request(spec);
  } catch (const InvalidInput& error) {
    for (const InputFault& fault : error.faults) {
      std::string place;
      for (const std::string& token : fault.place) place += "/" + token;
      places.push_back(place);
    }
  }
  return places;
}

TEST(WindingInput, ReadsAStator) {
  const WindingRequest r = request(example("complete"));
  const auto& part = std::get<winding::StatorPart>(r.part);
  EXPECT_EQ(part.slots, 48);
  EXPECT_NEAR(part.slot.tip_angle, 92.5 * degree, 1e-15);
  EXPECT_EQ(part.heads.tool_radius, 99.971);
  EXPECT_EQ(part.heads.tool_height, 15.5);
  EXPECT_NEAR(r.wire.outer, 0.989, 1e-12);
  EXPECT_EQ(r.coils, (std::vector<winding::Coil>{{0, 5}, {17, -5}}));
  EXPECT_EQ(r.turns, 2u);
  EXPECT_EQ(r.feed, PlanningMethod::natural);
  EXPECT_EQ(r.along.velocity, 700);
  EXPECT_EQ(r.along.jerk, 60000);
  EXPECT_EQ(r.profile, SpeedProfile::double_s);
  EXPECT_EQ(r.chord_tolerance, 0.005);
  EXPECT_EQ(r.half_speed_curvature, 0.2);
  EXPECT_NEAR(*r.model.pivot_limit, 10 * degree, 1e-15);
  EXPECT_NEAR(r.model.pull.bending_moment, winding::bending_moment(r.wire), 1e-12);
  EXPECT_EQ(r.model.change_height, 10);
  EXPECT_EQ(r.least_clearance, -5);
  EXPECT_EQ(r.links.weights.rate, 8);
  EXPECT_EQ(r.cycle_time, 0.002);
}

TEST(WindingInput, DefaultsAreTheSources) {
  json spec = example("complete");
  for (const char* member : {"base_radius", "tool_radius", "tool_shift", "tool_height", "stack", "slots"})
    spec["part"].erase(member);
  const WindingRequest r = request(spec);
  const auto& part = std::get<winding::StatorPart>(r.part);
  const winding::StatorHeads source;
  EXPECT_EQ(part.slots, 48);
  EXPECT_NEAR(part.heads.base_radius, source.base_radius, 1e-9);
  EXPECT_NEAR(part.heads.tool_radius, source.tool_radius, 1e-9);
  EXPECT_EQ(part.heads.tool_shift, source.tool_shift);
  EXPECT_EQ(part.heads.stack, source.stack);

  const WindingRequest least = request(example("minimal"));
  const auto& rotor = std::get<winding::RotorPart>(least.part);
  EXPECT_EQ(rotor.poles, 6);
  EXPECT_EQ(rotor.heads.cap_base, winding::RotorHeads{}.cap_base);
  EXPECT_EQ(least.feed, PlanningMethod::jerk_limited);
  EXPECT_EQ(least.along.velocity, unlimited);
  EXPECT_FALSE(least.model.pivot_limit);
  EXPECT_EQ(least.links.continuity, 3u);
  EXPECT_EQ(least.coils.size(), 1u);
}

TEST(WindingInput, TakesTheMachinesOfTheExamplesAsTheyAre) {
  for (const char* name : {"robot", "vertical", "horizontal"}) {
    json spec = example("minimal");
    spec["machine"] = machine(name);
    EXPECT_FALSE(test::refusal(test::job_with_spec("winding", spec).dump())) << name;
    const WindingRequest r = request(spec);
    EXPECT_EQ(r.configurations.size(), name == std::string("robot") ? 2u : 1u);
    for (const auto& machine : r.configurations)
      for (const AxisLimits& axis : machine->axes()) {
        const json& said = spec["machine"]["axes"][axis.name];
        const double unit = axis.unit == "rad" ? degree : 1;
        EXPECT_NEAR(axis.velocity, unit * said["velocity"].get<double>(), 1e-12 * axis.velocity) << axis.name;
        EXPECT_NEAR(axis.jerk, unit * said["jerk"].get<double>(), 1e-12 * axis.jerk) << axis.name;
        EXPECT_EQ(axis.highest == unlimited, said["range"].is_null()) << axis.name;
      }
  }
}

TEST(WindingInput, TheArmCanBeChosen) {
  for (const auto& [name, arm] : {std::pair{"lefty", RobotArm::lefty}, {"righty", RobotArm::righty}}) {
    json spec = example("complete");
    spec["machine"]["arm"] = name;
    const WindingRequest r = request(spec);
    ASSERT_EQ(r.configurations.size(), 1u);
    EXPECT_EQ(dynamic_cast<const RobotWinder&>(*r.configurations[0]).arm(), arm);
  }
}

TEST(WindingInput, FaultsOfSlotAndHeadsAreNamedWithinThePart) {
  json spec = example("minimal");
  spec["part"]["slot"]["groove_radius"] = 0.3;
  spec["part"]["slot"]["base_width"] = 12;
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/part/slot/groove_radius", "/part/slot/base_width"));
  spec = example("minimal");
  spec["part"]["cap_height"] = 5;
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/part/cap_height"));
}

TEST(WindingInput, CoilsMayNotLieOnEachOther) {
  json spec = example("complete");
  spec["coil"]["repeat"] = {{"step", 1}, {"count", 5}};
  EXPECT_THAT(fault_places(spec), testing::IsEmpty()) << "0 … 4 with 5 … 9";
  spec["coil"]["repeat"]["count"] = 6;
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/coil/repeat"));
  spec = example("minimal");
  spec["coil"]["repeat"] = {{"step", 1}, {"count", 6}, {"alternate", false}};
  EXPECT_THAT(fault_places(spec), testing::IsEmpty()) << "all poles of a rotor";
  spec["coil"]["repeat"]["count"] = 7;
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/coil/repeat"));
}

TEST(WindingInput, ReadsTheInterpolatorAndTheWiresPull) {
  json spec = example("minimal");
  const WindingRequest plain = request(spec);
  EXPECT_EQ(plain.interpolator, Interpolator::exact);
  EXPECT_EQ(plain.tension.mass, 0);
  EXPECT_EQ(plain.tension.friction, 0);
  EXPECT_EQ(plain.tension.range, 0);
  EXPECT_NEAR(plain.tension.permitted, 120 * std::numbers::pi / 4 * 1.12 * 1.12, 1e-9);
  spec["feed"]["interpolator"] = "quartic";
  spec["pull"] = {{"force", 25}, {"effective_mass", 0.1}, {"friction", 0.2}, {"brake_range", 50}, {"permitted", 40}};
  const WindingRequest r = request(spec);
  EXPECT_EQ(r.interpolator, Interpolator::quartic);
  EXPECT_EQ(r.tension.force, 25);
  EXPECT_EQ(r.tension.mass, 0.1);
  EXPECT_EQ(r.tension.friction, 0.2);
  EXPECT_EQ(r.tension.range, 50);
  EXPECT_EQ(r.tension.permitted, 40);
  spec["pull"] = {{"force", 25}, {"brake_range", 20}, {"permitted", 24}};
  EXPECT_THAT(fault_places(spec), testing::UnorderedElementsAre("/pull/force", "/pull/brake_range"));
}

TEST(WindingInput, ThePullFollowsFromWhatTheWireBears) {
  json spec = example("minimal");
  const double section = std::numbers::pi / 4 * 1.12 * 1.12;
  EXPECT_NEAR(request(spec).tension.force, 20 * section, 1e-9) << "a tenth of 200 N/mm²";
  EXPECT_NEAR(request(spec).model.pull.force, 20 * section, 1e-9);
  spec["pull"] = {{"force", nullptr}, {"strength", 240}};
  EXPECT_NEAR(request(spec).tension.force, 24 * section, 1e-9);
  EXPECT_NEAR(request(spec).bears, 240 * section, 1e-9);
  // Drawn thinner, which a note says, up to where it breaks.
  spec["pull"] = {{"force", 130}};
  EXPECT_NEAR(request(spec).tension.permitted, 200 * section, 1e-9);
  spec["pull"] = {{"force", 200}};
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/pull/force"));
  spec["pull"] = {{"force", 200}, {"strength", 220}};
  EXPECT_THAT(fault_places(spec), testing::IsEmpty());
  // A thin wire with what suits a thick one.
  spec["wire"] = 0.25;
  spec["pull"] = {{"force", 30}};
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/pull/force"));
  spec["pull"] = {{"permitted", 30}};
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/pull/permitted"));
}

/// The first message at that place.
std::string message_at(const json& spec, const std::string& place) {
  try {
    request(spec);
  } catch (const InvalidInput& error) {
    for (const InputFault& fault : error.faults) {
      std::string at;
      for (const std::string& token : fault.place) at += "/" + token;
      if (at == place) return fault.message;
    }
  }
  return {};
}

TEST(WindingInput, ObstructionsOfTheOpeningAreReportedInMillimetres) {
  json spec = example("complete");
  spec["needle"]["width"] = 3.3;
  EXPECT_THAT(message_at(spec, "/needle/width"),
              testing::AllOf(testing::HasSubstr("3.3 mm"), testing::HasSubstr("3.083 mm")));
  spec["needle"].erase("width");
  spec["wire"] = 2.8;
  EXPECT_THAT(message_at(spec, "/needle/width"),
              testing::AllOf(testing::HasSubstr("2.6 mm (the default)"), testing::HasSubstr("2.922 mm")));
  EXPECT_EQ(message_at(spec, "/wire"), "") << "it passes the opening";
  // Between the coils of a rotor: 2 (x sin 30° - y cos 30°) at the pole shoe's end.
  spec = example("minimal");
  spec["needle"] = {{"width", 25}};
  EXPECT_THAT(message_at(spec, "/needle/width"), testing::HasSubstr("neighbouring poles"));
}

TEST(WindingInput, WiresInHandRunInTheNeedleTogether) {
  json spec = example("minimal");
  spec["coil"]["parallel"] = 2;
  EXPECT_THAT(fault_places(spec), testing::IsEmpty()) << "2 · 1.217 mm in 2.6 mm";
  spec["coil"]["parallel"] = 3;
  EXPECT_THAT(message_at(spec, "/needle/width"),
              testing::AllOf(testing::HasSubstr("2.6 mm (the default)"), testing::HasSubstr("2.622 mm")));
  spec["needle"] = {{"width", 2.7}};
  EXPECT_THAT(fault_places(spec), testing::IsEmpty());
}

TEST(WindingInput, BendsAreSmallerThanHalfATurn) {
  json spec = example("minimal");  // 202 mm and two caps of 28 mm
  spec["pull"] = {{"bend_radius", 128.9}};
  EXPECT_THAT(fault_places(spec), testing::IsEmpty());
  spec["pull"] = {{"bend_radius", 129}};
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/pull/bend_radius"));
  spec["pull"] = {{"force", 0.2}};  // 150 · 1.12³/6 N mm
  EXPECT_THAT(message_at(spec, "/pull/force"), testing::HasSubstr("a circle of 175.6 mm"));
}

TEST(WindingInput, PostsBehindNeighbouringSlotsDoNotMeet) {
  json spec = example("complete");  // 2 (99.971 - 3) tan 3.75° = 12.71 mm
  spec["tool"] = {{"width", 12.7}};
  EXPECT_THAT(fault_places(spec), testing::IsEmpty());
  spec["tool"] = {{"width", 12.72}};
  EXPECT_THAT(fault_places(spec), testing::ElementsAre("/tool/width"));
  spec["tool"] = {{"thickness", 80}};
  EXPECT_THAT(message_at(spec, "/tool/thickness"), testing::HasSubstr("posts of 4 mm"));
}

TEST(WindingInput, SizesThatFitAreNotRefused) {
  json spec = example("complete");
  spec["needle"] = {{"width", 3.08}, {"length", 158.9}};
  spec["wire"] = 0.25;
  spec["coil"]["turns"] = 1;
  spec["pull"] = {{"bend_radius", 0.32}, {"free_length", 0}};
  EXPECT_THAT(fault_places(spec), testing::IsEmpty());
  spec["tool"] = {{"height", 15.5}};
  EXPECT_THAT(fault_places(spec), testing::IsEmpty());
  // The post follows the height at which the wire lies.
  spec.erase("tool");
  spec["part"]["tool_height"] = 30;
  EXPECT_NEAR(request(spec).tool.height, 34.5, 1e-12);
}

TEST(WindingInput, TakesASlotOfKindFillFactorAsItIs) {
  for (const char* name : {"complete", "minimal"}) {
    json spec = example(name);
    spec["part"]["slot"]["type"] = spec["part"]["type"];
    EXPECT_FALSE(test::refusal(test::job_with_spec("winding", spec).dump())) << name;
  }
}

}  // namespace
}  // namespace bahnwerk::api::winding_kind
