#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "api/kind.hpp"
#include "api/kinds/motion_law/controller_layouts.hpp"
#include "api/kinds/motion_law/motion_law_input.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api::motion_law {
namespace {

using nlohmann::json;

const test::SpecPlanner planned("motion_law");
json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/motion_law/" + name + ".json"));
}
/// Where a document with this spec has faults.
std::vector<std::string> fault_pointers(const json& spec) {
  const auto refused = test::refusal(json{{"kind", "motion_law"}, {"spec", spec}}.dump());
  return refused ? test::pointers(*refused) : std::vector<std::string>{};
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

TEST(MotionLaw, FractionsBelongToTheSineStraightCombinationAndFillASectionAtMost) {
  const auto with = [](const char* law, const json& fractions) {
    json spec = json::parse(R"({"master":{"length":120,"cycle_duration":0.2},"periodic":false,"points":[
      {"at":0,"position":0,"velocity":0},{"at":120,"position":30,"velocity":0}]})");
    spec["points"][0]["law"] = law;
    if (!fractions.is_null()) spec["points"][0]["fractions"] = fractions;
    return spec;
  };
  const json fits = {{"b", 0.2}, {"c", 0.3}, {"d", 0.5}};
  const json section = planned(with("sine_straight_combination", fits)).result["details"]["sections"][0];
  EXPECT_NEAR(section["ca"].get<double>(), 4.9087735, 1e-6);  // Norton's formula
  const std::vector<std::string> at_fractions{"/spec/points/0/fractions"};
  EXPECT_EQ(fault_pointers(with("sine_straight_combination", nullptr)), at_fractions);
  EXPECT_EQ(fault_pointers(with("modified_sine", fits)), at_fractions);
  for (const double d : {0.6, 0.4999, 1e-4})
    EXPECT_EQ(fault_pointers(with("sine_straight_combination", {{"b", 0.2}, {"c", 0.3}, {"d", d}})), at_fractions) << d;
}

TEST(MotionLaw, AWeightOfASectionIsInTheResultAndBelongsToAKnownCycle) {
  json spec =
      json::parse(R"({"master":{"length":360,"cycle_duration":0.6},"periodic":false,"degree":5,"pieces":2,"points":[
    {"at":0,"position":0,"velocity":0,"acceleration":0},
    {"at":60,"position":30,"velocity":0,"acceleration":0,"section":{"weight":2,"velocity":{"max":0}}},
    {"at":360,"position":0,"velocity":0,"acceleration":0}]})");
  const json sections = planned(spec).result["details"]["sections"];
  EXPECT_TRUE(sections[0]["weight"].is_null());
  EXPECT_EQ(sections[1]["weight"], 2);
  // Both are rests of the same stroke: the peaks differ by the durations' ratio, and nothing else.
  EXPECT_NEAR(sections[0]["peaks"]["acceleration"].get<double>(),
              25 * sections[1]["peaks"]["acceleration"].get<double>(),
              0.05 * sections[0]["peaks"]["acceleration"].get<double>());
  spec["master"]["cycle_duration"] = nullptr;
  spec["drive"] = {{"acceleration", 1000}};
  EXPECT_EQ(fault_pointers(spec), std::vector<std::string>{"/spec/points/1/section/weight"});
}

TEST(MotionLaw, CoefficientsOfAClassicalSectionAreInTheResult) {
  const auto sections = planned(example("classical")).result["details"]["sections"];
  EXPECT_EQ(sections[0]["law"], "modified_sine");
  EXPECT_NEAR(sections[0]["cv"].get<double>(), 1.759603, 1e-6);
  EXPECT_NEAR(sections[0]["ca"].get<double>(), 5.527957, 1e-6);
  EXPECT_TRUE(sections[1]["cv"].is_null());  // a dwell has no stroke
}

TEST(MotionLaw, PiecesOfTheComparedLawGoThroughTheWholeCycleAndHaveItsPeakVelocity) {
  const json result = planned(example("tolerance_boxes")).result;
  const json& classical = result["details"]["classical"];
  const json& pieces = classical["pieces"];
  EXPECT_NEAR(pieces.front()["begin"].get<double>(), 0, 1e-12);
  EXPECT_NEAR(pieces.back()["end"].get<double>(), 360, 1e-9);
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i]["end"], pieces[i + 1]["begin"]);
    EXPECT_NEAR(pieces[i]["bernstein"].back().get<double>(), pieces[i + 1]["bernstein"].front().get<double>(), 1e-9);
  }
  // The control polygon of the velocity holds its peak.
  double most = 0;
  for (const json& piece : pieces) {
    const std::vector<double> b = piece["bernstein"];
    const double seconds = (piece["end"].get<double>() - piece["begin"].get<double>()) / 360 *
                           result["summary"]["cycle_duration"].get<double>();
    for (std::size_t k = 0; k + 1 < b.size(); ++k)
      most = std::max(most, static_cast<double>(b.size() - 1) * std::abs(b[k + 1] - b[k]) / seconds);
  }
  EXPECT_GE(most, classical["peak_velocity"].get<double>() * (1 - 1e-9));
  EXPECT_LE(most, classical["peak_velocity"].get<double>() * 1.5);
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

TEST(MotionLaw, ADwellAndAMonotoneSectionAreOneWordEach) {
  const json words = json::parse(R"({"master":{"length":360,"cycle_duration":1},"periodic":true,"degree":6,"points":[
    {"at":0,"position":0,"section":"monotone"},{"at":90,"position":30,"section":"dwell"},
    {"at":140,"section":"monotone"},{"at":270,"position":0,"section":"dwell"}]})");
  json written = words;
  for (const int p : {0, 1, 2, 3}) {
    json& point = written["points"][static_cast<std::size_t>(p)];
    point.erase("section");
    point["velocity"] = 0, point["acceleration"] = 0, point["position"] = p == 1 || p == 2 ? 30 : 0;
    if (p % 2 == 1) point["law"] = "straight";
  }
  written["points"][0]["section"]["velocity"]["min"] = 0;
  written["points"][2]["section"]["velocity"]["max"] = 0;
  const json one = planned(words).result, other = planned(written).result;
  EXPECT_EQ(one["details"]["sections"], other["details"]["sections"]);
  EXPECT_TRUE(planned(words).verified);
}

TEST(MotionLaw, AWordThatFitsNoSectionIsNamed) {
  json spec = json::parse(R"({"master":{"length":100,"cycle_duration":1},"periodic":false,"points":[
    {"at":0,"position":0,"section":"dwell"},{"at":50,"position":{"min":-1,"max":20},"section":"monotone"},
    {"at":100,"position":10}]})");
  spec["points"][1]["position"] = 20;
  EXPECT_EQ(fault_pointers(spec), std::vector<std::string>{"/spec/points/0/section"});
  spec["points"][0].erase("section");
  spec["points"][1]["position"] = json::parse(R"({"min":5,"max":20})");
  EXPECT_EQ(fault_pointers(spec), std::vector<std::string>{"/spec/points/1/section"});
}

TEST(MotionLaw, TheTravelIsTheDifferenceOfTheLastRowAndTheFirstOne) {
  const json spec = json::parse(R"({"master":{"length":360,"cycle_duration":1},"periodic":true,"travel":60,"points":[
    {"at":20,"position":0},{"at":140,"position":{"min":30,"max":35}}]})");
  const PlannedJob job = planned(spec);
  ASSERT_TRUE(job.verified);
  EXPECT_EQ(job.result["details"]["master"]["travel"], 60);
  std::vector<double> first(5), last(5);
  job.setpoints->read(0, 1, first.data());
  job.setpoints->read(job.setpoints->count() - 1, 1, last.data());
  EXPECT_NEAR(last[1] - first[1], 60, 1e-11);
  for (const std::size_t column : {2u, 3u, 4u}) EXPECT_EQ(last[column], first[column]);
  json open = spec;
  open["periodic"] = false;
  open["points"] = json::parse(R"([{"at":0,"position":0},{"at":360,"position":60}])");
  EXPECT_EQ(fault_pointers(open), std::vector<std::string>{"/spec/travel"});
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
