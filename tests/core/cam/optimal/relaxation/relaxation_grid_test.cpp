#include "core/cam/optimal/relaxation/relaxation_grid.hpp"

#include <gtest/gtest.h>

#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

using testing::fixed;
using testing::point_at;

/// Four points, three sections, one time unit each.
LawTask task_of(int continuity, ClassicalLaw* law) {
  MotionLawProblem problem = testing::rest_to_rest(30, 0.3);
  problem.points.insert(problem.points.begin() + 1, point_at(30, {fixed(5)}, continuity));
  problem.points.insert(problem.points.begin() + 2, point_at(60, {fixed(20)}, continuity));
  if (law) problem.points[1].law = *law;
  return make_law_task(problem);
}

TEST(RelaxationGrid, CellsCoverTheCycle) {
  const LawTask task = task_of(2, nullptr);
  const RelaxationGrid grid = lay_grid(task, task.at, 30);
  EXPECT_EQ(grid.cells.size(), 30u);
  double covered = 0;
  for (const RelaxationCell& cell : grid.cells) {
    covered += grid.nodes[cell.left + 1].time - grid.nodes[cell.left].time;
    EXPECT_EQ(cell.smooth, 2);
    EXPECT_EQ(cell.section, static_cast<std::size_t>(grid.nodes[cell.left].time + 1e-9));
  }
  EXPECT_NEAR(covered, 3, 1e-12);
  for (const RelaxationNode& node : grid.nodes) EXPECT_TRUE(node.used);
  EXPECT_TRUE(grid.nodes.back().before);
  EXPECT_FALSE(grid.closing(grid.nodes.size() - 1));
}

TEST(RelaxationGrid, AJumpHasTwoNodesThatShareWhatIsContinuous) {
  const LawTask task = task_of(1, nullptr);
  const RelaxationGrid grid = lay_grid(task, task.at, 12);
  int jumps = 0;
  for (std::size_t i = 1; i < grid.nodes.size(); ++i)
    if (grid.nodes[i].time == grid.nodes[i - 1].time) {
      EXPECT_TRUE(grid.nodes[i - 1].before);
      EXPECT_EQ(grid.nodes[i].joined, 2);
      ++jumps;
    }
  EXPECT_EQ(jumps, 2);
}

TEST(RelaxationGrid, AGivenSectionHasNoCells) {
  ClassicalLaw law = ClassicalLaw::quadratic;
  const LawTask task = task_of(1, &law);
  const RelaxationGrid grid = lay_grid(task, task.at, 12);
  EXPECT_EQ(grid.cells.size(), 12u);  // all of them in the other sections
  for (const RelaxationCell& cell : grid.cells) EXPECT_NE(cell.section, 1u);
}

/// Points that may be at one place: nodes there share what both of them leave continuous.
TEST(RelaxationGrid, PointsWithOneMiddleAreOnePlace) {
  LawTask task = task_of(2, nullptr);
  task.continuity[1] = 1;
  std::vector<Range> at = task.at;
  at[1] = {0.5, 2.5};
  at[2] = {0.5, 2.5};
  const RelaxationGrid grid = lay_grid(task, at, 12);
  for (const RelaxationCell& cell : grid.cells) EXPECT_GT(grid.nodes[cell.left + 1].time, grid.nodes[cell.left].time);
  int joined = 0;
  for (const RelaxationNode& node : grid.nodes) joined += node.joined;
  EXPECT_EQ(joined, 2);
}

}  // namespace
}  // namespace bahnwerk::cam
