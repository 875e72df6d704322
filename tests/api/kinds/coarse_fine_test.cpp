#include "api/kinds/contour/coarse_fine.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "api/kinds/contour/contour.hpp"
#include "api/problem.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;

json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/contour/" + name + ".json"));
}

const test::SpecPlanner planned("contour");

/// [Bock Table 2.1].
TEST(CoarseFine, ExampleMachinesAreThoseOfTheSource) {
  for (const auto& [name, v, a, fine_v, stroke] :
       {std::tuple{"md1", 1600.0, 8000.0, 2500.0, 45.0}, std::tuple{"md2", 1800.0, 16000.0, 2000.0, 20.0}}) {
    const json spec{{"machine", test::read_json(test::source(std::string("examples/machines/") + name + ".json"))}};
    ASSERT_TRUE(coarse_fine(spec));
    const CoarseFineMachine machine = coarse_fine_machine(spec);
    ASSERT_EQ(machine.axes.size(), 2u);
    EXPECT_EQ(machine.axes[1].name, "y");
    for (const CoarseFineAxis& axis : machine.axes) {
      EXPECT_EQ(axis.coarse.velocity, v);
      EXPECT_EQ(axis.coarse.acceleration, a);
      EXPECT_EQ(axis.fine.velocity, fine_v);
      EXPECT_EQ(axis.fine.acceleration, 60000);
      EXPECT_EQ(axis.stroke, stroke);
    }
    EXPECT_EQ(machine.limited_order(), 2);
  }
}

TEST(CoarseFine, ReadsWhatAMethodMaySet) {
  json spec = example("coarse_fine");
  spec["machine"]["redundancy"] = {{"method", "iterative"},         {"approximation", "chebyshev"},
                                   {"smoothing", "linear_program"}, {"degree", 4},
                                   {"knot_multiplicity", 2},        {"afterburner", 7},
                                   {"window", {{"blocks", 8}}},     {"thinning", 3}};
  ContourPlanning planning;
  planning.braking_reserve = 0.6;
  const RedundancyOptions options = redundancy(spec, planning);
  EXPECT_EQ(options.method, RedundancyMethod::iterative);
  EXPECT_EQ(options.approximation, CoarseApproximation::chebyshev);
  EXPECT_EQ(options.smoothing, CoarseSmoothing::linear_program);
  EXPECT_EQ(options.degree, 4);
  EXPECT_EQ(options.knot_multiplicity, 2);
  EXPECT_EQ(options.afterburner, 7);
  ASSERT_TRUE(options.window);
  EXPECT_EQ(options.window->blocks, 8u);
  EXPECT_EQ(options.window->overlap, 3u);
  EXPECT_EQ(options.thinning, 3);
  EXPECT_TRUE(options.keep_reserve);
  EXPECT_EQ(options.braking_reserve, 0.6);
}

TEST(CoarseFine, TheResultTellsOfBothAxes) {
  json spec = example("coarse_fine");
  spec["machine"]["redundancy"]["smoothness"] = 0.5;
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  const auto& summary = job.result["summary"];
  EXPECT_GT(summary["coarse_smoothness"]["x"], 0);
  EXPECT_LE(summary["peak_coarse_acceleration"]["y"], 16000 * (1 + 1e-9));
  const auto& redundancy = job.result["details"]["redundancy"];
  ASSERT_EQ(redundancy["trades"].size(), 5u);
  for (std::size_t i = 1; i < 5; ++i)  // more time never needs more
    EXPECT_LE(redundancy["trades"][i]["coarse_smoothness"]["x"].get<double>(),
              redundancy["trades"][i - 1]["coarse_smoothness"]["x"].get<double>() * (1 + 1e-3));
  EXPECT_NEAR(summary["duration"].get<double>(), redundancy["trades"][2]["duration"].get<double>(), 1e-5);
  EXPECT_NEAR(summary["coarse_smoothness"]["x"].get<double>(),
              redundancy["trades"][2]["coarse_smoothness"]["x"].get<double>(),
              1e-4 * summary["coarse_smoothness"]["x"].get<double>());
  EXPECT_EQ(redundancy["passes"].back()["violated_blocks"], 0);
  EXPECT_LE(redundancy["passes"].back()["peaks"][0]["offset"], 20);
  EXPECT_EQ(job.result["setpoints"]["columns"].size(), 22u);
}

TEST(CoarseFine, AStretchTakesThePlaceOfSmoothness) {
  json spec = example("coarse_fine");
  spec["machine"]["redundancy"] = {{"method", "joint"}, {"smoothness", 1}, {"trades", false}};
  const PlannedJob smooth = planned(spec);
  spec["machine"]["redundancy"] = {{"method", "joint"}, {"stretch", 1.12}, {"trades", false}};
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  const double fastest = job.result["details"]["redundancy"]["fastest"];
  EXPECT_NEAR(job.result["summary"]["duration"].get<double>(), 1.12 * fastest, 1.1e-3);  // to a whole cycle
  for (const char* axis : {"x", "y"})
    EXPECT_LT(job.result["summary"]["coarse_smoothness"][axis].get<double>(),
              smooth.result["summary"]["coarse_smoothness"][axis].get<double>() / 1.15);
}

TEST(CoarseFine, TheTableOfTradesCanBeLeftOut) {
  json spec = example("coarse_fine");
  const PlannedJob with = planned(spec);
  spec["machine"]["redundancy"]["trades"] = false;
  const PlannedJob without = planned(spec);
  EXPECT_TRUE(without.result["details"]["redundancy"]["trades"].empty());
  EXPECT_EQ(without.result["summary"]["duration"], with.result["summary"]["duration"]);
}

TEST(CoarseFine, WithTheFineAxesItIsQuickerThanWithTheCoarseAlone) {
  json spec = example("coarse_fine");
  const double both = planned(spec).result["summary"]["duration"];
  json axes = json::object();
  for (const char* name : {"x", "y"}) axes[name] = spec["machine"]["coarse"][name];
  spec["machine"] = {{"axes", axes}};
  EXPECT_LT(both, planned(spec).result["summary"]["duration"]);
}

TEST(CoarseFine, JerkInSpaceIsPlannedAndHeld) {
  const PlannedJob job = planned(example("coarse_fine_jerk"));
  EXPECT_TRUE(job.verified);
  std::vector<std::string> names;
  for (const auto& check : job.result["verification"]["checks"]) names.push_back(check["name"]);
  for (const char* name : {"jerk xc", "jerk zf", "coarse continuity of acceleration", "setpoints sum"})
    EXPECT_THAT(names, testing::Contains(name));
  EXPECT_EQ(job.result["details"]["method"], "jerk_limited");
  EXPECT_TRUE(job.result["details"]["redundancy"]["coarse_jerk_limited"].get<bool>());
}

/// z has no fine axis and follows a corner rounded to 0.013 mm: its acceleration at the joints is known as far as the
/// curvature of so short a curve is rounded.
TEST(CoarseFine, AnAxisWithoutAFineOneFollowsAShortRoundingInSpace) {
  json spec = example("coarse_fine");
  const json coarse{{"velocity", 1662.3433344104506}, {"acceleration", 8315.82408134405}, {"jerk", 3515278.6751196915}};
  const json fine{{"velocity", 2526.061868986645},
                  {"acceleration", 88874.27774117474},
                  {"stroke", 0},
                  {"jerk", 15672201.703306662}};
  spec["machine"] = {{"kinematics", "coarse_fine"},
                     {"coarse", {{"x", coarse}, {"y", coarse}, {"z", coarse}}},
                     {"fine", {{"x", fine}, {"y", fine}}},
                     {"cycle_time", 0.001},
                     {"redundancy", {{"method", "joint"}, {"trades", false}, {"smoothness", 0.25}}}};
  spec["planning"] = {{"corner", {{"mode", "blend"}, {"tolerance", 0.013441183798641955}}}};
  spec["contour"] = {{"start", {25.075913, -27.376959, -9.987736}},
                     {"blocks",
                      {{{"mode", "cut"},
                        {"segments",
                         {{{"arc",
                            {{"to", {24.510065057022427, -26.75454839949378, -10.153521874460251}},
                             {"center", {25.28533418267523, -26.61815127701807, -9.987736}},
                             {"direction", "cw"}}}},
                          {{"line", {23.31247921671319, -19.947576885295803, -9.035412082191453}}}}}}}}};
  EXPECT_TRUE(planned(spec).verified);
}

TEST(CoarseFine, WhatTheMethodDoesNotLookAtIsNoted) {
  json spec = example("coarse_fine");
  spec["machine"]["redundancy"]["degree"] = 4;
  spec["planning"]["method"] = "braking_reserve";
  const PlannedJob job = planned(spec);
  EXPECT_THAT(job.result["details"]["notes"].dump(),
              testing::AllOf(testing::HasSubstr("redundancy.degree"), testing::HasSubstr("braking reserve")));
}

/// 0.02 mm of stroke ask for cells of 66 µs: too many in four minutes, with or without corners.
TEST(CoarseFine, AStrokeTooShortForALongContourStandsStillWithANote) {
  const json spec{
      {"contour",
       {{"start", {0, 0}},
        {"blocks",
         {{{"mode", "cut"}, {"feed", 11}, {"segments", {{{"line", {1400, 0}}}, {{"line", {1400, 1400}}}}}}}}}},
      {"machine", test::read_json(test::source("examples/machines/md1.json"))}};
  json small = spec;
  for (json& axis : small["machine"]["fine"]) axis["stroke"] = 0.02;
  const PlannedJob job = planned(small);
  EXPECT_THAT(job.result["details"]["notes"].dump(), testing::HasSubstr("fine axis x stands still"));
  EXPECT_NEAR(job.result["summary"]["duration"].get<double>(), 2800.0 / 11, 0.01);
  const CoarseFineMachine machine = coarse_fine_machine(spec);
  EXPECT_EQ(least_stroke(machine, 1), 0.02);
  EXPECT_GT(least_stroke(machine, 254), 0.02);
  EXPECT_NEAR(least_stroke(machine, 2540), 100 * least_stroke(machine, 254), 1e-9);
}

TEST(CoarseFine, AStudyOfTheMachineIsATableAndAChart) {
  json spec = example("coarse_fine");
  spec["planning"] = {{"machine_study", true}};
  const PlannedJob job = planned(spec);
  const auto& study = job.result["details"]["redundancy"]["machine_study"];
  EXPECT_EQ(study["stroke"].size(), 10u);
  EXPECT_EQ(study["fine_acceleration"][3]["value"], 60000);
  for (const char* table : {"fine_velocity", "coarse_acceleration", "coarse_velocity"})
    EXPECT_EQ(study[table].size(), 5u) << table;
  EXPECT_TRUE(job.result["details"]["drawings"].contains("machine_study.svg"));
}

TEST(CoarseFine, ALongMoveTellsWhereItLosesTime) {
  json spec = example("coarse_fine");
  spec["contour"] = {{"points", {{0, 0}, {400, 0}, {400, 5}}}};
  spec["planning"] = json::object();
  const PlannedJob job = planned(spec);
  const auto& redundancy = job.result["details"]["redundancy"];
  ASSERT_GE(redundancy["slow_sections"].size(), 1u);
  EXPECT_EQ(redundancy["slow_sections"][0]["segment"], 0);
  EXPECT_EQ(redundancy["slow_sections"][0]["length"], 400);
  EXPECT_GE(redundancy["slowed_count"], 1);
  EXPECT_GT(job.result["bound"]["gap"], 0);
}

TEST(CoarseFine, AStudyTakesItsOwnValues) {
  json spec = example("coarse_fine");
  spec["planning"] = {{"machine_study", {{"stroke", {3, 0.5}}, {"coarse_velocity", nullptr}}}};
  const PlannedJob job = planned(spec);
  const auto& study = job.result["details"]["redundancy"]["machine_study"];
  EXPECT_EQ(study.size(), 2u);
  ASSERT_EQ(study["stroke"].size(), 2u);
  EXPECT_EQ(study["stroke"][0]["value"], 0.5);
  EXPECT_EQ(study["coarse_velocity"].size(), 5u);
  for (const auto& row : study["stroke"]) EXPECT_TRUE(row["duration"].is_number()) << row;
}

TEST(CoarseFine, TheSummaryTellsTheMeanOfAccelerations) {
  const json spec = example("coarse_fine");
  const PlannedJob job = planned(spec);
  const auto& rms = job.result["summary"]["rms_acceleration"];
  const double T = job.result["summary"]["duration"], cycle = spec["machine"].value("cycle_time", 0.001);
  const double slowed = std::ceil(T / cycle) * cycle / T;  // to whole cycles, which the energy does not count
  for (const char* axis : {"x", "y"}) {
    const double energy = job.result["summary"]["coarse_smoothness"][axis];
    const double mean = std::sqrt(energy / T) / (slowed * slowed);
    EXPECT_NEAR(rms["coarse"][axis].get<double>(), mean, 1e-6 * mean);
    EXPECT_GT(rms["fine"][axis].get<double>(), 0);
  }
}

/// A filter that is too slow leaves nearly all of the motion to fine axes that are slow, too.
TEST(CoarseFine, TheSummaryTellsWhatGaveWay) {
  json spec = example("coarse_fine");
  EXPECT_FALSE(planned(spec).result["summary"].contains("gave_way"));
  spec["contour"] = {{"points", {{0, 0}, {600, 200}, {0, 300}}}};
  spec["planning"] = json::object();
  json slow = spec;
  for (json& axis : slow["machine"]["fine"]) axis["velocity"] = 5;
  slow["machine"]["redundancy"] = {{"method", "filter"}, {"taps", 301}, {"cutoff", 0.1}};
  const PlannedJob job = planned(slow);
  EXPECT_TRUE(job.verified);
  EXPECT_EQ(job.result["details"]["redundancy"]["fallbacks"], 1);
  ASSERT_EQ(job.result["summary"]["gave_way"].size(), 1u);
  const json& lost = job.result["summary"]["gave_way"].at(0);
  EXPECT_EQ(lost["planner"], "filter");
  EXPECT_EQ(lost["reason"], "no_motion");
  EXPECT_TRUE(lost["duration"].is_null());
  EXPECT_EQ(lost["used"], "joint");
  EXPECT_EQ(lost["used_duration"], job.result["summary"]["duration"].get<double>());
}

/// The geometric split of two long moves takes 0.6 % longer than the coarse axes alone.
TEST(CoarseFine, AMethodThatIsSlowerThanTheCoarseAxesAlonePlansAndANoteTellsIt) {
  json spec = example("coarse_fine");
  spec["contour"] = {{"points", {{0, 0}, {600, 200}, {0, 300}}}};
  spec["planning"] = json::object();
  spec["machine"]["redundancy"] = {{"method", "geometric"}};
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  EXPECT_FALSE(job.result["summary"].contains("gave_way"));
  const std::string notes = job.result["details"]["notes"].dump();
  EXPECT_NE(notes.find("the coarse axes alone, with fine axes that stand still, take"), std::string::npos) << notes;
}

TEST(CoarseFine, FineAxesAreCentredWhereTheDocumentAsksForIt) {
  json spec = example("coarse_fine");
  for (const char* axis : {"x", "y"}) spec["machine"]["fine"][axis]["at_rest"] = "centred";
  spec["machine"]["redundancy"] = {{"method", "iterative"}};
  const PlannedJob job = planned(spec);
  std::size_t centred = 0;
  for (const auto& check : job.result["verification"]["checks"])
    centred += check["name"].get<std::string>().starts_with("centred at ");
  EXPECT_EQ(centred, 4u);
  EXPECT_TRUE(job.verified);
  EXPECT_EQ(job.result["details"]["redundancy"]["fallbacks"], 0);
}

TEST(CoarseFine, TheTravelOfCoarseAxesIsHeld) {
  json spec = example("coarse_fine");
  spec["contour"] = {{"points", {{0, 0}, {60, 0}, {60, 30}}}};
  spec["planning"] = json::object();
  spec["machine"]["coarse"]["x"]["range"] = {0, 60};
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  bool checked = false;
  for (const auto& check : job.result["verification"]["checks"]) checked = checked || check["name"] == "range xc";
  EXPECT_TRUE(checked);
  spec["machine"]["coarse"]["x"]["range"] = {60, 0};
  const auto refused = [&] {
    try {
      Progress silent;
      find_kind("contour")->check(spec, silent);
    } catch (const Problem& problem) {
      return test::pointers(problem);
    }
    return std::vector<std::string>();
  };
  EXPECT_EQ(refused(), std::vector<std::string>{"/spec/machine/coarse/x/range"});
  spec["machine"]["coarse"]["x"]["range"] = {0, 20};
  EXPECT_EQ(refused(), std::vector<std::string>{"/spec/machine/coarse/x/range"});
}

/// The tool ends where range and stroke do: nothing is left for rounding, and the refusal names the range.
TEST(CoarseFine, ARangeThatIsTooShortIsNamed) {
  json spec = example("coarse_fine");
  spec["contour"] = {{"points", {{0, 0}, {60, 0}, {60, 30}}}};
  spec["planning"] = json::object();
  spec["machine"]["coarse"]["x"]["range"] = {0, 40};
  for (const char* method : {"joint", "geometric"}) {
    spec["machine"]["redundancy"] = {{"method", method}};
    Progress progress;
    try {
      find_kind("contour")->plan(spec, progress);
      ADD_FAILURE() << method;
    } catch (...) {
      const Problem problem = problem_from_current_exception();
      EXPECT_EQ(problem.type().slug, "infeasible");
      EXPECT_EQ(test::pointers(problem), std::vector<std::string>{"/spec/machine/coarse/x/range"});
    }
  }
}

TEST(CoarseFine, ThePrefilterOfTheDrivesIsTold) {
  json spec = example("coarse_fine");
  spec["machine"]["redundancy"] = {
      {"method", "lag_compensation"}, {"coarse_time_constant", 0.01}, {"fine_time_constant", 0.001}};
  const PlannedJob job = planned(spec);
  const auto& v = job.result["details"]["redundancy"]["prefilter"];
  EXPECT_EQ(v["numerator"][0], 1.0);
  EXPECT_NEAR(v["numerator"][1].get<double>(), 0.009, 1e-15);
  EXPECT_EQ(json(v["denominator"]), json({1.0, 0.01}));
  EXPECT_NEAR(v["b"][0].get<double>() + v["b"][1].get<double>(), 1 + v["a"][1].get<double>(), 1e-12);
}

}  // namespace
}  // namespace bahnwerk::api::contour
