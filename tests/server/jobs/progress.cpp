#include "server/jobs/progress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;
using Stop = JobProgress::Stop;

/// A planner's time runs only when the test says so.
struct ProgressTest : testing::Test {
  api::Job job = [] {
    api::Job made;
    made.id = "j";
    made.state = api::JobState::running;
    made.attempt = 1;
    made.token = 1;
    made.revision = 10;
    return made;
  }();
  std::shared_ptr<LiveJob> live = std::make_shared<LiveJob>(job);
  JobProgress::Clock::time_point now{1000s};
  std::int64_t wall = 5000;
  int published = 0;
  std::optional<std::chrono::milliseconds> most;

  JobProgress make() {
    return JobProgress(
        job, live, most,
        {.publish = [this] { ++published; }, .now_ms = [this] { return wall; }, .now = [this] { return now; }});
  }
};

TEST_F(ProgressTest, PublishesSeldom) {
  JobProgress progress = make();
  for (int i = 0; i < 10'000; ++i) {  // 10 s of a planner that reports every millisecond
    now += 1ms;
    progress.report("grid", i / 10'000.0);
  }
  EXPECT_NEAR(published, 100, 2);
  api::Job seen = job;
  live->overlay(seen);
  EXPECT_EQ(seen.stage, "grid");
  EXPECT_GT(seen.fraction, 0.98);
  EXPECT_EQ(seen.revision, 10U + static_cast<unsigned>(published));
}

TEST_F(ProgressTest, NoBudgetExceedsThatOfTheServer) {
  most = 600s;
  for (const std::optional<double> own : {std::optional<double>(), std::optional(700.0), std::optional(50.0)}) {
    job.request.time_budget = own;
    JobProgress progress = make();
    const auto allowed = own == 50.0 ? 50s : 600s;
    now += allowed - 1ms;
    EXPECT_NO_THROW(progress.report("grid", 0));
    now += 1ms;
    EXPECT_NO_THROW(progress.report("storing", 0)) << "storing is no planning";
    EXPECT_THROW(progress.report("grid", 0), Stopped);
    EXPECT_EQ(progress.stopped(), Stop::budget);
  }
}

TEST_F(ProgressTest, NeverRunsBackwards) {
  JobProgress progress = make();
  for (const double fraction : {0.5, 0.2, std::nan(""), -1.0, 7.0, 0.1}) {
    now += 1s;
    progress.report("x", fraction);
    api::Job seen = job;
    live->overlay(seen);
    EXPECT_EQ(seen.fraction, fraction > 1 || seen.fraction == 1 ? 1 : 0.5);
  }
}

TEST_F(ProgressTest, StopsAtOnceOnCancel) {
  JobProgress progress = make();
  progress.report("x", 0);
  live->cancel = true;
  EXPECT_THROW(progress.report("x", 0), Stopped);
  EXPECT_EQ(progress.stopped(), Stop::cancelled);
  EXPECT_EQ(progress.reports(), 2U);
  EXPECT_EQ(progress.reports_after_stop(), 0U);
  EXPECT_THROW(progress.report("x", 0), Stopped);
  EXPECT_EQ(progress.reports_after_stop(), 1U) << "a planner that went on";
}

TEST_F(ProgressTest, StopsForTheEndOfService) {
  JobProgress progress = make();
  live->interrupt = true;
  EXPECT_THROW(progress.report("x", 0), Stopped);
  EXPECT_EQ(progress.stopped(), Stop::interrupted);
}

TEST_F(ProgressTest, HoldsTheDeadline) {
  job.request.deadline = 6000;
  JobProgress progress = make();
  wall = 5999;
  EXPECT_NO_THROW(progress.report("x", 0));
  wall = 6000;
  try {
    progress.report("x", 0);
    FAIL();
  } catch (const Stopped& stopped) {
    EXPECT_EQ(stopped.reason, StopReason::deadline);
  }
}

TEST_F(ProgressTest, HoldsTheBudget) {
  job.request.time_budget = 2.0;
  JobProgress progress = make();
  now += 1999ms;
  EXPECT_NO_THROW(progress.report("x", 0));
  now += 1ms;
  try {
    progress.report("x", 0);
    FAIL();
  } catch (const Stopped& stopped) {
    EXPECT_EQ(stopped.reason, StopReason::budget);
  }
}

TEST(LiveJob, CoversOnlyItsOwnAttempt) {
  api::Job job;
  job.id = "j";
  job.state = api::JobState::running;
  job.attempt = 2;
  job.token = 5;
  LiveJob live(job);
  live.publish(0.7, "grid", "");
  api::Job other = job;
  other.token = 6;  // put back and claimed again: the attempt's number is the same
  live.overlay(other);
  EXPECT_EQ(other.fraction, 0);
  other = job;
  other.state = api::JobState::succeeded;
  live.overlay(other);
  EXPECT_EQ(other.fraction, 0);
  live.overlay(job);
  EXPECT_EQ(job.fraction, 0.7);
}

}  // namespace
}  // namespace bahnwerk::server
