#include "core/motion/law/block_times.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/law/dwell.hpp"

namespace bahnwerk {
namespace {

TEST(BlockTimes, FollowEachOtherWithoutGapsAndHoldTheirDwells) {
  ContourBuilder builder(2, {0, 0, 0});
  builder.block(Mode::cut, 50);
  builder.line({2, 0, 0});
  builder.line({4, 0, 0});
  builder.dwell(0.5);
  builder.block(Mode::position, 50);  // nothing in it
  builder.block(Mode::cut, 50);
  builder.line({4, 6, 0});
  const Contour contour = builder.finish();
  TimeLaw moving;
  moving.append({0, 2, 0, 2, 0, 1, 0, 0});   // to 2 mm/s
  moving.append({0, 2, 2, 4, 2, -1, 0, 1});  // to rest
  moving.append({0, 3, 4, 7, 0, 2.0 / 3, 0, 2});
  moving.append({0, 3, 7, 10, 2, -2.0 / 3, 0, 2});
  const CartesianAxisPath path(contour.path, 2);
  Progress progress;
  const Machine machine;
  const TimeLaw law = with_dwells(moving, contour_task(path, contour, machine), progress);
  const auto times = block_times(contour, law);
  ASSERT_EQ(times.size(), contour.blocks.size());
  EXPECT_EQ(times.front().begin, 0);
  EXPECT_DOUBLE_EQ(times.front().end, 4.5);
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_EQ(times[i].begin, times[i - 1].end);
  EXPECT_DOUBLE_EQ(times.back().end, 10.5);
  EXPECT_EQ(times[1].begin, times[1].end);  // no length, no time
}

}  // namespace
}  // namespace bahnwerk
