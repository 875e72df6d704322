#include "core/probe/figures.hpp"

#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

TEST(ProbeFigures, OfAStraightAreKnown) {
  const ProbeProblem p = problem({{0, 0, 0}, {10, 0, 0}, {60, 0, 0}, {80, 0, 0}}, 0.1, 3);
  Progress silent;
  ProgressScope scope(silent, "test");
  const ProbeMotion plan = plan_arcs(p, silent);
  const ProbeFigures f = probe_figures(p, plan, scope);
  EXPECT_NEAR(f.path_length, 80, 1e-9);
  EXPECT_NEAR(f.mean_speed, 80 / plan.duration(), 1e-9);
  EXPECT_NEAR(f.speed_ripple, 0, 1e-8) << "all at nominal speed between the inner points";
  EXPECT_LT(f.max_deviation, 1e-12);
}

TEST(ProbeFigures, ARestInBetweenIsARippleAboveOne) {
  const ProbeProblem p = problem({{0, 0}, {30, 0}, {30, 30}, {0, 30}}, 0);
  Progress silent;
  ProgressScope scope(silent, "test");
  const ProbeFigures f = probe_figures(p, plan_arcs(p, silent), scope);
  EXPECT_NEAR(f.speed_ripple, 20 / (30 / (1.5 + 0.17)), 1e-6);
}

TEST(ProbeFigures, APointThatIsPassedJustBesideAJointIsNoRipple) {
  const ProbeProblem p = problem({{100, 0}, {120, 0}, {140, 0}, {160, 0}}, 0.1);
  ProbeMotion plan;
  plan.motion = std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{1, {{100, 20}, {0}}}, {2, {{120, 20}, {0}}}, {3, {{140, 20}, {0}}}});
  plan.times = {0, std::nextafter(1.0, 0.0), std::nextafter(2.0, 3.0), 3};
  Progress silent;
  ProgressScope scope(silent, "test");
  EXPECT_NEAR(probe_figures(p, plan, scope).speed_ripple, 0, 1e-9);
}

}  // namespace
}  // namespace bahnwerk
