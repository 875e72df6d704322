#include "core/cam/problem.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::cam {
namespace {

MotionLawProblem periodic_problem() {
  MotionLawProblem problem;
  problem.periodic = true, problem.length = 360, problem.cycle_duration = 0.5;
  problem.points.resize(3);
  const double at[] = {10, 100, 220};
  for (std::size_t i = 0; i < 3; ++i) problem.points[i].at = {at[i], at[i]}, problem.points[i].continuity = 2;
  problem.points[0].values = {{0, 1}}, problem.points[1].values = {{}, {}, {}, {}, {-1, 1}};
  problem.points[2].values = {{5, 6}};
  return problem;
}

TEST(MotionLawProblem, ContinuityReachesTheHighestOrderThatIsGiven) {
  const auto problem = periodic_problem();
  EXPECT_EQ(problem.continuity(0), 2);
  EXPECT_EQ(problem.continuity(1), 4);
}

TEST(MotionLawProblem, SectionsOfAPeriodicLawCloseTheCycle) {
  const auto problem = periodic_problem();
  EXPECT_EQ(problem.sections(), 3u);
  EXPECT_EQ(problem.end_point(2), 0u);
  const auto times = section_times(problem, {10, 100, 220});
  ASSERT_EQ(times.size(), 4u);
  EXPECT_DOUBLE_EQ(times[0], 10 / 720.0);
  EXPECT_DOUBLE_EQ(times[3] - times[0], 0.5);
}

TEST(MotionLawProblem, StrokeOfPointsIsWhatTheirRangesForce) { EXPECT_EQ(periodic_problem().points_stroke(), 4); }

TEST(MotionLawProblem, SectionsWithAWeightAreGroupsOfTheirOwn) {
  auto problem = periodic_problem();
  EXPECT_EQ(problem.peak_groups().of_section, (std::vector<std::size_t>{0, 0, 0}));
  EXPECT_EQ(problem.peak_groups().weight, std::vector<double>{1});
  problem.points[1].weight = 3;
  EXPECT_EQ(problem.peak_groups().of_section, (std::vector<std::size_t>{0, 1, 0}));
  EXPECT_EQ(problem.peak_groups().weight, (std::vector<double>{1, 3}));
  EXPECT_EQ(problem.peak_groups().least_weight(), 1);
  problem.points[0].weight = problem.points[2].weight = 0.5;
  EXPECT_EQ(problem.peak_groups().of_section, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(problem.peak_groups().weight, (std::vector<double>{0.5, 3, 0.5}));
}

}  // namespace
}  // namespace bahnwerk::cam
