#include "api/kinds/winding/winding_result.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/contour/dxf.hpp"
#include "tests/api/kinds/winding_documents.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;

TEST(WindingPlan, TellsFluctuationWireAndTurnTimes) {
  json spec = example("minimal");
  spec["pull"] = {{"effective_mass", 0.05}};
  const PlannedJob job = planned(spec);
  const auto& d = job.result["details"];
  EXPECT_EQ(d["interpolator"], "exact");
  EXPECT_LE(d["feed_fluctuation"]["exact"]["largest"], 1e-6);
  EXPECT_LE(d["feed_fluctuation"]["quartic"]["mean"], 1e-3);
  EXPECT_GT(d["wire"]["peak_at_constant_brake"], d["wire"]["peak"]);
  EXPECT_LT(d["wire"]["least_at_constant_brake"], d["wire"]["least"]);
  EXPECT_EQ(d["wire"]["length"], job.result["summary"]["wire_length"]);
  // 8.96 g/cm³ of 1.12 mm.
  EXPECT_NEAR(d["wire"]["copper_mass"].get<double>() / d["wire"]["length"].get<double>(), 8.827e-3, 1e-5);
  EXPECT_LE(d["turn_time"]["least"], d["turn_time"]["mean"]);
  EXPECT_LE(d["turn_time"]["mean"], d["turn_time"]["most"]);
  EXPECT_NEAR(d["turn_time"]["mean"].get<double>() * static_cast<double>(d["turns"].size()),
              job.result["setpoints"]["duration"].get<double>(), 1e-9);
}

TEST(WindingPlan, ResultHasTheContractsForm) {
  json spec = example("minimal");
  spec["coil"]["repeat"] = {{"step", 1}, {"count", 2}};
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  const auto& r = job.result;
  EXPECT_EQ(r["summary"]["turns"], 4);
  EXPECT_EQ(r["summary"]["coils"], 2);
  EXPECT_EQ(r["summary"]["clearance"], r["details"]["clearance"]["minimum"]);
  EXPECT_LE(r["details"]["clearance"]["at"], r["summary"]["path_length"]);
  EXPECT_GT(r["summary"]["resistance"].get<double>(), 0);
  const auto& d = r["details"];
  for (const char* drawing : {"needle_path.svg", "curvature.svg"}) {
    const std::string svg = d["drawings"][drawing];
    EXPECT_THAT(svg, ::testing::StartsWith("<svg")) << drawing;
    EXPECT_THAT(svg, ::testing::HasSubstr("<path")) << drawing;
  }
  const Contour read = read_dxf(d["drawings"]["needle_path.dxf"].get<std::string>());
  const double length = r["summary"]["path_length"];
  EXPECT_NEAR(read.path.length(), length, 1e-9 * length);
  EXPECT_EQ(d["turns"].size(), 4u);
  // Four regions per turn and the way between the coils, two poses each.
  EXPECT_EQ(d["support_points"].size(), 2u * (4 * 4 + 1));
  double before = 0;
  std::vector<double> begins;
  for (const auto& point : d["support_points"]) {
    const double time = point["time"];
    EXPECT_GE(time, before);
    before = time;
    if (point["region"] == "slot" && point["end"] == "begin") begins.push_back(time);
  }
  EXPECT_NEAR(before, job.result["setpoints"]["duration"].get<double>(), 1e-6);
  ASSERT_EQ(begins.size(), 4u);
  for (std::size_t i = 0; i < begins.size(); ++i) EXPECT_EQ(d["turns"][i]["begins"], begins[i]);
  EXPECT_EQ(d["links"].size() % 16, 0u);
  for (const auto& link : d["links"]) EXPECT_EQ(link["beta"].size(), 6u);
  const auto& path = d["path"];
  EXPECT_EQ(path["degree"], 7);
  EXPECT_EQ(path["points"].size(), path["weights"].size());
  EXPECT_EQ(path["knots"].size(), path["points"].size() + 8);
  const double pieces = path["knots"].back();
  EXPECT_EQ(path["joints"].size() + 1, static_cast<std::size_t>(pieces));
  for (const auto& joint : path["joints"]) EXPECT_GE(joint["continuity"], 3);
  EXPECT_NEAR(path["points"][0][3].get<double>(), d["support_points"][0]["orientation"][0].get<double>(), 1e-9);
  for (const char* region : {"slot", "head_bottom", "slot_back", "head_top"})
    EXPECT_EQ(d["layout"]["regions"][region]["positions"].size(), d["layout"]["count"]);
}

TEST(WindingPlan, TellsWhereInTheSlotTheNeedleCanGo) {
  json spec = example("complete");
  spec["coil"] = {{"slots", spec["coil"]["slots"]}, {"turns", 1}};
  spec["needle"] = {{"width", 2.6}, {"pivot_limit", nullptr}};
  const json details = planned(spec).result["details"], alone = details["access"];
  EXPECT_THAT(details["drawings"]["clearance_map.svg"].get<std::string>(), ::testing::StartsWith("<svg"));
  EXPECT_TRUE(alone["with_pivot_shift"].is_null());
  spec["needle"]["pivot_limit"] = 15;
  const json both = planned(spec).result["details"]["access"];
  EXPECT_EQ(both["without_pivot_shift"], alone["without_pivot_shift"]);
  EXPECT_GT(both["with_pivot_shift"], both["without_pivot_shift"]);
  const json rotor = planned(example("rotor")).result["details"];
  EXPECT_TRUE(rotor["access"].is_null());
  EXPECT_FALSE(rotor["drawings"].contains("clearance_map.svg"));
}

TEST(WindingPlan, LinksByTimeTellWhatTheyGain) {
  json spec = example("rotor");
  EXPECT_TRUE(planned(spec).result["details"]["link_times"].is_null());
  spec["coil"]["turns"] = 1;
  spec["path"]["objective"] = "minimum_time";
  spec["needle"]["clearance"] = -100;
  const PlannedJob job = planned(spec);
  const json times = job.result["details"]["link_times"];
  EXPECT_EQ(times["taken"], "minimum_time");
  EXPECT_GT(times["changed"], 0);
  EXPECT_LT(times["minimum_time"], times["curvature"]);
  EXPECT_NEAR(job.result["summary"]["duration"].get<double>(), times["minimum_time"].get<double>(), 0.01);
}

TEST(WindingPlan, AClearanceThatIsMissedIsToldWithItsPlace) {
  json spec = example("complete");
  spec["coil"] = {{"slots", {0, 5}}, {"turns", 1}};
  spec["path"]["extra_point"] = 0;  // links that bend before they are out of the slot
  spec["needle"] = {{"width", 3.0}, {"pivot_limit", 10}};
  spec["feed"] = {{"method", "natural"}};
  const PlannedJob job = planned(spec);
  ASSERT_FALSE(job.verified);
  const json least = job.result["details"]["clearance"];
  for (const auto& check : job.result["verification"]["checks"]) {
    if (check["passed"].get<bool>()) continue;
    ASSERT_EQ(check["name"], "needle clearance");
    for (const char* member : {"coil", "turn", "region", "link"})
      EXPECT_EQ(json(check["place"][member]), json(least[member]));
    EXPECT_EQ(json(check["place"]["obstacle"]), json(least["nearest"]));
    EXPECT_GT(check["at"], 0);
    EXPECT_THAT(check["change"].get<std::string>(), ::testing::HasSubstr("needle.width"));
    EXPECT_THAT(check["place"]["words"].get<std::string>(), ::testing::HasSubstr("turn "));
  }
}

TEST(WindingPlan, RangesAreToldInDegrees) {
  json spec = example("complete");
  spec["coil"] = {{"slots", {0, 5}}, {"turns", 1}};
  spec["machine"]["axes"]["q5"]["range"] = {-85, 85};
  EXPECT_THAT(problem_of(spec, "unreachable-pose"),
              ::testing::HasSubstr("from -90 to 90 deg, its range is -85 to 85 deg"));
}

/// The document's problem, and the pointer of its first error.
std::pair<std::string, std::string> refused_at(const json& spec) {
  try {
    Progress silent;
    find_kind("winding")->plan(spec, silent);
  } catch (...) {
    const Problem problem = problem_from_current_exception("/spec");
    return {std::string(problem.type().slug), problem.errors().empty() ? "" : problem.errors()[0].pointer};
  }
  return {};
}

TEST(WindingPlan, WhatTakesANeedleOutOfReachIsNamed) {
  json spec = example("complete");
  spec["coil"] = {{"slots", {0, 5}}, {"turns", 2}};
  spec["machine"]["axes"]["q3"]["range"] = {-100, 300};
  using Refusal = std::pair<std::string, std::string>;
  spec["pull"]["bend_radius"] = 40;
  EXPECT_EQ(refused_at(spec), (Refusal{"unreachable-pose", "/spec/pull/bend_radius"}));
  spec["machine"]["axes"]["q3"]["range"] = {-100, 210};
  EXPECT_EQ(refused_at(spec), (Refusal{"unreachable-pose", "/spec/machine"})) << "whatever the bend";
}

TEST(WindingPlan, NumbersOfAPoseOutOfReachAreRounded) {
  json spec = example("minimal");
  spec["machine"] = machine("robot");
  spec["machine"]["l1"] = spec["machine"]["l2"] = 200;
  const std::string detail = problem_of(spec, "unreachable-pose");
  std::size_t digits = 0;
  for (const char c : detail) {
    digits = std::isdigit(static_cast<unsigned char>(c)) ? digits + 1 : 0;
    EXPECT_LE(digits, 6u) << detail;
  }
}

TEST(WindingPlan, ARightAngleIsNotNamedAsMore) {
  json spec = example("complete");
  spec["feed"] = {{"method", "natural"}};
  for (const int turns : {2, 6}) {
    spec["coil"] = {{"slots", {0, 5}}, {"turns", turns}};
    const json details = json(planned(spec).result)["details"];
    double most = 0;
    for (const json& point : details["support_points"]) most = std::max(most, point["exit_angle"].get<double>());
    const bool named = details["notes"].dump().find("more than 90 deg") != std::string::npos;
    EXPECT_EQ(named, most > 90.05) << most;
  }
}

TEST(WindingPlan, RotaryAxesAreInDegrees) {
  const PlannedJob job = planned(example("minimal"));
  const auto& columns = job.result["setpoints"]["columns"];
  const auto unit = [&](const std::string& name) {
    for (const auto& column : columns)
      if (column["name"] == name) return column["unit"].get<std::string>();
    return std::string();
  };
  EXPECT_EQ(unit("q1"), "mm");
  EXPECT_EQ(unit("q4"), "deg");
  EXPECT_EQ(unit("vq4"), "deg/s");
  EXPECT_EQ(unit("jq5"), "deg/s³");
  EXPECT_EQ(unit("phi"), "deg");
  const json limits = machine("horizontal")["axes"];
  bool seen = false;
  for (const auto& check : job.result["verification"]["checks"])
    if (check["name"] == "velocity q4") {
      seen = true;
      EXPECT_EQ(check["unit"], "deg/s");
      EXPECT_NEAR(check["limit"].get<double>(), limits["q4"]["velocity"].get<double>(), 1e-9);
    }
  EXPECT_TRUE(seen);
  // What the axes are said to do is what the setpoints do, and these outlive the plan.
  const auto& setpoints = *job.setpoints;
  std::vector<double> rows(setpoints.count() * columns.size());
  setpoints.read(0, setpoints.count(), rows.data());
  for (std::size_t k = 0; k < 5; ++k) {
    const auto& axis = job.result["details"]["axes"][k];
    for (std::size_t i = k; i < rows.size(); i += columns.size()) {
      EXPECT_GE(rows[i], axis["lowest"].get<double>() - 1e-6);
      EXPECT_LE(rows[i], axis["highest"].get<double>() + 1e-6);
    }
  }
}

}  // namespace
}  // namespace bahnwerk::api::winding_kind
