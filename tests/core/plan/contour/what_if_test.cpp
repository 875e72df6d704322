// What if limits were others: exactly what a plan with those limits says.
#include "core/plan/contour/what_if.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"

namespace bahnwerk {
namespace {

Contour part() {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.line({40, 0, 0});
  b.arc({60, 20, 0}, {40, 20, 0}, true);
  b.line({60, 45, 0});
  b.line({20, 50, 0});
  b.dwell(0.1);
  b.line({0, 30, 0});
  return b.finish();
}

const Machine machine{{{"x", 1800, 16000, 400000}, {"y", 900, 8000, 800000}}, 0.001};

ContourPlanning planning(PlanningMethod method, double tolerance) {
  ContourPlanning p;
  p.method = method;
  if (tolerance > 0) p.corner_mode = CornerMode::blend, p.blend_tolerance = tolerance;
  p.what_if = true;
  return p;
}

ContourPlan plan(const Machine& m, const ContourPlanning& p) {
  Progress progress;
  return plan_contour(part(), m, p, progress);
}

TEST(WhatIf, EachAnswerIsThePlanWithThatLimit) {
  for (const PlanningMethod method :
       {PlanningMethod::braking_reserve, PlanningMethod::time_optimal, PlanningMethod::jerk_limited})
    for (const double tolerance : {0.0, 0.02}) {
      ContourPlanning asked = planning(method, tolerance);
      if (method == PlanningMethod::jerk_limited) asked.along = {300, 12000, 300000};
      const ContourPlan p = plan(machine, asked);
      const bool jerk = method == PlanningMethod::jerk_limited;
      ASSERT_EQ(p.what_if.size(), (tolerance > 0 ? 1u : 0u) + (jerk ? 2u : 0u) + 1u);
      for (const WhatIf& answer : p.what_if) {
        Machine m = machine;
        ContourPlanning other = asked;
        other.what_if = false;
        if (answer.what == WhatIf::What::tolerance) other.blend_tolerance *= answer.factor;
        for (AxisLimits& axis : m.axes) {
          if (answer.what == WhatIf::What::jerk) axis.jerk *= answer.factor;
          if (answer.what == WhatIf::What::acceleration) axis.acceleration *= answer.factor;
        }
        if (answer.what == WhatIf::What::jerk) other.along.jerk *= answer.factor;
        if (answer.what == WhatIf::What::acceleration) other.along.acceleration *= answer.factor;
        ASSERT_TRUE(answer.duration.has_value());
        EXPECT_EQ(*answer.duration, plan(m, other).duration);
        if (answer.what != WhatIf::What::tolerance) {
          EXPECT_EQ(*answer.duration > p.duration, answer.factor < 1);
        }
      }
      EXPECT_TRUE(plan(machine,
                       [&] {
                         ContourPlanning none = asked;
                         none.what_if = false;
                         return none;
                       }())
                      .what_if.empty());
    }
}

TEST(WhatIf, UnplannableLimitsHaveNoDuration) {
  const ContourPlan p = plan(machine, planning(PlanningMethod::time_optimal, 600));  // 1 000 mm at most
  ASSERT_EQ(p.what_if.size(), 2u);
  EXPECT_EQ(p.what_if[0].what, WhatIf::What::tolerance);
  EXPECT_FALSE(p.what_if[0].duration.has_value());
  EXPECT_TRUE(p.what_if[1].duration.has_value());
}

/// Stops as soon as it is asked what if.
class Stopping final : public ProgressSink {
 public:
  void report(std::string_view stage, double fraction, std::string_view) override {
    EXPECT_GE(fraction, last_);
    EXPECT_LE(fraction, 1);
    last_ = fraction;
    asked_ = asked_ || stage == "what if";
    if (stage == "what if" && stop_) throw Stopped(StopReason::cancelled);
  }
  bool stop_ = true, asked_ = false;

 private:
  double last_ = 0;
};

TEST(WhatIf, ReportsForwardAndStops) {
  const ContourPlanning asked = planning(PlanningMethod::jerk_limited, 0.02);
  Stopping stopping;
  EXPECT_THROW(plan_contour(part(), machine, asked, stopping), Stopped);
  Stopping going;
  going.stop_ = false;
  plan_contour(part(), machine, asked, going);
  EXPECT_TRUE(going.asked_);
}

}  // namespace
}  // namespace bahnwerk
