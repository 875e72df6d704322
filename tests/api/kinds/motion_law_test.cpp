#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "api/kind.hpp"
#include "api/kinds/motion_law/controller_layouts.hpp"
#include "api/kinds/motion_law/motion_law_input.hpp"
#include "core/base/progress.hpp"
#include "tests/api/checked.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api::motion_law {
namespace {

using nlohmann::json;

PlannedJob planned(const json& spec) {
  SilentProgress silent;
  return test::checked(find_kind("motion_law")->plan(spec, silent));
}
json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/motion_law/" + name + ".json"));
}
/// Two rests and a range between them; the range's lower end holds.
json through_a_range() {
  return json::parse(R"({"master":{"length":130,"cycle_duration":130},"periodic":false,"method":"active_set","points":[
    {"at":0,"position":0,"velocity":0,"acceleration":0},{"at":55,"position":{"min":24,"max":26},"continuity":3},
    {"at":130,"position":45,"velocity":0,"acceleration":0}],
    "objective":{"velocity":1,"acceleration":30,"jerk":900},"cycle_time":0.5})");
}

TEST(MotionLaw, ResultHasTheContractsForm) {
  const PlannedJob job = planned(through_a_range());
  EXPECT_TRUE(job.verified) << job.result["verification"].dump(1);
  const auto& r = job.result;
  EXPECT_NEAR(r["summary"]["objective"].get<double>(), 3.29793321, 1e-8);
  EXPECT_EQ(r["summary"]["cycle_duration"], 130);
  EXPECT_EQ(json(r["details"]["conversions"]), json::parse(R"([{"point":1,"derivative":0,"value":24.0}])"));
  EXPECT_EQ(r["details"]["sections"].size(), 2u);
  EXPECT_EQ(r["setpoints"]["count"], 261);
  EXPECT_EQ(r["setpoints"]["columns"][0]["unit"], "deg");
  EXPECT_LE(r["bound"]["objective"].get<double>(), r["summary"]["objective"].get<double>());
  EXPECT_EQ(r["details"]["drawings"]["law.svg"].get<std::string>().substr(0, 4), "<svg");
  std::vector<double> row(5);
  job.setpoints->read(110, 1, row.data());
  EXPECT_NEAR(row[0], 55, 1e-12);
  EXPECT_NEAR(row[1], 24, 1e-12);
}

TEST(MotionLaw, PowerAndBernsteinCoefficientsAreTheSamePolynomial) {
  const PlannedJob job = planned(through_a_range());
  for (const auto& section : job.result["details"]["sections"])
    for (const auto& piece : section["pieces"]) {
      double sum = 0;
      for (const double c : piece["power"]) sum += c;
      EXPECT_NEAR(sum, piece["bernstein"].back().get<double>(), 1e-11);
      EXPECT_EQ(piece["power"][0], piece["bernstein"][0]);
    }
}

TEST(MotionLaw, EveryExampleOfTheMethodIsVerified) {
  for (const char* name : {"tolerance_boxes", "classical", "mixed", "free_angles", "classical_optimal"}) {
    const PlannedJob job = planned(example(name));
    EXPECT_TRUE(job.verified) << name << job.result["verification"].dump(1);
  }
}

TEST(MotionLaw, CoefficientsOfAClassicalSectionAreInTheResult) {
  const auto sections = planned(example("classical")).result["details"]["sections"];
  EXPECT_EQ(sections[0]["law"], "modified_sine");
  EXPECT_NEAR(sections[0]["cv"].get<double>(), 1.759603, 1e-6);
  EXPECT_NEAR(sections[0]["ca"].get<double>(), 5.527957, 1e-6);
  EXPECT_TRUE(sections[1]["cv"].is_null());  // a dwell has no stroke
}

TEST(MotionLaw, ClassicalSectionsBesideOptimalOnesAreInTheResult) {
  const json result = planned(example("classical_optimal")).result;
  const json& sections = result["details"]["sections"];
  EXPECT_EQ(sections[0]["law"], "inclined_sine");
  EXPECT_NEAR(sections[0]["cv"].get<double>(), 2, 1e-9);
  EXPECT_TRUE(sections[2]["law"].is_null());
  EXPECT_LE(result["bound"]["objective"], result["summary"]["objective"]);
  EXPECT_THAT(result["bound"]["basis"].get<std::string>(), testing::HasSubstr("contain the classical sections"));
}

TEST(MotionLaw, ALawThatLeavesTheRangeOfItsPointsSaysWhichLimitKeepsIt) {
  json spec =
      json::parse(R"({"master":{"length":360,"cycle_duration":1},"periodic":true,"method":"active_set","points":[
    {"at":0,"position":0},{"at":60,"position":50},{"at":140,"position":50},{"at":220,"position":0},{"at":300,"position":0}]})");
  const auto notes = planned(spec).result["details"]["notes"];
  ASSERT_FALSE(notes.empty());
  EXPECT_THAT(notes[0].get<std::string>(),
              testing::HasSubstr("\"section\": {\"position\": {\"max\": 50.0}} in point 1"));
}

TEST(MotionLaw, WhatHasNoEffectIsNoted) {
  json spec = through_a_range();
  spec["degree"] = 7;
  EXPECT_THAT(planned(spec).result["details"]["notes"][0].get<std::string>(),
              testing::HasSubstr("degree has no effect"));
}

TEST(MotionLaw, TheSameDocumentGivesTheSameBits) {
  EXPECT_EQ(planned(example("free_angles")).result.dump(), planned(example("free_angles")).result.dump());
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

TEST(ControllerLayouts, EveryLayoutHoldsTheLaw) {
  const json result = json::parse(planned(through_a_range()).result.dump());
  for (const auto& entry : controller_layouts) {
    const ControllerFile file = controller_file(result, entry.value);
    EXPECT_GT(lines(file.text).size(), 2u) << entry.name;
    EXPECT_THAT(file.refit_error, testing::HasSubstr("jerk")) << entry.name;
  }
  const auto nc = controller_file(result, ControllerLayout::twincat_nc);
  ASSERT_EQ(lines(nc.text).size(), 4u);  // degrees 4 and 5: three points, exact
  EXPECT_EQ(lines(nc.text)[1].substr(0, 13), "1;15;1;1;0;0;");
  EXPECT_LT(nc.error[0], 1e-12);
  EXPECT_LT(nc.error[3], 1e-12);
  EXPECT_EQ(lines(controller_file(result, ControllerLayout::lcamhdl_basic).text).size(), 4u);
  EXPECT_EQ(lines(controller_file(result, ControllerLayout::lcamhdl_xy).text).size(), 1001u);
  EXPECT_THAT(controller_file(result, ControllerLayout::codesys_xyva, "lift").text,
              testing::HasSubstr("lift : MC_CAM_REF := (nElements := 3, byType := 3, xStart := 0, xEnd := 130,"));
}

TEST(ControllerLayouts, IsgTablesHaveOneColumnThatTheControllerClosesOverTheCycle) {
  const json closed = json::parse(planned(example("free_angles")).result.dump());
  const ControllerFile file = controller_file(closed, ControllerLayout::isg, "lift");
  const auto rows = lines(file.text);
  ASSERT_EQ(rows.size(), 5u + 2u + 1u + 1000u + 1u);
  EXPECT_EQ(rows[0], "Tablename=lift\r");
  EXPECT_EQ(rows[2], "Tabletype=3\r");     // one column of floating-point numbers
  EXPECT_EQ(rows[3], "Functiontype=1\r");  // straight lines
  EXPECT_EQ(rows[4], "Lines=1000\r");
  EXPECT_EQ(rows.back(), "EndTable\r");
  // Row 250 of 1000 is the position at a quarter of the cycle, in 1e-4 mm.
  const auto pairs = lines(controller_file(closed, ControllerLayout::codesys_xy).text);
  ASSERT_EQ(pairs.size(), 1001u);
  EXPECT_NEAR(std::stod(rows[8 + 250]), 1e4 * std::stod(pairs[250].substr(pairs[250].find('\t'))), 1e-6);
  EXPECT_NEAR(file.error[0], controller_file(closed, ControllerLayout::codesys_xy).error[0], 1e-9);

  // From 0 to 45 mm: the table closes, and says so.
  const ControllerFile open =
      controller_file(json::parse(planned(through_a_range()).result.dump()), ControllerLayout::isg);
  EXPECT_GT(open.error[0], 1);
  EXPECT_THAT(open.text, testing::HasSubstr("# differs from the law by: position "));
}

}  // namespace
}  // namespace bahnwerk::api::motion_law
