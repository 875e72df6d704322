// A made-up kind in the frame: it counts down, and has a setpoint for each number.
#include "api/kinds/kind_frame.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "api/verification.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

class Rows final : public SetpointSource {
 public:
  explicit Rows(std::size_t count, Independent over = {"time", "s", 0.5}) : count_(count), over_(std::move(over)) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return count_; }
  double cycle_time() const override { return 0.5; }
  double duration() const override { return 0.5 * static_cast<double>(count_ - 1); }
  Independent independent() const override { return over_; }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k) *out++ = static_cast<double>(count_ - k);
  }

 private:
  std::size_t count_;
  Independent over_;
  std::vector<Column> columns_{{"left", "1"}};
};

struct Countdown {
  static constexpr std::string_view name = "countdown", title = "Numbers that fall";
  static std::size_t read(const json& spec, Progress progress) {
    if (spec["from"] == 0) throw InvalidInput(std::vector<InputFault>{{{"from"}, "must not be 0"}});
    progress.report("reading", 0.1);
    return spec["from"];
  }
  static void check(std::size_t from) {
    if (from == 13) throw InvalidInput(std::vector<InputFault>{{{"from"}, "brings no luck"}});
  }
  static std::size_t plan(std::size_t& from, Progress progress) {
    progress.report("counting", 0.5);
    return from + 1;
  }
  static KindReport report(std::size_t from, std::size_t& rows, Progress) {
    KindReport out;
    out.summary = {{"rows", rows}};
    Verification verdict;
    verdict.passed = from < 100;
    out.verification = verification(verdict);
    out.bound = bound(Bound{1, 0, "none counts faster"});
    out.details = {{"from", from}};
    if (from != 7) out.setpoints = std::make_unique<Rows>(rows);
    if (from == 3) out.drawings = {{"fall.svg", "<svg/>"}};
    return out;
  }
};

struct Stages final : ProgressSink {
  void report(std::string_view stage, double, std::string_view) override { seen += std::string(stage) + " "; }
  std::string seen;
};

PlannedJob planned(std::size_t from) {
  Progress silent;
  return kind_of<Countdown>().plan({{"from", from}}, silent);
}

std::vector<std::string> members(const ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

TEST(KindFrame, ResultHasTheMembersOfEveryKindInTheirOrder) {
  const PlannedJob job = planned(3);
  EXPECT_EQ(members(job.result),
            (std::vector<std::string>{"kind", "summary", "verification", "bound", "setpoints", "details"}));
  EXPECT_EQ(job.result["kind"], "countdown");
  EXPECT_EQ(job.result["setpoints"]["count"], 4);
  EXPECT_EQ(members(job.result["details"]), (std::vector<std::string>{"from", "drawings"}));
  ASSERT_TRUE(job.setpoints);
  EXPECT_EQ(job.setpoints->count(), 4u);
}

TEST(KindFrame, SummaryOfSetpointsNamesTheIndependentVariableWhereThatIsNotTime) {
  EXPECT_EQ(planned(3).result["setpoints"].dump(),
            R"({"count":4,"duration":1.5,"cycle_time":0.5,"columns":[{"name":"left","unit":"1"}]})");
  KindReport report;
  report.verification = {{"passed", true}};
  report.setpoints = std::make_unique<Rows>(5, Independent{"phi", "deg", 90});
  EXPECT_EQ(planned_job("countdown", std::move(report)).result["setpoints"].dump(),
            R"({"count":5,"duration":2.0,"cycle_time":0.5,"independent":{"name":"phi","unit":"deg","step":90.0},)"
            R"("columns":[{"name":"left","unit":"1"}]})");
}

TEST(KindFrame, WhatAKindDoesNotHaveIsNotInItsResult) {
  const PlannedJob job = planned(7);
  EXPECT_FALSE(job.result.contains("setpoints"));
  EXPECT_FALSE(job.result["details"].contains("drawings"));
  EXPECT_FALSE(job.setpoints);
}

TEST(KindFrame, JobIsVerifiedIfTheVerificationPassed) {
  EXPECT_TRUE(planned(99).verified);
  EXPECT_FALSE(planned(100).verified);
}

TEST(KindFrame, FaultsOfReadingAndOfCheckingAreFoundWhenTheDocumentIsSubmitted) {
  const Kind kind = kind_of<Countdown>();
  Progress silent;
  EXPECT_NO_THROW(kind.check({{"from", 12}}, silent));
  for (const int from : {0, 13}) try {
      kind.check({{"from", from}}, silent);
      ADD_FAILURE() << from << " is accepted";
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.type().slug, "semantic-violation");
      ASSERT_EQ(problem.errors().size(), 1u);
      EXPECT_EQ(problem.errors()[0].pointer, "/spec/from");
    }
}

TEST(KindFrame, ProgressPassesThroughReadingAndPlanning) {
  Stages stages;
  kind_of<Countdown>().plan({{"from", 5}}, stages);
  EXPECT_EQ(stages.seen, "read reading counting ");
}

TEST(KindFrame, SchemasAreFoundByTheKindsName) {
  EXPECT_TRUE(kind_of<Countdown>().schema.empty());
  for (const Kind& kind : kinds()) {
    EXPECT_FALSE(kind.schema.empty()) << kind.name;
    EXPECT_FALSE(kind.result_schema.empty()) << kind.name;
  }
}

}  // namespace
}  // namespace bahnwerk::api
