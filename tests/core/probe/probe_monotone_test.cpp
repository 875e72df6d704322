// What has to hold between problems: time is only a scale.
#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/spline/spline.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

double arcs(const ProbeProblem& p) {
  SilentProgress silent;
  return plan_arcs(p, silent).duration();
}
double spline(const ProbeProblem& p) {
  SilentProgress silent;
  return plan_spline(p, silent).duration();
}

/// The same problem with time k times as slow.
ProbeProblem scaled(ProbeProblem p, double k) {
  p.speed /= k;
  for (AxisLimits& axis : p.machine.axes)
    axis.acceleration /= k * k, axis.jerk /= k * k * k, axis.snap /= k * k * k * k;
  return p;
}

TEST(ProbeMonotone, TimeIsOnlyAScale) {
  for (int i = 0; i < testing::cases(5); ++i) {
    const RandomSet set(static_cast<std::uint64_t>(1000 + i));
    for (const double k : {4.0, 0.3}) {
      const double a = arcs(set.problem), b = spline(set.problem);
      EXPECT_NEAR(arcs(scaled(set.problem, k)), k * a, 1e-9 * k * a) << set.words;
      EXPECT_NEAR(spline(scaled(set.problem, k)), k * b, 1e-9 * k * b) << set.words;
    }
  }
}

}  // namespace
}  // namespace bahnwerk
