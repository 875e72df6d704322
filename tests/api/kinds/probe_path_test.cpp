#include "api/kinds/probe_path/probe_path.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api::probe_path {
namespace {

using nlohmann::json;

const test::SpecPlanner planned("probe_path");

json spec(json points, double tolerance, const std::string& method) {
  json axes = json::object();
  for (std::size_t k = 0; k < points[0].size(); ++k)
    axes[std::string(1, "xyz"[k])] = {{"acceleration", 250}, {"jerk", 5000}, {"snap", 250000}};
  return {{"points", std::move(points)}, {"tolerance", tolerance}, {"speed", 20}, {"limits", axes}, {"method", method}};
}

json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/probe_path/" + name + ".json"));
}

TEST(ProbePathInput, ReadsADocument) {
  const ProbeRequest r = request(example("complete"));
  EXPECT_EQ(r.method, ProbeMethod::optimal);
  EXPECT_EQ(r.problem.dimension(), 3u);
  EXPECT_EQ(r.problem.given.size(), 6u);
  EXPECT_EQ(r.problem.points.size(), 5u) << "a repeated point counts once";
  EXPECT_EQ(r.problem.axis(2).snap, 120000);
  EXPECT_EQ(r.problem.machine.cycle_time, 0.002);
}

TEST(ProbePathInput, DefaultsAreTheContracts) {
  const ProbeRequest r = request(example("minimal"));
  EXPECT_EQ(r.method, ProbeMethod::optimal);
  EXPECT_EQ(r.problem.objective, ProbeObjective::time);
  EXPECT_EQ(r.problem.point_tolerance, 1e-6);
  EXPECT_EQ(r.problem.stretch, 1.25);
  EXPECT_EQ(r.problem.machine.cycle_time, 0.001);
}

TEST(ProbePathInput, AllFaultsAreNamedAtOnce) {
  json bad = spec({{0, 0, 0}, {1, 0}, {2, 1, 1}, {3}}, 0.1, "arcs");
  bad["limits"].erase("z");
  bad["objective"] = "ripple";
  try {
    request(bad);
    FAIL();
  } catch (const InvalidInput& error) {
    std::vector<std::vector<std::string>> places;
    for (const InputFault& fault : error.faults) places.push_back(fault.place);
    EXPECT_THAT(places, testing::ElementsAre(testing::ElementsAre("points", "1"), testing::ElementsAre("points", "3"),
                                             testing::ElementsAre("limits", "z"), testing::ElementsAre("objective")));
  }
}

TEST(ProbePath, RowsEndAtRestOnTheLastPoint) {
  for (const char* method : {"arcs", "spline"}) {
    const PlannedJob job = planned(spec({{0, 0}, {7, 1}, {9, 8}, {3, 8.5}}, 0.2, method));
    ASSERT_TRUE(job.verified) << job.failure;
    const auto& columns = job.setpoints->columns();
    ASSERT_EQ(columns.size(), 10u);
    EXPECT_EQ(columns[8].name, "deviation");
    EXPECT_EQ(columns[9].name, "v");
    const std::size_t rows = job.setpoints->count();
    std::vector<double> row(10);
    job.setpoints->read(rows - 1, 1, row.data());
    EXPECT_THAT(row, testing::ElementsAre(3, 8.5, 0, 0, 0, 0, 0, 0, 0, 0)) << method;
    const double duration = job.result["summary"]["duration"], served = job.result["setpoints"]["duration"];
    EXPECT_GE(served, duration);
    EXPECT_LT(served, duration + 0.001);
    EXPECT_NEAR(served, static_cast<double>(rows - 1) * 0.001, 1e-12);
  }
}

TEST(ProbePath, SlicesOfRowsAreTheRows) {
  const PlannedJob job = planned(spec({{0, 0, 0}, {7, 1, 2}, {9, 8, 3}}, 0.2, "arcs"));
  const std::size_t rows = job.setpoints->count(), width = job.setpoints->columns().size();
  std::vector<double> all(rows * width), one(width);
  job.setpoints->read(0, rows, all.data());
  for (const std::size_t k : {std::size_t{0}, rows / 3, rows / 2, rows - 1}) {
    job.setpoints->read(k, 1, one.data());
    EXPECT_TRUE(std::equal(one.begin(), one.end(), all.begin() + static_cast<std::ptrdiff_t>(k * width))) << k;
  }
}

TEST(ProbePath, PointsHaveTheTimesOfTheServedMotion) {
  const PlannedJob job = planned(spec({{0, 0}, {6, 0}, {6, 0}, {15, 0}, {30.3, 0}}, 0, "arcs"));
  const auto& points = job.result["details"]["points"];
  ASSERT_EQ(points.size(), 5u);
  EXPECT_EQ(points[0]["time"], 0);
  EXPECT_EQ(points[1]["time"], points[2]["time"]);
  EXPECT_EQ(points[4]["time"], job.result["setpoints"]["duration"]);
  // x = 20 (t − 0.075 …) in the hold, slowed to whole cycles.
  const double duration = job.result["summary"]["duration"], served = job.result["setpoints"]["duration"];
  const double ramp = 20.0 / 250 + 250.0 / 5000 + 5000.0 / 250000;
  EXPECT_NEAR(duration, 30.3 / 20 + ramp, 1e-12);
  EXPECT_NEAR(points[3]["time"], (15.0 / 20 + ramp / 2) * served / duration, 1e-12);
}

TEST(ProbePath, PiecesAreTheMotion) {
  const PlannedJob job = planned(spec({{0, 0}, {6, 0}, {6, 4}}, 0.1, "arcs"));
  const auto& pieces = job.result["details"]["pieces"];
  EXPECT_EQ(pieces.size(), job.result["details"]["pieces_total"].get<std::size_t>());
  std::vector<double> row(10);
  for (const auto& piece : pieces) {
    const double start = piece["start"], end = piece["end"];
    const auto k = static_cast<std::size_t>(std::ceil(start / 0.001));
    if (static_cast<double>(k) * 0.001 >= end) continue;
    job.setpoints->read(k, 1, row.data());
    for (std::size_t axis = 0; axis < 2; ++axis) {
      double x = 0, power = 1;
      for (const double c : piece["coefficients"][axis])
        x += c * power, power *= static_cast<double>(k) * 0.001 - start;
      EXPECT_NEAR(x, row[axis], 1e-12);
    }
  }
}

TEST(ProbePath, DrawingsShowPathAndLimits) {
  const PlannedJob job = planned(spec({{0, 0, 0}, {7, 1, 2}, {9, 8, 3}}, 0.2, "arcs"));
  const std::string path = job.result["details"]["drawings"]["path.svg"],
                    motion = job.result["details"]["drawings"]["motion.svg"];
  for (const char* words : {"plan: y over x", "elevation: z over x", "radius 0.2 mm"})
    EXPECT_NE(path.find(words), path.npos) << words;
  for (const char* words : {"deviation, mm", "speed, mm/s", "acceleration z", "jerk x", "snap y"})
    EXPECT_NE(motion.find(words), motion.npos) << words;
  EXPECT_EQ(path.find("nan"), path.npos);
  EXPECT_EQ(motion.find("nan"), motion.npos);
}

TEST(ProbePath, WhatIsNotUsedIsNoted) {
  json with_z = spec({{0, 0}, {6, 0}}, 0.1, "arcs");
  with_z["limits"]["z"] = with_z["limits"]["x"];
  with_z["stretch"] = 1.5;
  const PlannedJob job = planned(with_z);
  EXPECT_EQ(job.result["details"]["notes"].size(), 2u);
}

TEST(ProbePath, TooManySetpointsAreRefusedAtTheCycleTime) {
  json slow = spec({{0, 0}, {900000, 0}}, 0.1, "arcs");
  slow["speed"] = 1;
  slow["cycle_time"] = 1e-5;
  Progress silent;
  try {
    find_kind("probe_path")->plan(slow, silent);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.faults[0].place, testing::ElementsAre("cycle_time"));
  }
}

TEST(ProbePath, TheSameDocumentGivesTheSameBits) {
  const json document = spec({{0, 0}, {7, 1}, {9, 8}, {3, 8.5}, {3, 2}}, 0.3, "spline");
  EXPECT_EQ(planned(document).result.dump(), planned(document).result.dump());
}

}  // namespace
}  // namespace bahnwerk::api::probe_path
