#include "core/motion/acceleration/window_solver.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/contour/builder.hpp"
#include "tests/core/motion/same_bits.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

/// A line, two quarters of a circle, a line, without a stop between them.
Contour hook() {
  ContourBuilder b(2, {});
  b.line({20, 0, 0});
  b.arc({24, 4, 0}, {20, 4, 0}, true);
  b.arc({20, 8, 0}, {20, 4, 0}, true);
  b.line({0, 8, 0});
  return b.finish();
}

class WindowSolverTest : public ::testing::Test {
 protected:
  const Contour contour = hook();
  const Machine machine = testing::two_axes();
  const CartesianAxisPath axes{contour.path, 2};
  const LanePath<2> path{axes};
  const Machine lanes = path.limits(machine);
  const std::vector<double> feeds = contour.feeds();
  const AccelerationLimitedOptions options{};
  SilentProgress silent;
  ProgressScope scope{silent, "planning", 0, 1};
  const Sections sections = find_sections(contour_task(axes, contour, machine), options.corner_angle, scope);
  WindowSolver<2> window{path, lanes, options, feeds, sections, 2000};

  TimeLaw law(std::size_t cells) {
    TimeLaw law;
    LawWriter writer(law, contour.path, 1);
    window.write(cells, writer, scope);
    return law;
  }
};

TEST_F(WindowSolverTest, TheLawRunsFromRestToRestWithinTheAllowedExcess) {
  const std::size_t passes = window.solve(0, 4, 0, scope);
  EXPECT_GE(passes, 1u);
  EXPECT_TRUE(window.enters());
  EXPECT_EQ(window.node(0), 0);
  EXPECT_EQ(window.node(window.cells()), 0);
  EXPECT_EQ(window.segment(0), 0u);
  EXPECT_EQ(window.segment(window.cells() - 1), 3u);
  EXPECT_LE(window.excess(window.cells()), 1e-6);
  const TimeLaw whole = law(window.cells());
  EXPECT_EQ(whole.pieces().front().s, 0);
  EXPECT_NEAR(whole.pieces().back().s_end, contour.path.length(), 1e-12);
  EXPECT_NEAR(whole.duration(), plan_acceleration_limited(contour, machine, options, silent).law.duration(),
              1e-9 * whole.duration());
}

TEST_F(WindowSolverTest, TheArcIsPassedAtTheSpeedThatItsAccelerationAllows) {
  window.solve(0, 4, 0, scope);
  double fastest = 0;
  for (std::size_t c = 0; c < window.cells(); ++c)
    if (window.segment(c) == 1 || window.segment(c) == 2) fastest = std::max(fastest, window.node(c));
  EXPECT_LE(fastest, 16000 * 4 * std::sqrt(2.0)) << "v²/r ≤ |a| for two equal axes";
  EXPECT_GT(fastest, 16000 * 4 * 0.99);
}

TEST_F(WindowSolverTest, AnEntrySpeedIsKeptIfTheWindowCanStillStop) {
  window.solve(1, 4, 100 * 100, scope);
  EXPECT_TRUE(window.enters());
  EXPECT_EQ(window.node(0), 100 * 100);
  window.solve(3, 4, 1000 * 1000, scope);  // 20 mm stop at most 800 mm/s
  EXPECT_FALSE(window.enters());
}

TEST_F(WindowSolverTest, TheBorderIsTheLastJointThatIsPassedAtASteadySpeed) {
  const std::vector<double> slow(4, 20.0);  // mm/s: both lines begin or end at rest, both arcs are driven at the feed
  WindowSolver<2> steady(path, lanes, options, slow, sections, 2000);
  steady.solve(0, 4, 0, scope);
  const std::size_t border = steady.border();
  ASSERT_GT(border, 0u);
  EXPECT_EQ(steady.segment(border), 2u);
  EXPECT_EQ(steady.segment(border - 1), 1u);
  EXPECT_NEAR(steady.node(border), 400, 1e-9);
}

TEST_F(WindowSolverTest, ASolverThatIsUsedAgainGivesTheSameBits) {
  window.solve(0, 4, 0, scope);
  const TimeLaw first = law(window.cells());
  window.solve(1, 2, 0, scope);
  window.solve(0, 4, 0, scope);
  testing::expect_same_bits(first, law(window.cells()));
}

}  // namespace
}  // namespace bahnwerk
