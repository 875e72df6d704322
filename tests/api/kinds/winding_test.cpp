#include "api/kinds/winding/winding.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kind.hpp"
#include "api/kinds/fill_factor/fill_factor.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/api/kinds/winding_documents.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;

TEST(WindingPlan, WiresInHandAreLaidTogether) {
  json spec = example("minimal");
  const json one = planned(spec).result;
  spec["coil"]["parallel"] = 2;
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  const json two = job.result;
  // n = z_p / t: wires in hand by the time of a turn.
  EXPECT_NEAR(one["summary"]["strokes_per_minute"].get<double>(), 60 * 2 / one["summary"]["duration"].get<double>(),
              1e-9);
  EXPECT_NEAR(two["summary"]["strokes_per_minute"].get<double>(), 2 * 60 * 2 / two["summary"]["duration"].get<double>(),
              1e-9);
  EXPECT_EQ(two["summary"]["turns"], 2);
  EXPECT_EQ(two["summary"]["parallel"], 2);
  // Twice the wire, half the resistance, but for where the places lie.
  EXPECT_NEAR(two["summary"]["wire_length"].get<double>() / one["summary"]["wire_length"].get<double>(), 2, 0.05);
  EXPECT_NEAR(two["summary"]["resistance"].get<double>() / one["summary"]["resistance"].get<double>(), 0.5, 0.02);
  EXPECT_EQ(two["details"]["layout"]["windable"]["turns"].get<int>(),
            two["details"]["layout"]["windable"]["wires"].get<int>() / 2);
}

TEST(WindingPlan, SaysAsKindFillFactorDoesThatAWireIsPushedOut) {
  json spec = example("complete");
  // A wide slot: the wires of the first layer lie loose in it.
  json& slot = spec["part"]["slot"];
  slot["base_width"] = 15, slot["tip_angle"] = 98, slot["base_radius"] = 126, slot["wedge_width"] = 3;
  for (const char* member : {"base_radius", "tool_radius"}) spec["part"].erase(member);
  spec["part"]["slots"] = 24;
  spec["wire"] = 1.25;
  spec["coil"] = {{"slots", {0, 5}}, {"turns", 16}};
  spec["needle"] = {{"width", 1.7}, {"pivot_limit", 10}, {"clearance", -5}};
  spec["feed"] = {{"method", "natural"}};
  const json said = planned(spec).result;
  json fill_slot = slot;
  fill_slot["type"] = "stator";
  const json heads{{"slot_pitch", 15}, {"span", 5}, {"tool_shift", 2.5}, {"tool_height", 15.5}, {"stack", 210}};
  const json fill{{"slot", fill_slot},
                  {"wires", {1.25}},
                  {"algorithms", {"needle"}},
                  {"heads", heads},
                  {"turns", {{"serial", 16}, {"parallel", 1}}},
                  {"drawings", false}};
  Progress silent;
  const json layout = json(find_kind("fill_factor")->plan(fill, silent).result)["details"]["layouts"][0];
  EXPECT_EQ(said["details"]["layout"]["regions"]["slot"]["positions"], layout["positions"]);
  for (const char* member : {"producible", "slips", "blocked_by", "windable"})
    EXPECT_EQ(said["details"]["layout"][member], layout[member]) << member;
  EXPECT_EQ(said["summary"]["producible"], false);
  EXPECT_EQ(said["summary"]["windable_turns"], layout["windable"]["turns"]);
  EXPECT_THAT(said["details"]["notes"].dump(), ::testing::HasSubstr("pushed out"));
}

TEST(WindingPlan, SetpointsOfTangentLinksKeepTheJerkOfTheirDifferences) {
  json spec = example("minimal");
  spec["coil"]["turns"] = 1;
  spec["path"]["continuity"] = 1;
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  const auto& columns = job.setpoints->columns();
  const std::size_t width = columns.size(), n = job.setpoints->count();
  std::vector<double> rows(n * width);
  job.setpoints->read(0, n, rows.data());
  const double cycle = job.setpoints->cycle_time();
  const json limits = spec["machine"]["axes"];
  double strained = 0;
  for (std::size_t c = 0; c < 5; ++c)
    for (std::size_t k = 3; k < n; ++k) {
      const auto q = [&](std::size_t back) { return rows[(k - back) * width + c]; };
      const double jerk = std::abs(q(0) - 3 * q(1) + 3 * q(2) - q(3)) / (cycle * cycle * cycle);
      strained = std::max(strained, jerk / limits[columns[c].name]["jerk"].get<double>());
    }
  EXPECT_LE(strained, 1 + 1e-6);
  EXPECT_GT(strained, 0.7) << "the limit is used";
  bool named = false;
  for (const auto& check : job.result["verification"]["checks"]) named |= check["name"] == "setpoint jerk q4";
  EXPECT_TRUE(named) << "checked of the exact interpolator, too";
}

TEST(WindingPlan, ANominalFeedMayFluctuateByWhatIsStated) {
  json spec = example("minimal");
  spec["coil"]["turns"] = 1;
  spec["feed"] = {{"method", "constant"}, {"velocity", 8}, {"interpolator", "quartic"}};
  EXPECT_TRUE(planned(spec).verified);
  spec["feed"]["tolerance"] = 0;
  const PlannedJob strict = planned(spec);
  EXPECT_FALSE(strict.verified);
  for (const auto& check : strict.result["verification"]["checks"])
    if (!check["passed"].get<bool>()) {
      EXPECT_EQ(check["name"], "setpoint path velocity");
      EXPECT_TRUE(check.contains("place") && check.contains("change"));
    }
}

TEST(WindingPlan, LinksByTimeAreTimedWithTheFeedAskedFor) {
  json spec = example("rotor");
  spec["coil"] = {{"slots", {1, 0}}, {"turns", 1}};
  spec["needle"] = {{"clearance", -100}};
  spec["feed"] = {{"method", "critical_points"}};
  spec["path"] = {{"objective", "curvature"}};
  const double smooth = planned(spec).result["summary"]["duration"];
  spec["path"]["objective"] = "minimum_time";
  const json quick = planned(spec).result;
  EXPECT_LE(quick["summary"]["duration"].get<double>(), smooth * (1 + 1e-9));
  EXPECT_EQ(quick["details"]["link_times"]["feed"], "critical_points");
  EXPECT_NEAR(quick["details"]["link_times"]["curvature"].get<double>(), smooth, 1e-6 * smooth);
}

TEST(WindingPlan, ASlotAsItIsDrawnIsWound) {
  json spec = example("complete");
  // Drawn lying on its side, 150 mm off, its mouth the bore's arc of 79 mm, which dips 2 hundredths of a millimetre.
  const auto place = [](double x, double y) { return json::array({150 + y, 20 - x}); };
  json points = json::array();
  for (const auto& [x, y] : {std::pair{-2.9, 0.0},
                             {2.9, 0.0},
                             {2.2, 15.5},
                             {1.8, 16.0},
                             {0.9, 15.985},
                             {0.0, 15.98},
                             {-0.9, 15.985},
                             {-1.8, 16.0},
                             {-2.2, 15.5}})
    points.push_back(place(x, y));
  spec["part"]["slot"] = {
      {"type", "polygon"}, {"points", points}, {"liner", 0.2}, {"opening", {place(-1.8, 16), place(1.8, 16)}}};
  spec["part"]["base_radius"] = 95;
  spec["coil"] = {{"slots", {0, 5}}, {"turns", 1}};
  spec["needle"] = {{"width", 1.6}, {"pivot_limit", 10}};
  spec["feed"] = {{"method", "natural"}};
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified) << job.result["verification"].dump();
  EXPECT_TRUE(job.result["summary"]["producible"]);
  EXPECT_GT(job.result["summary"]["clearance"], 0.1);
  spec["needle"]["width"] = 3.7;
  EXPECT_THAT(problem_of(spec, "semantic-violation"), ::testing::HasSubstr("clear opening of 3.6 mm"));
  spec["needle"]["width"] = 1.6;
  spec["part"].erase("base_radius");
  EXPECT_THAT(problem_of(spec, "semantic-violation"), ::testing::HasSubstr("/spec/part/base_radius"));
}

TEST(WindingPlan, AHolderDoesNotEnterTheSlot) {
  json spec = example("complete");
  spec["coil"] = {{"slots", {0, 5}}, {"turns", 1}};
  spec["needle"]["length"] = 4;
  EXPECT_THAT(problem_of(spec, "semantic-violation"), ::testing::HasSubstr("/spec/needle/length"));
  spec["needle"]["length"] = 60;
  spec["machine"]["l_tool"] = 4;
  EXPECT_THAT(problem_of(spec, "semantic-violation"), ::testing::HasSubstr("/spec/machine/l_tool"));
}

TEST(WindingPlan, AnArmThatIsTooShortIsNamedWithTurnRegionAndPose) {
  json spec = example("minimal");
  spec["machine"] = machine("robot");
  spec["machine"]["l1"] = spec["machine"]["l2"] = 200;
  const std::string detail = problem_of(spec, "unreachable-pose");
  for (const char* word : {"turn 1 of coil 1", "slot", "path length", "phi", "deg"})
    EXPECT_THAT(detail, testing::HasSubstr(word));
}

TEST(WindingPlan, ANeedleThatComesTooNearFails) {
  json spec = example("complete");
  spec["coil"].erase("repeat");
  spec["coil"]["turns"] = 1;
  spec["feed"] = {{"method", "optimised"}};
  spec["path"]["extra_point"] = 0;  // links that bend before they are out of the slot
  spec["needle"] = {{"width", 3.0}, {"pivot_limit", 10}, {"clearance", 0}};
  Progress silent;
  const PlannedJob job = test::checked(find_kind("winding")->plan(spec, silent));
  EXPECT_FALSE(job.verified);
  EXPECT_LT(job.result["details"]["clearance"]["minimum"].get<double>(), 0);
  bool failed = false;
  for (const auto& check : job.result["verification"]["checks"])
    failed = failed || (check["name"] == "needle clearance" && !check["passed"].get<bool>());
  EXPECT_TRUE(failed);
}

TEST(WindingPlan, TheSourcesExampleLimitsTakeLongestAtAConstantFeed) {
  double before = 0;
  for (const char* method : {"optimised", "critical_points", "constant"}) {
    const json document = test::read_json(test::source(std::string("examples/feeds/rotor_") + method + ".json"));
    EXPECT_FALSE(test::refusal(document.dump())) << method;
    json spec = document["spec"];
    EXPECT_EQ(spec["feed"]["method"], method);
    spec["coil"]["turns"] = 1;
    const PlannedJob job = planned(spec);
    EXPECT_TRUE(job.verified) << method;
    EXPECT_EQ(job.result["details"]["feed"], method);
    EXPECT_EQ(job.result["details"]["profile"].is_null(), method == std::string("optimised"));
    EXPECT_LE(job.result["details"]["fastest"].get<double>(), 150 * (1 + 1e-9));
    EXPECT_GT(job.result["summary"]["duration"].get<double>(), before) << method;
    before = job.result["summary"]["duration"];
  }
}

TEST(WindingPlan, TheContractsFeedIsPlannedWithEveryMethod) {
  for (const char* method : {"optimised", "critical_points", "constant", "natural"}) {
    json spec = example("minimal");
    spec["coil"]["turns"] = 1;
    spec["feed"] = {{"method", method},           {"profile", "double_s"}, {"velocity", 700},
                    {"acceleration", 4000},       {"jerk", 60000},         {"chord_tolerance", 0.005},
                    {"half_speed_curvature", 0.2}};
    EXPECT_FALSE(test::refusal(test::job_with_spec("winding", spec).dump())) << method;
    EXPECT_TRUE(planned(spec).verified) << method;
  }
}

TEST(WindingPlan, TrapezoidIsNotedToHoldNoJerk) {
  json spec = example("minimal");
  spec["coil"]["turns"] = 1;
  spec["feed"] = {{"method", "constant"}, {"profile", "trapezoid"}};
  const PlannedJob job = planned(spec);
  EXPECT_TRUE(job.verified);
  EXPECT_THAT(job.result["details"]["notes"].dump(), testing::HasSubstr("no jerk limit"));
  for (const auto& check : job.result["verification"]["checks"])
    EXPECT_THAT(check["name"].get<std::string>(), testing::Not(testing::HasSubstr("jerk")));
}

TEST(WindingPlan, AConstantFeedThatIsTooFastIsInfeasible) {
  json spec = example("minimal");
  spec["coil"]["turns"] = 1;
  spec["feed"] = {{"method", "constant"}, {"velocity", 700}};
  const std::string detail = problem_of(spec, "infeasible");
  for (const char* word : {"feed.velocity", "turn 1 of coil 1", "limit of q", "largest constant feed"})
    EXPECT_THAT(detail, testing::HasSubstr(word));
}

TEST(WindingPlan, MoreTurnsThanTheLayoutHasAreRefused) {
  json spec = example("minimal");
  spec["coil"]["turns"] = request(spec).turns;
  const std::size_t most = planned(spec).result["details"]["layout"]["count"];
  spec["coil"]["turns"] = most + 1;
  EXPECT_THAT(problem_of(spec, "semantic-violation"), testing::HasSubstr("/coil/turns"));
}

// One of its changes of speed meets a bend between the nodes, on the finest grid, too.
TEST(WindingPlan, CriticalPointsAreSlowedByWhatTheirNodesMiss) {
  json spec = json::parse(
      R"({"part":{"type":"stator","slot":{"base_width":2.42,"opening_width":1.7998,"height":8.1123,"tip_angle":90.886,"base_radius":55.326,"base_corner_radius":0.12392,"tip_corner_radius":0.2747,"liner":0,"wedge_thickness":0.4,"wedge_width":1.7998},"slots":48,"stack":48.585,"tool_shift":0.23127,"tool_height":9.0661},
      "wire":0.63,
      "grade":2,
      "coil":{"slots":[14,0],"turns":3},
      "machine":{"type":"vertical","d_upper":700,"a_upper":500,"d_lower":100,"a_lower":500,"o_tool":80,"l_tool":40,"part":{"origin":[0,0,0],"angle":0},"axes":{"q1":{"velocity":846.07,"acceleration":7905.8,"jerk":215890.0,"range":[250,700]},"q2":{"velocity":455.77,"acceleration":4697.3,"jerk":114780.0,"range":[430,770]},"q3":{"velocity":172.32,"acceleration":2041.4,"jerk":52883.0,"range":[-100,100]},"q4":{"velocity":218.88,"acceleration":2051.8,"jerk":28063.0,"range":null},"q5":{"velocity":344.98,"acceleration":3198.4,"jerk":68326.0,"range":[400,600]}},"cycle_time":0.001},
      "path":{"continuity":3,"objective":"curvature"},
      "pull":{"force":12.486,"bend_radius":3.1426,"free_length":1.3716},
      "needle":{"length":47.214,"width":0.80545,"pivot_limit":null,"clearance":0},
      "feed":{"method":"critical_points","velocity":91.933,"acceleration":3097.6,"jerk":56997.0}})");
  const auto duration = [&](const char* method) {
    spec["feed"]["method"] = method;
    const PlannedJob job = planned(spec);
    EXPECT_TRUE(job.verified) << method;
    return job.result["summary"]["duration"].get<double>();
  };
  const double critical_points = duration("critical_points");
  EXPECT_GT(critical_points, duration("optimised"));
  spec["feed"]["velocity"] = nullptr;  // the largest that holds
  EXPECT_LT(critical_points, duration("constant"));
}

}  // namespace
}  // namespace bahnwerk::api::winding_kind
