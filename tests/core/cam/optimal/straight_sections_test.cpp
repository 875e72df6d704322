/// Dwells and synchronous sections in a law that is otherwise optimal.
#include "core/cam/optimal/straight_sections.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/optimal/optimal_law.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

/// 0 … 12 mm, 12 … 24 mm at 60 mm/s over 72 deg in 0.2 s, a dwell at 30 mm, back.
MotionLawProblem packing_cam() {
  MotionLawProblem problem;
  problem.method = LawMethod::optimal;
  problem.periodic = true;
  problem.length = 360;
  problem.cycle_duration = 1;
  problem.objective.weight = {0, 1, 0.1, 0.01};
  for (const auto& [at, position] : {std::pair{0, 0}, {72, 12}, {144, 24}, {200, 30}, {260, 30}})
    problem.points.push_back(testing::point_at(at, {testing::fixed(position)}));
  problem.points[1].law = problem.points[3].law = ClassicalLaw::straight;
  problem.degree = 7;
  return problem;
}

TEST(StraightSections, AreStraightInAnOptimalLaw) {
  SilentProgress progress;
  const MotionLawProblem problem = packing_cam();
  const OptimalLaw found = plan_optimal_law(problem, progress);
  EXPECT_TRUE(found.proven);
  for (const auto& [section, velocity] : {std::pair{1, 60.0}, {3, 0.0}}) {
    const LawExtremes v = found.solution.law.section_extremes(1, static_cast<std::size_t>(section));
    EXPECT_NEAR(v.lowest.value, velocity, 1e-6);
    EXPECT_NEAR(v.highest.value, velocity, 1e-6);
  }
  EXPECT_LE(found.solution.bound->objective, found.solution.value.objective);
  MotionLawProblem free = problem;
  for (MotionPoint& point : free.points) point.law.reset();
  EXPECT_LE(plan_optimal_law(free, progress).solution.value.objective, found.solution.value.objective * (1 + 1e-8));
}

TEST(StraightSections, ARefusalNamesEveryLawThatIsInTheWay) {
  MotionLawProblem problem = packing_cam();
  problem.points[0].law = ClassicalLaw::modified_sine;
  problem.points[4].law = ClassicalLaw::quadratic;
  problem.points[2].values[0] = {23, 24};
  problem.points[3].section[1] = {0.5, 1};
  try {
    with_straight_sections(problem);
    FAIL();
  } catch (const InvalidInput& fault) {
    ASSERT_EQ(fault.faults.size(), 4u);
    EXPECT_EQ(fault.faults[0].place, (std::vector<std::string>{"points", "0", "law"}));
    EXPECT_EQ(fault.faults[1].place, (std::vector<std::string>{"points", "1", "law"}));
    EXPECT_EQ(fault.faults[2].place, (std::vector<std::string>{"points", "3", "section", "velocity"}));
    EXPECT_EQ(fault.faults[3].place, (std::vector<std::string>{"points", "4", "law"}));
  }
}

}  // namespace
}  // namespace bahnwerk::cam
