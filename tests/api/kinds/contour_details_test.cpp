// What a contour's result tells beside the plan: how good its sections are, and what other limits would bring.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "api/kinds/contour/contour.hpp"
#include "core/base/progress.hpp"
#include "tests/api/checked.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;

json result(const json& spec) {
  Progress progress;
  return json::parse(test::checked(find_kind("contour")->plan(spec, progress)).result.dump());
}

json program() {
  return {
      {"contour", {{"gcode", "G21 G90\nG0 X0 Y0\nM3\nG1 X40 F60000\nG3 X50 Y10 I0 J10\nG1 Y40\nX12 Y33\nM5\nM2\n"}}},
      {"machine",
       {{"kinematics", "cartesian"},
        {"axes",
         {{"x", {{"velocity", 1800}, {"acceleration", 16000}, {"jerk", 400000}}},
          {"y", {{"velocity", 1800}, {"acceleration", 16000}, {"jerk", 400000}}}}},
        {"cycle_time", 0.001}}},
      {"planning",
       {{"method", "jerk_limited"}, {"corner", {{"mode", "blend"}, {"tolerance", 0.02}}}, {"what_if", true}}}};
}

TEST(ContourDetails, WhatIfEqualsThePlanOfTheChangedDocument) {
  const json spec = program(), asked = result(spec);
  const json& answers = asked["details"]["what_if"];
  ASSERT_EQ(answers.size(), 4u);
  for (const json& answer : answers) {
    SCOPED_TRACE(answer["text"].get<std::string>());
    const double factor = answer["factor"];
    json other = spec;
    other["planning"]["what_if"] = false;
    if (answer["limit"] == "tolerance") {
      other["planning"]["corner"]["tolerance"] = factor * 0.02;
    } else {
      const std::string limit = answer["limit"];
      for (json& axis : other["machine"]["axes"]) axis[limit] = factor * axis[limit].get<double>();
    }
    const json told = result(other);
    EXPECT_EQ(answer["duration"], told["summary"]["duration"]);
    EXPECT_EQ(answer["ratio"].get<double>(),
              told["summary"]["duration"].get<double>() / asked["summary"]["duration"].get<double>());
    EXPECT_FALSE(told["details"].contains("what_if"));
  }
  EXPECT_THAT(answers[0]["text"].get<std::string>(), testing::MatchesRegex("twice the tolerance: .* s, .* % less"));
  EXPECT_THAT(answers[1]["text"].get<std::string>(), testing::MatchesRegex("half the jerk: .* s, .* % more"));
  EXPECT_THAT(answers[2]["text"].get<std::string>(), testing::MatchesRegex("twice the jerk: .* s, .* % less"));
  EXPECT_THAT(answers[3]["text"].get<std::string>(), testing::MatchesRegex("half the accelerations: .* s, .* % more"));
}

TEST(ContourDetails, WhatIfPlansTheLimitsThatApply) {
  json spec = program();
  spec["planning"] = {{"method", "time_optimal"}, {"what_if", true}};
  const json answers = result(spec)["details"]["what_if"];
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0]["limit"], "acceleration");
  // The schema's largest tolerance cannot be doubled.
  spec["planning"]["corner"] = {{"mode", "blend"}, {"tolerance", 1000}};
  const json none = result(spec)["details"]["what_if"][0];
  EXPECT_TRUE(none["duration"].is_null());
  EXPECT_TRUE(none["ratio"].is_null());
  EXPECT_EQ(none["text"], "twice the tolerance: cannot be planned");
}

TEST(ContourDetails, SectionsHaveTheirOwnGaps) {
  json spec = program();
  spec["planning"] = {{"method", "jerk_limited"}};
  const json sections = result(spec)["details"]["sections"];
  EXPECT_EQ(sections["count"], 2);  // up to the corner and behind it
  EXPECT_EQ(sections["worst"]["line"], 4);
  EXPECT_NEAR(sections["worst"]["time"].get<double>() / sections["worst"]["bound"].get<double>() - 1,
              sections["worst"]["gap"].get<double>(), 1e-12);
  spec["contour"] = {{"points", {{0, 0}, {0.5, 0}}}};
  const json none = result(spec)["details"]["sections"];
  EXPECT_EQ(none["count"], 0);
  EXPECT_TRUE(none["worst"].is_null());
}

}  // namespace
}  // namespace bahnwerk::api::contour
