#include "core/contour/blend/reversed_run.hpp"

#include <gtest/gtest.h>

#include "core/contour/blend/smooth_scale.hpp"
#include "core/contour/builder.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::blending {
namespace {

/// A line, a quarter of a circle and a line; `backwards` from the other end.
struct Hook {
  explicit Hook(bool backwards) {
    ContourBuilder b(2, backwards ? Vec{14, 30, 0} : Vec{0, 0, 0});
    if (backwards) b.line({14, 4, 0});
    if (!backwards) b.line({10, 0, 0});
    backwards ? b.arc({10, 0, 0}, {10, 4, 0}, false) : b.arc({14, 4, 0}, {10, 4, 0}, true);
    b.line(backwards ? Vec{0, 0, 0} : Vec{14, 30, 0});
    contour = b.finish();
    stretch = element_runs(contour.path, 0, 3, {0, 0, 0}, {1e-6, 4.0}, silent_scope()).front();
  }
  Contour contour;
  ElementRun stretch;
};

TEST(ReversedRun, ItsPlacesAreThoseOfTheRunFromItsEnd) {
  const Hook hook(false);
  const double length = hook.stretch.length();
  const ReversedRun turned(hook.stretch, {3, length - 5, true, false});
  EXPECT_NEAR(turned.range().a, 5, 1e-12);
  EXPECT_NEAR(turned.range().b, length - 3, 1e-12);
  for (double t = 0; t <= length; t += 0.37)
    EXPECT_LE(norm(point_of(turned.stretch(), t) - point_of(hook.stretch, length - t)), 1e-9) << t;
}

TEST(ReversedRun, BreaksComeBackInTheGivenDirection) {
  const Hook hook(false);
  const double length = hook.stretch.length();
  const ReversedRun turned(hook.stretch, {0, length, false, false});
  SmoothedRun run;
  run.breaks = {0, 4, 9, length};
  run.failure_positions = {1, 6};
  const SmoothedRun given = turned.turned_back(run);
  ASSERT_EQ(given.breaks.size(), 4u);
  EXPECT_EQ(given.breaks[0], 0);
  EXPECT_NEAR(given.breaks[1], length - 9, 1e-12);
  EXPECT_NEAR(given.breaks[2], length - 4, 1e-12);
  EXPECT_EQ(given.breaks[3], length);
  EXPECT_NEAR(given.failure_positions[0], length - 6, 1e-12);
}

}  // namespace
}  // namespace bahnwerk::blending
