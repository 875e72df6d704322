#include "api/kinds/contour/contour.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "api/kind.hpp"
#include "api/setpoints/setpoints.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;

const test::SpecPlanner planned("contour");

json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/contour/" + name + ".json"));
}
json example_spec(const std::string& name) {
  return job_spec(parse_job(test::read_file(test::source("examples/" + name + ".json"))).document);
}

TEST(ContourPlan, StraightLineHasTheClosedFormDuration) {
  Progress progress;
  const auto job = planned(example_spec("line"), progress);
  const double v = 1800, a = 16000, length = 100;
  const double expected = v * v / a < length ? length / v + v / a : 2 * std::sqrt(length / a);
  EXPECT_NEAR(job.result["summary"]["duration"].get<double>(), expected, 1e-9);
  EXPECT_TRUE(job.verified);
}

TEST(ContourPlan, TheResultHasTheContractsForm) {
  Progress progress;
  const auto job = planned(example_spec("bracket"), progress);
  const auto& result = job.result;
  std::vector<std::string> members;
  for (const auto& [name, value] : result.items()) members.push_back(name);
  EXPECT_EQ(members, (std::vector<std::string>{"kind", "summary", "verification", "bound", "setpoints", "details"}));
  EXPECT_EQ(result["kind"], "contour");
  for (const char* name : {"duration", "cut_time", "position_time", "path_length"})
    EXPECT_GT(result["summary"][name].get<double>(), 0) << name;
  EXPECT_GT(result["summary"]["iterations"].get<int>(), 0);
  EXPECT_NEAR(result["summary"]["cut_time"].get<double>() + result["summary"]["position_time"].get<double>(),
              result["summary"]["duration"].get<double>(), 1e-9);
  EXPECT_TRUE(result["verification"]["passed"].get<bool>()) << result["verification"].dump(1);
  EXPECT_EQ(result["verification"]["passed"].get<bool>(), job.verified);
  ASSERT_FALSE(result["verification"]["checks"].empty());
  for (const auto& check : result["verification"]["checks"])
    for (const char* name : {"name", "unit", "limit", "value", "at", "passed"})
      EXPECT_FALSE(check.at(name).is_null()) << check.dump();
  EXPECT_GE(result["bound"]["gap"].get<double>(), 0);
  EXPECT_LE(result["bound"]["gap"].get<double>(), 1e-4);
  const auto& setpoints = result["setpoints"];
  EXPECT_EQ(setpoints["count"], job.setpoints->count());
  EXPECT_NEAR(setpoints["duration"].get<double>(), (setpoints["count"].get<double>() - 1) * 0.001, 1e-9);
  EXPECT_EQ(setpoints["columns"][0], (nlohmann::ordered_json{{"name", "x"}, {"unit", "mm"}}));
  EXPECT_EQ(setpoints["columns"].size(), job.setpoints->columns().size());
  EXPECT_EQ(setpoints["columns"][4]["unit"], "mm/s²");
  EXPECT_EQ(setpoints["columns"][8], (nlohmann::ordered_json{{"name", "mode"}, {"unit", "1"}}));
  EXPECT_EQ(setpoints["columns"][9], (nlohmann::ordered_json{{"name", "block"}, {"unit", "1"}}));
  std::set<std::string> checks;
  for (const auto& check : result["verification"]["checks"]) checks.insert(check["name"].get<std::string>());
  for (const char* name : {"setpoints position", "setpoints velocity", "setpoints acceleration", "setpoints end",
                           "setpoints mode and block", "bound"})
    EXPECT_TRUE(checks.contains(name)) << name;
  EXPECT_EQ(result["details"]["blocks"].size(), 15u);
  EXPECT_THAT(result["details"]["drawings"]["contour.svg"].get<std::string>(), ::testing::StartsWith("<svg "));
  EXPECT_EQ(result["details"]["method"], "time_optimal");
}

TEST(ContourPlan, BlocksAreInTheTimeOfTheSetpoints) {
  Progress progress;
  json spec = example_spec("bracket");
  spec["machine"]["cycle_time"] = 0.02;  // slows the motion by up to 0.6 %
  const auto job = planned(spec, progress);
  const auto& blocks = job.result["details"]["blocks"];
  const double duration = job.result["setpoints"]["duration"];
  EXPECT_GT(duration, job.result["summary"]["duration"].get<double>() + 1e-5);
  EXPECT_NEAR(blocks.back()["end_time"].get<double>(), duration, 1e-14 * duration);
  const std::size_t count = job.setpoints->count();
  std::vector<double> rows(count * 10);
  job.setpoints->read(0, count, rows.data());
  for (std::size_t k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) * 0.02;
    const auto& block = blocks.at(static_cast<std::size_t>(rows[k * 10 + 9]));
    EXPECT_GE(t, block["start_time"].get<double>()) << k;
    EXPECT_LE(t, block["end_time"].get<double>() * (1 + 1e-14)) << k;
    EXPECT_EQ(rows[k * 10 + 8], block["mode"] == "cut" ? 1 : 0) << k;
  }
}

TEST(ContourPlan, ModeAndBlockOnTheWire) {
  Progress progress;
  const auto job = planned(example_spec("bracket"), progress);
  const auto answer = [&](SetpointQuery query, SetpointFormat format) {
    SetpointSeries series;
    series.columns = job.setpoints->columns();
    series.count = job.setpoints->count();
    series.cycle_time = 0.001;
    series.read = [&](std::size_t first, std::size_t rows, std::vector<double>& out) {
      out.resize(rows * job.setpoints->columns().size());
      job.setpoints->read(first, rows, out.data());
    };
    SetpointStream stream(std::move(series), std::move(query), format);
    std::string text;
    while (stream.next(text)) continue;
    return text;
  };
  SetpointQuery query;
  query.columns = {"mode", "block"};
  query.first = job.setpoints->count() - 2;
  EXPECT_EQ(answer(query, SetpointFormat::csv), "mode,block\n0,14\n0,14\n");
  EXPECT_EQ(answer(query, SetpointFormat::ndjson), "{\"mode\":0,\"block\":14}\n{\"mode\":0,\"block\":14}\n");
  EXPECT_EQ(answer(query, SetpointFormat::f64).size(), 32u);
  // An envelope tells which blocks a stretch of time touches, and whether all, some or none of it cuts.
  query.first = 0;
  query.points = 3;
  const auto envelope = json::parse(answer(query, SetpointFormat::json));
  EXPECT_EQ(envelope["columns"][0], (json{{"name", "mode"}, {"unit", "1"}, {"min", {0, 0, 0}}, {"max", {1, 1, 1}}}));
  EXPECT_EQ(envelope["columns"][1]["min"][0], 0);
  EXPECT_EQ(envelope["columns"][1]["max"][2], 14);
  for (const int bucket : {0, 1})
    EXPECT_LE(envelope["columns"][1]["max"][bucket], envelope["columns"][1]["min"][bucket + 1]);
}

TEST(ContourPlan, BlendsWithinTheToleranceAndHoldsJerk) {
  Progress progress;
  json spec = example("blend");
  const auto job = planned(spec, progress);
  EXPECT_TRUE(job.verified) << job.result["verification"].dump(1);
  std::map<std::string, nlohmann::ordered_json> checks;
  for (const auto& check : job.result["verification"]["checks"]) checks[check["name"].get<std::string>()] = check;
  for (const char* name : {"jerk x", "jerk y", "path velocity", "path acceleration", "path jerk",
                           "continuity of acceleration", "deviation from contour"})
    EXPECT_TRUE(checks.contains(name)) << name;
  EXPECT_LE(checks["deviation from contour"]["value"].get<double>(), 0.05);
  EXPECT_GE(job.result["bound"]["gap"].get<double>(), 0);
  spec["planning"].erase("corner");
  const auto stopping = planned(spec, progress);
  EXPECT_TRUE(stopping.verified);
  EXPECT_GT(stopping.result["summary"]["duration"].get<double>(), job.result["summary"]["duration"].get<double>());
}

TEST(ContourPlan, DwellsCountInTheirBlocksAndAPlaneLeavesZAlone) {
  Progress progress;
  json spec = example("dwell");
  const auto job = planned(spec, progress);
  ASSERT_TRUE(job.verified) << job.result["verification"].dump(1);
  std::vector<std::string> columns;
  for (const auto& column : job.setpoints->columns()) columns.push_back(column.name);
  for (const char* name : {"z", "vz", "az"}) EXPECT_THAT(columns, ::testing::Contains(name));
  const auto& blocks = job.result["details"]["blocks"];
  ASSERT_EQ(blocks.size(), 4u);
  EXPECT_NEAR(blocks[2]["end_time"].get<double>() - blocks[2]["start_time"].get<double>(), 0.4, 1e-3);
  spec["contour"]["blocks"][0]["segments"][0]["dwell"] = 0;
  spec["contour"]["blocks"][2]["segments"][0]["dwell"] = 0;
  const auto stops = planned(spec, progress);
  for (const char* time : {"duration", "cut_time"})
    EXPECT_NEAR(job.result["summary"][time].get<double>() - stops.result["summary"][time].get<double>(), 0.8, 1e-9);
  spec["planning"].erase("mode_change");
  const auto passes = planned(spec, progress);
  EXPECT_LE(passes.result["summary"]["duration"].get<double>(), stops.result["summary"]["duration"].get<double>());
}

TEST(ContourPlan, SaysWhichLimitsAreNotHeld) {
  Progress progress;
  json spec = example("blend");
  spec["planning"] = {{"method", "time_optimal"}};
  const auto job = planned(spec, progress);
  ASSERT_EQ(job.result["details"]["notes"].size(), 1u);
  EXPECT_THAT(job.result["details"]["notes"][0].get<std::string>(), ::testing::HasSubstr("jerk"));
}

TEST(ContourPlan, TheSameDocumentGivesTheSameBits) {
  Progress progress;
  for (const char* name : {"bracket", "polyline"}) {
    const auto first = planned(example_spec(name), progress), second = planned(example_spec(name), progress);
    EXPECT_EQ(first.result.dump(), second.result.dump());
    const std::size_t n = first.setpoints->count() * first.setpoints->columns().size();
    std::vector<double> a(n), b(n);
    first.setpoints->read(0, first.setpoints->count(), a.data());
    second.setpoints->read(0, second.setpoints->count(), b.data());
    EXPECT_TRUE(a == b);
  }
}

TEST(ContourPlan, EveryExampleIsVerifiedByBothMethods) {
  Progress progress;
  for (const auto& file : test::json_files("examples"))
    for (const char* method : {"time_optimal", "braking_reserve"}) {
      json document = test::read_json(file);
      if (document["kind"] != "contour") continue;
      document["spec"]["planning"]["method"] = method;
      const auto request = parse_job(document.dump());
      EXPECT_NO_THROW({
        const auto job = test::checked(plan_job(request.kind, request.document, progress));
        EXPECT_TRUE(job.verified);
        EXPECT_GE(job.result["bound"]["gap"].get<double>(), 0);
      }) << file
         << method;
    }
}

/// Asks to stop at the first report after the start.
struct Impatient final : ProgressSink {
  int reports = 0;
  void report(std::string_view, double, std::string_view) override {
    if (++reports == 2) throw Stopped(StopReason::budget);
  }
};

TEST(ContourPlan, StopsWhenAsked) {
  Impatient progress;
  EXPECT_THROW(find_kind("contour")->plan(example_spec("bracket"), progress), Stopped);
}

/// The tangents of the examples meet where a drawing says that they do: only intended corners stop the head.
TEST(Examples, TangentialJointsAreExact) {
  const auto jumps = [](const char* name) {
    std::vector<double> angles;
    for (const Joint& joint : joints(geometry(example_spec(name)).path))
      if (joint.angle < 0.1) angles.push_back(joint.angle);
    return angles;
  };
  for (const char* name : {"bracket", "circle", "helix"})
    EXPECT_THAT(jumps(name), testing::Each(testing::Le(1e-9))) << name;
  EXPECT_EQ(jumps("circle").size(), 2u);
  EXPECT_EQ(jumps("helix").size(), 4u);
  EXPECT_GE(jumps("bracket").size(), 20u);
}

}  // namespace
}  // namespace bahnwerk::api::contour
