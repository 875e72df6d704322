#include "api/planned_job.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {
namespace {

struct Counting final : ProgressSink {
  explicit Counting(int most) : left(most) {}
  void report(std::string_view stage, double, std::string_view) override {
    EXPECT_EQ(stage, "storing");
    if (--left == 0) throw Stopped(StopReason::cancelled);
  }
  int left;
};

PlannedJob large() {
  PlannedJob planned;
  planned.result = {{"kind", "ramp"}, {"value", -0.1}, {"none", nullptr}, {"text", "ä\n\""}};
  for (int k = 0; k < 200'000; ++k) planned.result["list"].push_back({{"k", k}, {"x", k / 7.0}});
  return planned;
}

TEST(ResultText, IsThatOfTheDocument) {
  const PlannedJob planned = large();
  Counting never(1'000'000);
  EXPECT_EQ(result_text(planned, never), planned.result.dump());
}

TEST(ResultText, StopsWhenItIsToldTo) {
  const PlannedJob planned = large();
  Counting soon(5);
  EXPECT_THROW(result_text(planned, soon), Stopped);
  EXPECT_EQ(soon.left, 0);
}

}  // namespace
}  // namespace bahnwerk::api
