#include "core/numeric/grow.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {
namespace {

struct Counted final : ProgressSink {
  void report(std::string_view, double, std::string_view) override { ++reports; }
  int reports = 0;
};

TEST(Grow, KeepsTheValuesAndReportsWhileItCopies) {
  Counted progress;
  ProgressScope stage_progress(progress, "planning");
  UnsetVector<double> values(1'000'000);
  std::iota(values.begin(), values.end(), 0.0);
  const std::size_t more = values.capacity() + 1;
  grow(values, more, stage_progress);
  EXPECT_GE(values.capacity(), more);
  EXPECT_GT(progress.reports, 50);
  ASSERT_EQ(values.size(), 1'000'000u);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], static_cast<double>(i));
}

TEST(Grow, DoesNothingWhereThereIsRoom) {
  Counted progress;
  ProgressScope stage_progress(progress, "planning");
  std::vector<int> values{1, 2, 3};
  values.reserve(10);
  const int* const at = values.data();
  grow(values, 10, stage_progress);
  EXPECT_EQ(values.data(), at);
  EXPECT_EQ(progress.reports, 0);
}

}  // namespace
}  // namespace bahnwerk
