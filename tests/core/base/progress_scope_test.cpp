#include "core/base/progress_scope.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

struct Recorded final : ProgressSink {
  void report(std::string_view stage, double fraction, std::string_view) override {
    stages.emplace_back(stage);
    fractions.push_back(fraction);
  }
  std::vector<std::string> stages;
  std::vector<double> fractions;
};

TEST(ProgressScope, WorkIsReportedSeldomAndAtTheFractionDone) {
  Recorded whole;
  ProgressScope scope(Progress(whole).part(0.2, 0.6), "verify");
  for (int i = 0; i < 100'000; ++i) scope.work();
  EXPECT_EQ(whole.fractions.size(), 100'000u / 8192);
  scope.done(0.5);
  scope.work(8192);
  EXPECT_DOUBLE_EQ(whole.fractions.front(), 0.2);
  EXPECT_DOUBLE_EQ(whole.fractions.back(), 0.4);
  for (const auto& stage : whole.stages) EXPECT_EQ(stage, "verify");
}

TEST(ProgressScope, PartsLieWithinTheStage) {
  Recorded whole;
  ProgressScope scope(Progress(whole).part(0.5, 1), "planning");
  scope.part(0, 0.2);
  EXPECT_DOUBLE_EQ(whole.fractions.back(), 0.5);
  scope.now(16, 32);
  EXPECT_DOUBLE_EQ(whole.fractions.back(), 0.55);
  scope.half_of_rest();
  EXPECT_DOUBLE_EQ(whole.fractions.back(), 0.6);
  scope(1 << 14, 1 << 15);
  EXPECT_DOUBLE_EQ(whole.fractions.back(), 0.7);
  scope.half_of_rest();
  EXPECT_DOUBLE_EQ(whole.fractions.back(), 0.8);
}

TEST(ProgressScope, StepsBetweenReportsAreSilent) {
  Recorded whole;
  ProgressScope scope(whole, "planning");
  for (std::size_t i = 1; i < 16; ++i) scope.now(i, 100);
  for (std::size_t i = 1; i < 1 << 14; ++i) scope(i, 1 << 15);
  EXPECT_TRUE(whole.fractions.empty());
}

}  // namespace
}  // namespace bahnwerk
