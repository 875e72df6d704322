// Motion laws with a mechanical cam, and with a drive and its load.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kind.hpp"
#include "core/base/infeasible_at.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api::motion_law {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;

const test::SpecPlanner planned("motion_law");
json example(const std::string& name) { return test::read_json(test::source("examples/" + name + ".json")).at("spec"); }
json swinging() {
  json spec = example("radial_cam");
  spec["slave"]["unit"] = "deg";
  spec["points"][1]["position"] = 20, spec["points"][2]["position"] = 20;
  spec["cam"] = json::parse(R"({"type":"radial","follower":"oscillating","arm":80,"distance":100,"roller_radius":10,
    "base_radius":null,"pressure_angle":40})");
  return spec;
}
json barrel() {
  json spec = example("radial_cam");
  spec["cam"] = json::parse(R"({"type":"barrel","follower":"translating","roller_radius":6,"pressure_angle":30})");
  return spec;
}
/// Returns the pointers of what makes a plan impossible, and its message.
std::pair<std::vector<std::string>, std::string> refusal(const json& spec) {
  Progress silent;
  try {
    find_kind("motion_law")->plan(spec, silent);
  } catch (const InfeasibleAt& error) {
    std::vector<std::string> places;
    for (const InputFault& fault : error.faults) places.push_back(fault.place.at(0) + "/" + fault.place.at(1));
    return {places, error.what()};
  }
  return {};
}
std::vector<std::string> faults(const json& spec) {
  const auto problem = test::refusal(test::job_with_spec("motion_law", spec).dump());
  return problem ? test::pointers(*problem) : std::vector<std::string>{};
}

TEST(MotionLawCam, EveryTypeOfCamIsVerified) {
  for (const json& spec : {example("radial_cam"), example("flat_cam"), swinging(), barrel()}) {
    const PlannedJob job = planned(spec);
    EXPECT_TRUE(job.verified) << job.result["verification"].dump(1);
    const json cam = job.result["details"]["cam"];
    EXPECT_EQ(cam["undercut"], false);
    EXPECT_LE(cam["excluded_base_radius"].get<double>(), cam["least_base_radius"].get<double>());
    EXPECT_EQ(job.result["details"]["drawings"]["cam.svg"].get<std::string>().substr(0, 4), "<svg");
    EXPECT_THAT(job.result["details"]["drawings"]["cam.dxf"].get<std::string>(), HasSubstr("SPLINE"));
    if (!spec["cam"].contains("pressure_angle")) continue;
    const double limit = spec["cam"]["pressure_angle"].get<double>(),
                 angle = std::max(cam["pressure_angle"]["max"]["value"].get<double>(),
                                  -cam["pressure_angle"]["min"]["value"].get<double>());
    EXPECT_NEAR(angle, limit, 1e-3);  // the least radius is taken
  }
}

TEST(MotionLawCam, TheProfileIsPlannedAsAContour) {
  for (const json& spec : {example("radial_cam"), barrel()}) {
    const json contour = planned(spec).result["details"]["cam"]["contour"];
    EXPECT_FALSE(test::refusal(contour.dump()));
    const PlannedJob job = test::SpecPlanner("contour")(contour["spec"]);
    EXPECT_TRUE(job.verified);
    EXPECT_GT(job.result["summary"]["path_length"].get<double>(), 100);
  }
}

TEST(MotionLawCam, AnUndercutIsNamedByItsAngleAndByWhatAvoidsIt) {
  json spec = example("radial_cam");
  spec["points"] =
      json::parse(R"([{"at":0,"position":0,"law":"polynomial_345"},{"at":40,"position":20,"law":"polynomial_345"},
    {"at":80,"position":0,"law":"straight"}])");
  spec["cam"] = json::parse(R"({"type":"radial","follower":"translating","base_radius":10,"roller_radius":20})");
  const auto [places, message] = refusal(spec);
  EXPECT_THAT(places, Contains("cam/base_radius"));
  EXPECT_THAT(message, HasSubstr("undercut at"));
  EXPECT_THAT(message, HasSubstr("a roller radius below"));
  EXPECT_THAT(message, HasSubstr("a base circle of"));
  const std::string radius = message.substr(message.find("a base circle of ") + 17);
  spec["cam"]["base_radius"] = std::stod(radius);
  EXPECT_TRUE(planned(spec).verified);
}

TEST(MotionLawCam, AFlatFollowersUndercutNamesTheRadius) {
  json spec = example("flat_cam");
  spec["cam"] = json::parse(R"({"type":"radial","follower":"flat","base_radius":8})");
  const auto [places, message] = refusal(spec);
  EXPECT_THAT(message, HasSubstr("undercut at"));
  EXPECT_THAT(places, Contains("cam/base_radius"));
}

TEST(MotionLawCam, APressureAngleAboveItsLimitNamesTheRadiusThatKeepsIt) {
  json spec = example("radial_cam");
  spec["cam"]["base_radius"] = 20;
  const auto [places, message] = refusal(spec);
  EXPECT_THAT(places, Contains("cam/base_radius"));
  EXPECT_THAT(message, HasSubstr("the pressure angle is"));
  EXPECT_THAT(message, HasSubstr("a base circle of 24.87"));
}

TEST(MotionLawCam, MembersThatDoNotBelongToTheFollowerAreRefused) {
  json spec = example("radial_cam");
  spec["cam"]["arm"] = 50;
  EXPECT_THAT(faults(spec), Contains("/spec/cam/arm"));
  spec = swinging();
  spec["cam"].erase("arm");
  EXPECT_THAT(faults(spec), Contains("/spec/cam/arm"));
  spec = example("flat_cam");
  spec["cam"]["roller_radius"] = 5, spec["cam"]["pressure_angle"] = 20;
  EXPECT_THAT(faults(spec), Contains("/spec/cam/roller_radius"));
  EXPECT_THAT(faults(spec), Contains("/spec/cam/pressure_angle"));
  spec = barrel();
  spec["cam"]["follower"] = "flat";
  EXPECT_THAT(faults(spec), Contains("/spec/cam/follower"));
  spec = swinging();
  spec["slave"]["unit"] = "mm";
  EXPECT_THAT(faults(spec), Contains("/spec/slave"));
  spec = example("radial_cam");
  spec["cam"].erase("pressure_angle"), spec["cam"].erase("profile_radius");
  EXPECT_THAT(faults(spec), Contains("/spec/cam/base_radius"));
  spec["cam"]["base_radius"] = 40, spec["master"]["length"] = 180;
  EXPECT_THAT(faults(spec), Contains("/spec/master"));
}

TEST(MotionLawCam, AVelocityThatJumpsIsACorner) {
  json spec = example("flat_cam");
  for (json& point : spec["points"]) point.erase("law");
  for (json& point : spec["points"]) point["law"] = "straight", point["continuity"] = 0;
  const auto [places, message] = refusal(spec);
  EXPECT_THAT(message, HasSubstr("corner"));
}

json swivel_table() { return example("swivel_table"); }

TEST(MotionLawLoad, AnIndexingTableKeepsItsTorque) {
  const PlannedJob job = planned(swivel_table());
  EXPECT_TRUE(job.verified) << job.result["verification"].dump(1);
  const json load = job.result["details"]["load"];
  EXPECT_EQ(load["unit"], "N m");
  const double limit = swivel_table()["drive"]["torque"].get<double>();
  EXPECT_LE(job.result["summary"]["peak_load"].get<double>(), limit * (1 + 1e-6));
  EXPECT_LT(load["rms"].get<double>(), limit);
  EXPECT_EQ(load["curve"]["phi"].size(), load["curve"]["power"].size());
  EXPECT_EQ(job.result["details"]["drawings"]["load.svg"].get<std::string>().substr(0, 4), "<svg");
}

TEST(MotionLawLoad, ALimitThatALawWithoutItExceedsIsPlannedFor) {
  json spec = swivel_table();
  spec["drive"].erase("torque");
  spec["objective"] = {{"velocity", 0}, {"acceleration", 0}, {"jerk", 1}};
  const double free = planned(spec).result["summary"]["peak_load"].get<double>();
  spec["drive"]["torque"] = 0.97 * free;
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  EXPECT_LE(job.result["summary"]["peak_load"].get<double>(), 0.97 * free * (1 + 1e-6));
}

TEST(MotionLawLoad, TheShortestCycleWithinATorqueUsesIt) {
  json spec = swivel_table();
  spec["master"]["cycle_duration"] = nullptr;
  spec["drive"] = {{"torque", 12}};
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified) << job.result["verification"].dump(1);
  EXPECT_NEAR(job.result["summary"]["peak_load"].get<double>(), 12, 0.05);
}

TEST(MotionLawLoad, ATorqueThatASpringExceedsIsRefusedByName) {
  json spec = swivel_table();
  spec["load"]["spring"] = 0.2, spec["drive"] = {{"torque", 1}};
  Progress silent;
  std::vector<std::vector<std::string>> places;
  try {
    find_kind("motion_law")->plan(spec, silent);
  } catch (const InvalidInput& error) {
    for (const InputFault& fault : error.faults) places.push_back(fault.place);
  }
  EXPECT_THAT(places, Contains(std::vector<std::string>{"drive", "torque"}));
  spec["master"]["cycle_duration"] = nullptr;
  EXPECT_THAT(faults(spec), Contains("/spec/drive/torque"));
}

TEST(MotionLawLoad, DriveLimitsHoldInAGivenCycle) {
  json spec = swivel_table();
  spec.erase("load");
  spec["drive"] = json::object();
  spec["objective"] = {{"velocity", 0}, {"acceleration", 0}, {"jerk", 1}};
  spec.erase("drive");
  const double free = planned(spec).result["summary"]["peak_velocity"].get<double>();
  spec["drive"] = {{"velocity", 0.97 * free}};
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  EXPECT_LE(job.result["summary"]["peak_velocity"].get<double>(), 0.97 * free * (1 + 1e-8));
}

TEST(MotionLawLoad, ATorqueThatExcludesEveryLawIsNamedItself) {
  json spec = swivel_table();
  spec["drive"] = {{"torque", 2}};
  Progress silent;
  try {
    find_kind("motion_law")->plan(spec, silent);
    ADD_FAILURE() << "planned";
  } catch (const InvalidInput& error) {
    for (const InputFault& fault : error.faults)
      EXPECT_TRUE(fault.place.front() == "drive" || fault.place.size() < 4) << fault.place.back() << fault.message;
  } catch (const Infeasible& error) {
    EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("internal")));
  }
}

TEST(MotionLawCam, AFollowerThatLeavesTheCamIsRefusedAtItsContact) {
  json spec = example("radial_cam");
  spec["cam"]["contact"] = {{"force", 1}, {"mass", 5}, {"width", 10}};
  const auto [places, message] = refusal(spec);
  EXPECT_THAT(places, Contains("cam/contact"));
  EXPECT_THAT(message, HasSubstr("leaves the cam"));
}

TEST(MotionLawLoad, UnitsOfTheLoadAreThoseOfTheSlave) {
  json spec = swivel_table();
  spec["load"]["lead"] = 5;
  EXPECT_THAT(faults(spec), Contains("/spec/load/lead"));
  spec = swivel_table();
  spec["drive"] = {{"force", 5}};
  EXPECT_THAT(faults(spec), Contains("/spec/drive/force"));
  spec = swivel_table();
  spec.erase("load");
  EXPECT_THAT(faults(spec), Contains("/spec/drive/torque"));
}

}  // namespace
}  // namespace bahnwerk::api::motion_law
