// The bound that knows long moves together, against plans: a motion that keeps all limits is never shorter, wherever
// the bound is told to look.
#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/plan/coarse_fine/coarse_fine_plan.hpp"
#include "core/plan/contour/section_gaps.hpp"
#include "core/verify/redundant/stroke_bound.hpp"
#include "core/verify/redundant/stroke_chains.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

TEST(ChainBound, NoPlanIsShorterWhereverItLooks) {
  Random random(17);
  Progress progress;
  int gained = 0;
  for (int i = 0; i < 16; ++i) {
    CoarseFineMachine machine = i % 2 == 0 ? test::md1() : test::md2();
    if (i % 3 == 0)
      for (CoarseFineAxis& axis : machine.axes) axis.stroke = random.uniform(5, 40);
    RedundancyOptions options;
    options.compare = false;
    const CoarseFinePlan plan = plan_coarse_fine(test::random_contour(random, 300), machine, {}, options, progress);
    const CartesianAxisPath path(plan.contour.path->path, 2);
    const Machine head{head_limits(machine)};
    const PathTask task = contour_task(path, *plan.contour.path, head);
    const std::vector<AxisLimits> coarse = coarse_limits(machine), fine = fine_limits(machine);
    std::vector<SectionBound> sections;
    lower_bound(task, ContourPlanning{}.corner_angle, progress, &sections);
    raise_by_stroke({task, coarse, fine}, sections, progress);
    double single = 0;
    for (const SectionBound& s : sections) single += s.duration;
    std::vector<double> times = section_times(plan.head->law(), 1, sections);
    for (const double longer : {1.0, 1.05, 1.3}) {
      std::vector<double> planned = times;
      for (double& t : planned) t *= longer;
      const double gain = gain_of_chains({task, coarse, fine}, sections, planned, progress);
      EXPECT_LE(single + gain, plan.contour.duration) << i << ' ' << longer;
      gained += gain > 0;
    }
  }
  EXPECT_GT(gained, 10);
}

}  // namespace
}  // namespace bahnwerk
