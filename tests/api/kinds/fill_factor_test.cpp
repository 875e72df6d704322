#include "api/kinds/fill_factor/fill_factor.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "api/kind.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api::fill_factor {
namespace {

using nlohmann::json;

const test::SpecPlanner planned("fill_factor");

json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/fill_factor/" + name + ".json"));
}

TEST(FillFactorInput, ReadsAStatorSlot) {
  const FillRequest r = request(example("complete"));
  EXPECT_EQ(r.slot.type, winding::Slot::Type::stator);
  EXPECT_NEAR(r.slot.usable_area.area(), 73.18, 0.01);
  EXPECT_EQ(r.wires.size(), 21u);
  EXPECT_EQ(r.algorithms.size(), 5u);
  const auto& heads = std::get<winding::StatorHeads>(r.heads);
  EXPECT_NEAR(heads.slot_pitch, 7.5 * std::numbers::pi / 180, 1e-15);
  EXPECT_NEAR(heads.base_radius, 95.7, 1e-12);
  EXPECT_EQ(r.parallel, 4u);
  EXPECT_FALSE(r.serial);
  EXPECT_EQ(r.sampling.samples, 20);
}

TEST(FillFactorInput, DefaultsAreTheSources) {
  json spec = example("complete");
  for (const char* member : {"heads", "tie_in", "algorithms", "wires", "wire_range", "robustness"}) spec.erase(member);
  const FillRequest r = request(spec), full = request(example("complete"));
  EXPECT_NEAR(std::get<winding::StatorHeads>(r.heads).tool_radius, 99.971, 1e-9);
  EXPECT_EQ(r.tie_in, full.tie_in);
  EXPECT_EQ(r.algorithms, full.algorithms);
  EXPECT_EQ(r.wires.size(), 11u);
  EXPECT_EQ(r.sampling.samples, 0);
}

TEST(FillFactorInput, ReadsWiresOfEveryForm) {
  const auto wires = request(example("wires")).wires;
  ASSERT_EQ(wires.size(), 3u);
  EXPECT_NEAR(wires[0].outer, 0.989, 1e-12);
  EXPECT_NEAR(wires[1].outer, 1.0, 1e-12);
  EXPECT_NEAR(wires[1].tolerance, wires[0].tolerance, 1e-12) << "of the standard wire next to it";
  EXPECT_NEAR(wires[2].tolerance, 0.02, 1e-12);
}

TEST(FillFactorInput, AllFaultsAreNamedAtOnce) {
  json spec = example("complete");
  spec["wires"] = {0.91, 0.9, 0.93};
  spec["algorithms"] = {"raabe", "raabe"};
  try {
    request(spec);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.faults.size(), 3u);
    EXPECT_THAT(error.faults[0].message, testing::HasSubstr("0.9 and 0.95"));
  }
}

TEST(FillFactorInput, NamesWiresOfTheSeriesAskedFor) {
  const auto message = [](const json& range) {
    json spec = example("minimal");
    spec["wires"] = "standard", spec["wire_range"] = range;
    try {
      request(spec);
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.faults.at(0).place, std::vector<std::string>{"wire_range"});
      return error.faults.at(0).message;
    }
    return std::string();
  };
  EXPECT_THAT(message({{"least", 1.01}, {"most", 1.05}}), testing::HasSubstr("R20; the nearest are 1 and 1.12"));
  EXPECT_THAT(message({{"least", 1.01}, {"most", 1.05}, {"series", "R40"}}), testing::HasSubstr("1 and 1.06"));
  EXPECT_EQ(message({{"least", 1.01}, {"most", 1.12}}), "") << "the wire that was named is found";
  EXPECT_EQ(message({{"least", 1}, {"most", 0.6}}), "is reversed: least is 1 mm, most 0.6 mm");
  EXPECT_EQ(message({{"least", 2}}), "is reversed: least is 2 mm, most 1.6 mm (the default)");
}

TEST(FillFactorPlan, ResultHasTheContractsForm) {
  Progress silent;
  json spec = example("wires");
  spec["algorithms"] = {"potential", "needle"};
  spec["overlap_tolerance"] = nullptr;
  const PlannedJob job = planned(spec, silent);
  EXPECT_TRUE(job.verified);
  EXPECT_EQ(job.setpoints, nullptr);
  const auto& r = job.result;
  ASSERT_EQ(r["details"]["layouts"].size(), 6u);
  for (const auto& layout : r["details"]["layouts"]) {
    for (const char* member : {"algorithm", "wire", "count", "bound", "electrical_fill", "mechanical_fill", "positions",
                               "max_overlap", "total_overlap_area", "producible", "turns", "resistance_per_metre"})
      EXPECT_TRUE(layout.contains(member)) << member;
    EXPECT_EQ(layout["positions"].size(), layout["count"]);
    EXPECT_EQ(layout["slips"].is_null() && layout["blocked_by"].empty(), layout["producible"].get<bool>());
    EXPECT_EQ(layout["turns"]["serial"], 10);
    EXPECT_LE(layout["turns"]["electrical_fill"].get<double>(), layout["electrical_fill"].get<double>() + 1e-12);
  }
  EXPECT_EQ(r["details"]["best"].size(), 2u);
  EXPECT_GE(r["bound"]["gap"].get<double>(), 0);
  EXPECT_TRUE(r["details"]["drawings"].contains("potential.svg"));
  EXPECT_TRUE(r["details"]["drawings"].contains("fill_factors.svg"));
  spec["drawings"] = false;
  EXPECT_FALSE(planned(spec, silent).result["details"].contains("drawings"));
}

TEST(FillFactorPlan, NeedleTellsOfAllFourRegions) {
  Progress silent;
  json spec = example("rotor");
  spec["algorithms"] = {"needle"};
  const auto layout = planned(spec, silent).result["details"]["layouts"][0];
  const std::size_t count = layout["count"];
  EXPECT_EQ(layout["pulls"].size(), count);
  for (const char* region : {"head_bottom", "slot_back", "head_top"})
    EXPECT_EQ(layout["regions"][region]["positions"].size(), count);
}

TEST(FillFactorPlan, ARotorsNeedlePassesBetweenThePoles) {
  Progress silent;
  json spec = example("rotor");
  spec["algorithms"] = {"needle"};
  const auto gap = [&](json heads) {
    spec["heads"] = std::move(heads);
    return planned(spec, silent).result["details"]["slot"]["clear_opening"].get<double>();
  };
  const double five = gap({{"poles", 5}}), six = gap({{"poles", 6}});
  EXPECT_LT(six, five);
  // A pole drawn in by d lets each side of the gap stand d·sin(half a pitch) closer to the plane between the poles.
  const double radius = 40.1, closer = 2 * 0.5 * std::sin(std::numbers::pi / 5);
  EXPECT_NEAR(gap({{"poles", 5}, {"tooth_radius", radius - 0.5}}), five - closer, 1e-9);
  spec["heads"] = {{"poles", 5}};
  spec["needle_width"] = five + 0.01;
  const PlannedJob job = planned(spec, silent);
  EXPECT_FALSE(job.result["summary"]["producible"].get<bool>());
  EXPECT_EQ(job.result["details"]["layouts"][0]["blocked_by"][0]["part"], "needle");
}

TEST(FillFactorInput, PolesWhoseCoilsReachIntoEachOtherAreRefused) {
  json spec = example("rotor");
  spec["heads"] = {{"poles", 1000}};
  try {
    request(spec);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.faults.at(0).place, (std::vector<std::string>{"heads", "poles"}));
  }
}

TEST(FillFactorInput, TurnsBeyondTheBoundAreRefused) {
  json spec = example("wires");
  spec["turns"] = {{"serial", 1000}, {"parallel", 3}};
  try {
    request(spec);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.faults.at(0).place, std::vector<std::string>{"turns"});
  }
}

TEST(FillFactorInput, WiresThatFillASlotExactlyAreTaken) {
  for (const auto& [width, height] : {std::pair{7, 1}, {1, 1}, {2, 2}, {1, 12}}) {
    const json spec = {{"slot", {{"type", "polygon"}, {"points", {{0, 0}, {width, 0}, {width, height}, {0, height}}}}},
                       {"wires", {{{"copper", 0.9}, {"outer", 1.0}}}},
                       {"overlap_tolerance", 0},
                       {"drawings", false}};
    Progress silent;
    const PlannedJob job = planned(spec, silent);
    EXPECT_TRUE(job.verified);
    EXPECT_EQ(job.result["summary"]["count"], width * height);
    EXPECT_EQ(job.result["bound"]["count"], width * height);
  }
}

TEST(FillFactorInput, NeedleInAPolygonNeedsItsOpening) {
  json spec = example("minimal");
  spec["needle_width"] = 2;
  EXPECT_THROW(request(spec), InvalidInput);
  spec["slot"]["opening"] = {{2, 12}, {4.5, 12}};
  EXPECT_NEAR(request(spec).slot.opening->clear, 2.5, 1e-12);
  EXPECT_EQ(request(spec).slot.opening->into, (Point{0, -1}));
  spec["slot"]["opening"] = {{2, 12}, {4.5, 11}};
  EXPECT_THROW(request(spec), InvalidInput) << "inside the slot";
}

TEST(FillFactorInput, CoilSidesShareTheSlot) {
  json spec = example("complete");
  spec["coil_sides"] = 2;
  spec["needle_width"] = 1.5;
  const FillRequest layers = request(spec);
  EXPECT_NEAR(layers.slot.usable_area.area(), 73.18 / 2, 0.01);
  EXPECT_EQ(layers.needle->stand, winding::Needle::Stand::middle) << "the other side lies below";
  spec["heads"]["span"] = 1;
  EXPECT_EQ(request(spec).needle->stand, winding::Needle::Stand::left) << "the other side lies beside";
}

/// A stator of two poles has coils of half a turn; 24 slots are 15 deg apart.
TEST(FillFactorInput, ACoilSpansHalfATurnAtMost) {
  json spec = example("complete");
  spec["heads"]["slot_pitch"] = 15;
  spec["heads"]["span"] = 12;
  EXPECT_NO_THROW(request(spec));
  spec["heads"]["span"] = 13;
  EXPECT_THROW(request(spec), InvalidInput);
}

TEST(FillFactorPlan, SaysWhatBlocksTheNeedle) {
  Progress silent;
  json spec = example("complete");
  for (const char* member : {"robustness", "turns", "wire_range"}) spec.erase(member);
  spec["wires"] = {0.9};
  spec["algorithms"] = {"needle"};
  spec["needle_width"] = 3.5;
  const auto result = planned(spec, silent).result;
  const auto& layout = result["details"]["layouts"][0];
  EXPECT_FALSE(layout["producible"].get<bool>());
  EXPECT_TRUE(layout["slips"].is_null());
  ASSERT_EQ(layout["blocked_by"].size(), 1u);
  EXPECT_EQ(layout["blocked_by"][0]["part"], "needle");
  EXPECT_TRUE(result["summary"]["best_producible"].is_null());
  // Seven wires of 0.989 mm in hand need a needle of three diameters.
  spec["needle_width"] = 2.9;
  spec["turns"] = {{"parallel", 7}};
  spec["algorithms"] = {"orthocyclic_base"};
  const json bundle = planned(spec, silent).result["details"]["layouts"][0]["blocked_by"];
  ASSERT_EQ(bundle.size(), 1u);
  EXPECT_EQ(bundle[0]["passage"], "needle");
  EXPECT_NEAR(bundle[0]["needed"].get<double>(), 3 * 0.989, 1e-9);
  std::set<std::string> names;
  for (const auto& check : result["verification"]["checks"]) names.insert(check["name"]);
  for (const char* region : {"head_bottom", "slot_back", "head_top"})
    EXPECT_TRUE(names.count(std::string("overlap with the boundary needle, ") + region)) << region;
  EXPECT_TRUE(names.count("bound"));
}

/// A wide slot, in which the 14th wire pushes one out.
json wide_slot(const json& turns) {
  json slot = example("complete")["slot"];
  slot["base_width"] = 15, slot["tip_angle"] = 98, slot["base_radius"] = 126, slot["wedge_width"] = 3;
  return {
      {"slot", slot},   {"wires", {1.25}},  {"algorithms", {"needle"}}, {"heads", {{"slot_pitch", 15}, {"span", 5}}},
      {"turns", turns}, {"drawings", false}};
}

TEST(FillFactorPlan, ProducibleIsAskedOfTheTurnsThatAreWanted) {
  Progress silent;
  const auto of = [&](const json& turns) { return json(planned(wide_slot(turns), silent).result); };
  const json all = of({{"serial", nullptr}, {"parallel", 1}});
  const json layout = all["details"]["layouts"][0];
  EXPECT_FALSE(layout["producible"].get<bool>());
  const int most = layout["windable"]["wires"], laid = layout["slips"]["laid"];
  EXPECT_EQ(most, laid - 1);
  EXPECT_EQ(layout["windable"]["ends_by"], "pushed_out");
  EXPECT_TRUE(all["summary"]["best_producible"].is_null());
  for (const int turns : {1, most - 1, most, most + 1}) {
    const json some = of({{"serial", turns}, {"parallel", 1}});
    EXPECT_EQ(some["details"]["layouts"][0]["producible"], turns <= most) << turns;
    EXPECT_EQ(some["details"]["layouts"][0]["slips"].is_null(), turns <= most) << turns;
    EXPECT_EQ(some["summary"]["best_producible"].is_null(), turns > most) << turns;
    EXPECT_EQ(some["summary"]["windable"]["turns"], most);
  }
  const json pairs = of({{"serial", 4}, {"parallel", 2}});
  EXPECT_EQ(pairs["summary"]["windable"]["turns"], most / 2);
  EXPECT_TRUE(pairs["summary"]["producible"].get<bool>());
}

TEST(FillFactorPlan, AWireDoesNotRunInANeedleThinnerThanItself) {
  Progress silent;
  json spec = example("complete");
  for (const char* member : {"robustness", "turns", "wire_range"}) spec.erase(member);
  spec["wires"] = {0.71, 1.25};
  spec["algorithms"] = {"needle"};
  spec["needle_width"] = 1;
  const auto result = planned(spec, silent).result;
  EXPECT_TRUE(result["details"]["layouts"][0]["blocked_by"].empty() ||
              result["details"]["layouts"][0]["blocked_by"][0]["part"] == "channel");
  const auto& thick = result["details"]["layouts"][1];
  EXPECT_FALSE(thick["producible"].get<bool>());
  ASSERT_EQ(thick["blocked_by"].size(), 1u);
  EXPECT_EQ(thick["blocked_by"][0]["part"], "needle");
  EXPECT_EQ(thick["blocked_by"][0]["passage"], "needle");
  EXPECT_EQ(thick["blocked_by"][0]["clear"], 1);
  EXPECT_EQ(thick["windable"]["wires"], 0);
}

TEST(FillFactorPlan, ASlotWhoseMouthIsTheBoresArcIsFilled) {
  // 10 mm wide, 14 mm deep, fully open to a bore of 40 mm, whose arc dips 0.31 mm into it.
  Progress silent;
  json points = json::array();
  const double up = 14 + std::sqrt(40.0 * 40 - 25);
  for (int k = 0; k <= 10; ++k) points.push_back({5 - k, up - std::sqrt(40.0 * 40 - (5 - k) * (5 - k))});
  points.push_back({-5, 0});
  points.push_back({5, 0});
  const json spec{
      {"slot", {{"type", "polygon"}, {"points", points}, {"liner", 0.25}, {"opening", {{-5, 14}, {5, 14}}}}},
      {"wires", {1.0}},
      {"algorithms", {"needle"}},
      {"turns", {{"serial", 40}, {"parallel", 1}}},
      {"needle_width", 2}};
  const PlannedJob job = planned(spec, silent);
  EXPECT_TRUE(job.verified);
  EXPECT_GE(job.result["summary"]["count"], 80);
  EXPECT_NEAR(job.result["details"]["slot"]["clear_opening"].get<double>(), 10, 1e-9);
  EXPECT_TRUE(job.result["summary"]["producible"].get<bool>());
}

TEST(FillFactorPlan, RobustnessIsADistribution) {
  Progress silent;
  json spec = example("rotor");
  spec["algorithms"] = {"needle"};
  spec["robustness"] = {{"samples", 12}, {"slot_tolerance", 0.05}};
  const auto spread = planned(spec, silent).result["details"]["layouts"][0]["robustness"];
  std::size_t sum = 0;
  for (const auto& bar : spread["histogram"]) sum += bar["samples"].get<std::size_t>();
  EXPECT_EQ(sum, 12u);
  EXPECT_LE(spread["least"], spread["mean"]);
  EXPECT_LE(spread["mean"], spread["most"]);
}

}  // namespace
}  // namespace bahnwerk::api::fill_factor
