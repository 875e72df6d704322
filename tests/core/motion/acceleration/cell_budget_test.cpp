#include "core/motion/acceleration/cell_budget.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/contour/builder.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

/// A line, `circles` half circles of radius 5 mm, a line.
Contour half_circles(int circles) {
  ContourBuilder b(2, {});
  b.line({10, 0, 0});
  for (int i = 0; i < circles; ++i) {
    const double x = 10 + 10.0 * i;
    b.arc({x + 10, 0, 0}, {x + 5, 0, 0}, i % 2 == 0);
  }
  b.line({20 + 10.0 * circles, 0, 0});
  return b.finish();
}

CellBudget budget(const Contour& contour, const AccelerationLimitedOptions& options) {
  SilentProgress silent;
  ProgressScope scope(silent, "planning", 0, 1);
  const Machine machine = testing::two_axes();
  const CartesianAxisPath axes(contour.path, 2);
  const LanePath<2> path(axes);
  return cell_budget(path, path.limits(machine), contour.feeds(), options, scope);
}

TEST(CellBudget, CountsCurvedSegmentsAndTheirTurn) {
  AccelerationLimitedOptions options;
  options.grid.angle = 0.01;
  const CellBudget got = budget(half_circles(3), options);
  ASSERT_EQ(got.segments.size(), 5u);
  EXPECT_EQ(got.segments[0].curved, 0);
  EXPECT_EQ(got.segments[0].turn, 0);
  EXPECT_EQ(got.segments[1].curved, 1);
  EXPECT_NEAR(got.segments[1].turn, M_PI, 1e-9);
  EXPECT_EQ(got.all.curved, 3);
  EXPECT_NEAR(got.all.turn, 3 * M_PI, 1e-9);
  EXPECT_EQ(got.density, 1);
  EXPECT_EQ(got.cells(0), 1) << "a straight segment is one cell";
  EXPECT_NEAR(got.cells(1), 1 + M_PI / 0.01, 1e-6);
  EXPECT_NEAR(got.cells(), 5 + 3 + 3 * M_PI / 0.01, 1e-6);
}

TEST(CellBudget, UsualPathsKeepTheirOptions) {
  const AccelerationLimitedOptions options;
  const CellBudget got = budget(half_circles(3), options);
  EXPECT_EQ(got.options.grid.angle, options.grid.angle);
  EXPECT_EQ(got.options.grid.hermite, options.grid.hermite);
  EXPECT_EQ(got.options.tolerance, options.tolerance);
  EXPECT_EQ(got.options.max_divisions, options.max_divisions);
  EXPECT_EQ(got.options.excess, options.excess);
  EXPECT_EQ(got.model_error, 0);
}

TEST(CellBudget, WiderCellsScaleTheirToleranceAndAreDividedLess) {
  AccelerationLimitedOptions options;
  options.width = 3;
  const CellBudget three = budget(half_circles(3), options);
  EXPECT_DOUBLE_EQ(three.options.grid.angle, 3 * options.grid.angle);
  EXPECT_DOUBLE_EQ(three.options.grid.hermite, 81 * options.grid.hermite);
  EXPECT_DOUBLE_EQ(three.options.tolerance, 9 * options.tolerance);
  EXPECT_LT(three.options.max_divisions, options.max_divisions);
  EXPECT_GT(three.options.max_rounds, options.max_rounds);
  EXPECT_GT(three.options.excess, options.excess);
  EXPECT_GT(three.model_error, 0);
  options.width = 6;
  const CellBudget six = budget(half_circles(3), options);
  EXPECT_LT(six.options.max_divisions, three.options.max_divisions);
  EXPECT_GE(six.model_error, three.model_error);
}

TEST(CellBudget, TheWidthFollowsFromTheNumberOfCellsUpToTen) {
  const AccelerationLimitedOptions usual;
  const double count = budget(half_circles(20), usual).all.count(usual.grid.angle);
  AccelerationLimitedOptions few;
  few.usual_cells = count / 2.5;
  EXPECT_NEAR(budget(half_circles(20), few).options.grid.angle,
              2.5 * few.grid.angle * budget(half_circles(20), few).density, 1e-9);
  few.usual_cells = 1;
  EXPECT_DOUBLE_EQ(budget(half_circles(20), few).options.grid.angle, 10 * few.grid.angle);
}

TEST(CellBudget, RefusesAPathThatTurnsTooMuch) {
  ContourBuilder b(2, {});
  for (int i = 0; i < 30'000; ++i) b.arc({}, {5, 0, 0}, true);  // 2π each: 188 496 rad
  const Contour contour = b.finish();
  try {
    budget(contour, {});
    FAIL();
  } catch (const InvalidInput& e) {
    ASSERT_EQ(e.faults.size(), 1u);
    EXPECT_EQ(e.faults[0].place, std::vector<std::string>{"contour"});
  }
}

}  // namespace
}  // namespace bahnwerk
