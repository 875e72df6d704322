#include "core/redundant/iterative/iterative.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/redundant/chosen_plan.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/frames.hpp"
#include "tests/core/redundant/iterative/iterative_plans.hpp"
#include "tests/core/redundant/iterative/small_contours.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid_split, test::plan_by_iterations;

/// [Bock Table 4.1]: with the quadratic program 7.394 s against 7.373 s of the first iteration, at most.
TEST(Iterative, TheQuadraticProgramHardlyLosesAnythingOnSmallContours) {
  const RedundancyTask task = test::redundancy_task(test::small_contours(), test::md2());
  const RedundancyResult r = plan_by_iterations(task, {});
  expect_valid_split(task, r);
  EXPECT_LE(r.head->duration(), 1.003 * r.fastest);
  EXPECT_GE(r.head->duration(), r.fastest - 1e-12);
  ASSERT_EQ(r.passes.size(), r.iterations);
  EXPECT_NEAR(r.passes.front().duration, r.fastest, 1e-12);
  EXPECT_GT(r.passes.front().violated_blocks, 0u);
  EXPECT_EQ(r.passes.back().violated_blocks, 0u);
  for (std::size_t i = 1; i < r.passes.size(); ++i) EXPECT_GE(r.passes[i].duration, r.passes[i - 1].duration - 1e-9);
  for (const RedundancyPeaks& p : r.passes.back().peaks) EXPECT_LE(p.coarse_acceleration, 16000);
}

TEST(Iterative, SimpleKnotsOfDegreeFourLimitTheCoarseJerk) {
  const RedundancyTask task = test::redundancy_task(test::small_contours(2, 2), test::md2());
  RedundancyOptions o;
  for (const auto& [degree, multiplicity, limited] :
       {std::tuple{2, 1, false}, {3, 1, true}, {3, 2, false}, {4, 1, true}}) {
    o.degree = degree;
    o.knot_multiplicity = multiplicity;
    EXPECT_EQ(plan_by_iterations(task, o).coarse_jerk_limited, limited);
  }
}

/// Nearly every pair of methods, whole and in windows, ends in a split, which holds all limits.
TEST(Iterative, RandomContoursEndValidWithEveryMethod) {
  Random random(21);
  std::size_t own = 0, all = 0;
  for (int i = 0; i < 3; ++i) {
    const RedundancyTask task =
        test::redundancy_task(test::random_contour(random, i == 0 ? 400 : 100), i % 2 == 0 ? test::md2() : test::md1());
    RedundancyOptions o;
    o.degree = 2 + i;
    for (const auto& approximation : coarse_approximations)
      for (const auto& smoothing : coarse_smoothings)
        for (const bool windows : {false, true}) {
          SCOPED_TRACE(std::to_string(i) + approximation.name + smoothing.name + std::to_string(windows));
          o.approximation = approximation.value;
          o.smoothing = smoothing.value;
          o.window.reset();
          if (windows) o.window = RedundancyOptions::Window{6, 2};
          Progress progress;
          const Expected<RedundancyResult, NoPlan> r = plan_iterative(task, o, progress);
          ++all;
          if (!r) continue;
          ++own;
          expect_valid_split(task, *r);
        }
  }
  EXPECT_GE(own, all - all / 4);
}

TEST(Iterative, LimitedJerkIsHeldToo) {
  Random random(22);
  for (const double longest : {30.0, 60.0}) {
    CoarseFineMachine machine = test::md2();
    for (CoarseFineAxis& axis : machine.axes) axis.coarse.jerk = 4e6, axis.fine.jerk = 2e7;
    const RedundancyTask task = test::redundancy_task(test::random_contour(random, longest), machine);
    RedundancyOptions o;
    o.degree = 4;
    const RedundancyResult r = plan_by_iterations(task, o);
    expect_valid_split(task, r);
    EXPECT_TRUE(r.coarse_jerk_limited);
    o.degree = 3;
    o.knot_multiplicity = 2;
    EXPECT_THROW(plan_by_iterations(task, o), InvalidInput);
  }
}

TEST(Iterative, HasNoPlanAfterNoIteration) {
  const RedundancyTask task = test::redundancy_task(test::slot(1, 0.5, 500), test::md2());
  IterativeOptions none;
  none.max_iterations = 0;
  Progress progress;
  const Expected<RedundancyResult, NoPlan> r = plan_iterative(task, {}, none, progress);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.reason(), NoPlan::no_split);
}

/// In half of a cycle of 1 ms 80 000 mm/s² move a fine axis by 0.01 mm, half of its stroke: fits would have nothing
/// left of it. More of an acceleration that no sample resolves is not slower.
TEST(Iterative, MoreFineAccelerationThanSamplesResolveIsNotSlower) {
  double before = 0;
  for (const double acceleration : {70000.0, 80000.0, 200000.0}) {
    CoarseFineMachine machine = test::md2();
    for (CoarseFineAxis& axis : machine.axes)
      axis.stroke = 0.02, axis.fine.acceleration = acceleration, axis.centred = true;
    RedundancyOptions options;
    options.method = RedundancyMethod::iterative;
    const RedundancyTask task = test::redundancy_task(test::holes(2, 1, 0.3, 0.05), machine);
    const RedundancyResult r = test::chosen(task, options);  // in either direction
    expect_valid_split(task, r);
    if (before > 0) {
      EXPECT_LE(r.head->duration(), before * (1 + 1e-6)) << acceleration;
    }
    before = r.head->duration();
  }
}

TEST(Iterative, WindowsAreJoinedInMotion) {
  const RedundancyTask task = test::redundancy_task(test::small_contours(7, 2), test::md2());
  RedundancyOptions o;
  const double whole = plan_by_iterations(task, o).head->duration();
  o.window = RedundancyOptions::Window{20, 5};
  const RedundancyResult r = plan_by_iterations(task, o);
  expect_valid_split(task, r);
  EXPECT_LE(r.head->duration(), 1.01 * whole);
  // Somewhere the head rests while the coarse axes go on.
  bool moving = false;
  std::size_t piece = 0;
  for (const LawPiece& p : r.head->law().pieces())
    if (p.v == 0 && p.t0 > 0) moving = moving || std::abs(r.coarse->evaluate(p.t0, piece)[1][0]) > 1;
  EXPECT_TRUE(moving);
}

TEST(Iterative, ThinnedSamplesKeepTheStroke) {
  const RedundancyTask task = test::redundancy_task(test::small_contours(3, 3), test::md2());
  RedundancyOptions o;
  for (const int thinning : {2, 5, 10}) {
    o.thinning = thinning;
    const RedundancyResult r = plan_by_iterations(task, o);
    expect_valid_split(task, r);
  }
  o.thinning = 100;  // 0.1 s apart: the fine axis could be anywhere in between
  EXPECT_THROW(plan_by_iterations(task, o), InvalidInput);
}

/// With the first multipliers of its programs far from where they end, rounding decided by 5 % of a duration.
TEST(Iterative, ThePlanDoesNotDependOnTheFrame) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const auto& smoothing : coarse_smoothings) {
      SCOPED_TRACE(std::to_string(seed) + smoothing.name);
      RedundancyOptions o;
      o.smoothing = smoothing.value;
      const auto duration = [&](const test::Frame& frame) {
        return plan_by_iterations(test::redundancy_task(test::framed(seed, frame), test::md2()), o).head->duration();
      };
      const double here = duration({});
      for (const test::Frame& frame : test::other_frames) EXPECT_NEAR(duration(frame), here, 1e-9 * here);
    }
}

/// The least squares of a move of two strokes leave three quarters of the stroke unused.
TEST(Iterative, LeastSquaresAloneUseTheStrokeBeforeTheHeadIsSlowed) {
  const RedundancyTask task = test::redundancy_task(test::straight(38, 0, 420), test::md2());
  RedundancyOptions o;
  o.smoothing = CoarseSmoothing::none;
  const RedundancyResult r = plan_by_iterations(task, o);
  expect_valid_split(task, r);
  EXPECT_EQ(r.iterations, 1u);
  EXPECT_NEAR(r.head->duration(), 38.0 / 420 + 420.0 / 60000, 1e-9);
}

TEST(Iterative, RefusesWhatMakesNoSense) {
  const RedundancyTask task = test::redundancy_task(test::straight(10, 0), test::md2());
  const auto refused = [&](auto&& change) {
    RedundancyOptions o;
    change(o);
    EXPECT_THROW(plan_by_iterations(task, o), InvalidInput);
  };
  refused([](RedundancyOptions& o) { o.degree = 1; });
  refused([](RedundancyOptions& o) { o.degree = 6; });
  refused([](RedundancyOptions& o) { o.knot_multiplicity = 3; });
  refused([](RedundancyOptions& o) { o.knot_multiplicity = 0; });
  refused([](RedundancyOptions& o) { o.thinning = 0; });
  refused([](RedundancyOptions& o) { o.afterburner = -1; });
  refused([](RedundancyOptions& o) { o.window = RedundancyOptions::Window{3, 3}; });
}

TEST(Iterative, StopsWhenToldTo) {
  struct Stop final : ProgressSink {
    void report(std::string_view, double, std::string_view) override {
      if (++calls == 40) throw Stopped(StopReason::cancelled);
    }
    int calls = 0;
  } stop;
  const RedundancyTask task = test::redundancy_task(test::small_contours(), test::md2());
  EXPECT_THROW(plan_iterative(task, {}, stop), Stopped);
}

}  // namespace
}  // namespace bahnwerk
