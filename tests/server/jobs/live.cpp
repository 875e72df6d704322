#include "server/jobs/live.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

api::Job running(const std::string& id, int attempt, std::uint64_t revision) {
  api::Job job;
  job.id = id, job.attempt = attempt, job.token = attempt, job.revision = revision;
  job.state = api::JobState::running;
  return job;
}

TEST(LiveJobs, CurrentProgressReplacesWhatTheStoreKnows) {
  LiveJobs jobs;
  const auto live = jobs.add(running("a", 2, 7));
  live->publish(0.5, "motion", "half");
  live->publish(0.75, "verify", "");
  api::Job job = running("a", 2, 8);
  jobs.overlay(job);
  EXPECT_EQ(job.fraction, 0.75);
  EXPECT_EQ(job.stage, "verify");
  EXPECT_EQ(job.message, "");
  EXPECT_EQ(job.revision, 9u);
  EXPECT_EQ(job.state_revision, 7u) << "it has run since it was claimed";
  job.revision = 20;
  jobs.overlay(job);
  EXPECT_EQ(job.revision, 20u) << "a revision never falls";
}

TEST(LiveJobs, RevisionsPassTheOnesThatTheStoreHasRaised) {
  LiveJobs jobs;
  const auto live = jobs.add(running("a", 2, 7));
  live->publish(0.5, "motion", "half");
  const Progressed told = live->progressed();
  EXPECT_EQ(told.attempt, (Attempt{"a", 2}));
  EXPECT_EQ(told.fraction, 0.5);
  EXPECT_EQ(told.stage, "motion");
  EXPECT_EQ(told.message, "half");
  EXPECT_EQ(told.revision, 8u);
  live->publish(0.6, "motion", "");
  live->raise_above(8, told.revision);
  EXPECT_EQ(live->revision(), 9u) << "it was stored as told";
  live->raise_above(1000, told.revision);
  EXPECT_EQ(live->revision(), 1001u) << "1000 is that of older progress";
  live->publish(0.7, "motion", "");
  EXPECT_EQ(live->revision(), 1002u);
}

TEST(LiveJobs, OtherAttemptsStatesAndJobsStayAsTheyAre) {
  LiveJobs jobs;
  jobs.add(running("a", 2, 7))->publish(0.5, "motion", "");
  api::Job later = running("a", 3, 9), ended = running("a", 2, 9), other = running("b", 2, 9);
  ended.state = api::JobState::failed;
  for (api::Job* job : {&later, &ended, &other}) {
    jobs.overlay(*job);
    EXPECT_EQ(job->fraction, 0);
    EXPECT_EQ(job->revision, 9u);
  }
}

TEST(LiveJobs, TheEndOfAnEarlierAttemptDoesNotRemoveALaterOne) {
  LiveJobs jobs;
  const auto first = jobs.add(running("a", 1, 1)), second = jobs.add(running("a", 2, 3));
  jobs.remove(*first);
  EXPECT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs.all().front(), second);
  jobs.remove(*second);
  EXPECT_EQ(jobs.size(), 0u);
}

TEST(LiveJobs, OneJobIsCancelledAllAreInterrupted) {
  LiveJobs jobs;
  const auto a = jobs.add(running("a", 1, 1)), b = jobs.add(running("b", 1, 1));
  jobs.cancel("b");
  jobs.cancel("c");
  EXPECT_FALSE(a->cancel);
  EXPECT_TRUE(b->cancel);
  EXPECT_FALSE(a->interrupt || b->interrupt);
  jobs.interrupt_all();
  EXPECT_TRUE(a->interrupt && b->interrupt);
}

}  // namespace
}  // namespace bahnwerk::server
