#include "core/redundant/iterative/head_sections.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/iterative/small_contours.hpp"

namespace bahnwerk {
namespace {

class HeadSectionsTest : public ::testing::Test {
 protected:
  RedundancyTask task_ = test::redundancy_task(test::small_contours(2, 2), test::md2());
  RedundancyOptions options_;
  Machine machine_ = summed(task_.machine);
  Progress progress_;
};

TEST_F(HeadSectionsTest, TogetherAreTheWholeLaw) {
  const HeadSections s(task_, options_, machine_, task_.feeds, progress_);
  EXPECT_EQ(s.begin(0), 0u);
  EXPECT_EQ(s.begin(s.size()), task_.path->size());
  double sum = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    sum += s.law(i, i + 1).duration();
    EXPECT_EQ(s.section_of(s.begin(i)), i);
    EXPECT_EQ(s.section_of(s.begin(i + 1) - 1), i);
  }
  EXPECT_NEAR(s.law(0, s.size()).duration(), sum, 1e-12);
}

TEST_F(HeadSectionsTest, PlanningOneAgainLeavesTheOthersAlone) {
  HeadSections s(task_, options_, machine_, task_.feeds, progress_);
  std::vector<double> before;
  for (std::size_t i = 0; i < s.size(); ++i) before.push_back(s.law(i, i + 1).duration());
  const std::size_t one = s.size() / 2;
  s.replan(one, machine_, task_.feeds);
  EXPECT_NEAR(s.law(one, one + 1).duration(), before[one], 1e-9 * before[one]);
  Machine slow = machine_;
  for (AxisLimits& axis : slow.axes) axis.acceleration /= 10;
  s.replan(one, slow, task_.feeds);
  EXPECT_GT(s.law(one, one + 1).duration(), 1.05 * before[one]);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (i != one) {
      EXPECT_EQ(s.law(i, i + 1).duration(), before[i]);
    }
  }
  // Places go on along the path.
  const TimeLaw law = s.law(0, s.size());
  for (std::size_t i = 1; i < law.pieces().size(); ++i)
    EXPECT_NEAR(law.pieces()[i].s, law.pieces()[i - 1].s_end, 1e-12);
  EXPECT_EQ(law.pieces().back().s_end, task_.path->length());
}

TEST_F(HeadSectionsTest, HasSomePiecesPerCycleOnly) {
  task_.machine.cycle_time = 1e-5;  // so short that cells are as usual
  const TimeLaw fine = HeadSections(task_, options_, machine_, task_.feeds, progress_).law(1, 2);
  task_.machine.cycle_time = 1e-2;
  HeadSections s(task_, options_, machine_, task_.feeds, progress_);
  const TimeLaw wide = s.law(1, 2);
  EXPECT_LT(2 * wide.pieces().size(), fine.pieces().size());
  EXPECT_NEAR(wide.duration(), fine.duration(), 1e-4 * fine.duration());
  s.replan(1, machine_, task_.feeds);
  EXPECT_EQ(s.law(1, 2).pieces().size(), wide.pieces().size());
}

TEST(HeadSections, DwellsAreWhereTheyWere) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, 100);
  b.line({10, 0, 0});
  b.dwell(0.25);
  b.line({10, 10, 0});
  b.dwell(0.5);
  const RedundancyTask task = test::redundancy_task(b.finish(), test::md2());
  Progress progress;
  const RedundancyOptions options;
  const Machine machine = summed(task.machine);
  const HeadSections s(task, options, machine, task.feeds, progress);
  ASSERT_EQ(s.size(), 2u);
  const double first = s.law(0, 1).duration(), second = s.law(1, 2).duration();
  EXPECT_NEAR(second - first, 0.75, 1e-9);
  EXPECT_NEAR(s.law(0, 2).duration(), first + second, 1e-12);
  EXPECT_NEAR(s.duration(0, 1), first, 1e-12);
  EXPECT_NEAR(s.duration(0, 2), first + second, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
