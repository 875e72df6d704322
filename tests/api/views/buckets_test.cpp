#include "api/views/buckets.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "stored.hpp"

namespace bahnwerk::api {
namespace {

TEST(BucketsTest, CoverTheRowsInOrderAndEachHasRows) {
  std::mt19937_64 random(1);
  for (const std::size_t count : test::counts)
    for (int k = 0; k < 200; ++k) {
      const test::Zoom zoom(random, count);
      const auto bounds = bucket_bounds(zoom.first, zoom.rows, zoom.points, count);
      ASSERT_EQ(bounds.front(), zoom.first);
      ASSERT_EQ(bounds.back(), zoom.first + zoom.rows);
      ASSERT_LE(bounds.size(), zoom.points + 1);
      for (std::size_t b = 1; b < bounds.size(); ++b) ASSERT_LT(bounds[b - 1], bounds[b]);
      if (grouped_by_cells(zoom.rows, zoom.points, count)) {
        for (std::size_t b = 1; b + 1 < bounds.size(); ++b) ASSERT_EQ(bounds[b] % cell_rows[0], 0U);
      } else {
        ASSERT_EQ(bounds.size(), std::min(zoom.rows, zoom.points) + 1);
      }
    }
}

TEST(BucketsTest, CellsAndRowsCoverAnIntervalOnceWithFewerThan64RowsAtEitherEnd) {
  std::mt19937_64 random(2);
  for (const std::size_t count : test::counts)
    for (int k = 0; k < 50; ++k) {
      const test::Zoom zoom(random, count);
      std::vector<int> covered(count, 0);
      const auto cover = [&](std::size_t from, std::size_t to) {
        for (std::size_t row = from; row < std::min(to, count); ++row) ++covered[row];
      };
      for_each_cell(
          zoom.first, zoom.first + zoom.rows, count,
          [&](std::size_t level, std::size_t index) {
            ASSERT_LT(level, stored_levels(count));
            cover(index * cell_rows[level], (index + 1) * cell_rows[level]);
          },
          [&](std::size_t from, std::size_t to) {
            ASSERT_TRUE(stored_levels(count) == 0 || to - from < 2 * cell_rows[0]);
            cover(from, to);
          });
      for (std::size_t row = 0; row < count; ++row)
        ASSERT_EQ(covered[row], row >= zoom.first && row < zoom.first + zoom.rows ? 1 : 0) << row << " of " << count;
    }
}

TEST(BucketsTest, AFullIntervalOfMillionsOfRowsTakesFewerThanEightCellsPerPoint) {
  const std::size_t count = 13'000'000;
  const auto bounds = bucket_bounds(0, count, 1000, count);
  std::size_t cells = 0;
  for (std::size_t b = 1; b < bounds.size(); ++b)
    for_each_cell(
        bounds[b - 1], bounds[b], count, [&](std::size_t, std::size_t) { ++cells; },
        [](std::size_t, std::size_t) { FAIL() << "no rows"; });
  EXPECT_LT(cells, 8000U);
}

}  // namespace
}  // namespace bahnwerk::api
