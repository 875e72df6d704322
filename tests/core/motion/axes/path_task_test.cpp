#include "core/motion/axes/path_task.hpp"

#include <gtest/gtest.h>

#include "core/contour/builder.hpp"

namespace bahnwerk {
namespace {

Contour with_dwells() {
  ContourBuilder builder(2, {0, 0, 0});
  builder.block(Mode::cut, 50);
  builder.line({10, 0, 0});
  builder.dwell(0.25);
  builder.block(Mode::cut, 80);
  builder.line({10, 10, 0});
  builder.dwell(1.5);
  return builder.finish();
}

TEST(PathTask, HasTheContoursFeedsRestsAndDwells) {
  const Contour contour = with_dwells();
  const CartesianAxisPath path(contour.path, 2);
  Machine machine;
  const PathTask task = contour_task(path, contour, machine);
  EXPECT_EQ(task.feeds, (std::vector<double>{50, 80}));
  EXPECT_EQ(task.rests, (std::vector<bool>{false, true, true}));
  EXPECT_EQ(task.dwells.size(), 2u);
  EXPECT_EQ(task.dwell(), 1.75);
}

TEST(PathTask, TheThirdAxisOfAPlanarContourStaysAtItsHeight) {
  Contour contour = with_dwells();
  contour.height = 7;
  const auto axes = contour_axes(std::make_shared<const Contour>(contour), 3);
  ASSERT_EQ(axes->axes(), 3u);
  const AxisJet q = axes->at(1, 14);
  EXPECT_EQ(q.value[0], 10);
  EXPECT_NEAR(q.value[1], 4, 1e-12);
  EXPECT_EQ(q.value[2], 7);
  EXPECT_EQ(q.d1[2], 0);
}

}  // namespace
}  // namespace bahnwerk
