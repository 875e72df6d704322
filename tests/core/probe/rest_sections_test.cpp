#include "core/probe/rest_sections.hpp"

#include <algorithm>

#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/spline/spline.hpp"
#include "core/probe/straight/stops.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

TEST(RestSections, JoinedMotionsAreRightAndNoSlowerThanEachOfThem) {
  Progress silent;
  for (int i = 0; i < testing::cases(12); ++i) {
    const RandomSet set(static_cast<std::uint64_t>(400 + i));
    const std::vector<ProbeMotion> plans{plan_stops(set.problem, silent), plan_spline(set.problem, silent),
                                         plan_arcs(set.problem, silent)};
    const ProbeMotion joined = probe::quickest_sections(set.problem, plans);
    for (const ProbeMotion& plan : plans) EXPECT_LE(joined.duration(), plan.duration() * (1 + 1e-12)) << set.words;
    const double whole = 0.001 * std::ceil(joined.duration() / 0.001);
    expect_right(set.problem, slowed(joined, whole / joined.duration(), whole), set.words);
  }
}

TEST(RestSections, EachSectionIsThatOfTheQuickerPlan) {
  // A sharp turn is quicker than a rest at the reversal, and the corner without a tube is a rest in both.
  const ProbeProblem p = problem({{0, 0}, {50, 0}, {0, 0}, {0, 9}}, 0);
  Progress silent;
  const ProbeMotion stops = plan_stops(p, silent), arcs = plan_arcs(p, silent);
  const ProbeMotion joined = probe::quickest_sections(p, {stops, arcs});
  EXPECT_NEAR(joined.duration(), arcs.duration(), 1e-12);
  EXPECT_LT(joined.duration(), stops.duration());
  EXPECT_TRUE(std::any_of(joined.phases.begin(), joined.phases.end(),
                          [](const ProbePhase& phase) { return phase.kind == ProbePhaseKind::turn; }));
  expect_right(p, joined);
}

}  // namespace
}  // namespace bahnwerk
