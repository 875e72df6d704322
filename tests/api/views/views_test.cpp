#include "api/views/views.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

TEST(ViewsTest, EveryRowOfASeriesWithoutViewsIsReadOnceInOrder) {
  for (const std::size_t count : {0U, 1U, 4096U, 4097U, 10000U}) {
    std::size_t next = 0;
    make_views(
        {{{"x", "mm"}}, count, 0.001}, [](const ViewPart&) {},
        [&](std::size_t first, std::size_t rows, std::vector<double>& out) {
          EXPECT_EQ(first, next);
          next += rows;
          out.assign(rows, 1.0);
        });
    EXPECT_EQ(next, count);
  }
}

}  // namespace
}  // namespace bahnwerk::api
