#include "server/routes/context.hpp"

#include <gtest/gtest.h>

#include "api/problem.hpp"

namespace bahnwerk::server {
namespace {

Request asking(const std::string& name, const std::string& value) {
  Request request;
  request.headers = {{name, value}};
  return request;
}

TEST(Context, OnlyJsonIsServedWhereNothingElseExists) {
  EXPECT_NO_THROW(require_json({}));
  EXPECT_NO_THROW(require_json(asking("accept", "text/html, application/*;q=0.5")));
  try {
    require_json(asking("accept", "text/csv"));
    ADD_FAILURE() << "accepted";
  } catch (const api::Problem& problem) {
    EXPECT_EQ(problem.type().slug, "not-acceptable");
  }
}

TEST(Context, AJobThatHasEndedIsFinalAndItsTagIsItsRevision) {
  api::Job job;
  for (const auto state : {api::JobState::queued, api::JobState::running}) {
    job.state = state;
    EXPECT_FALSE(final(job));
  }
  for (const auto state : {api::JobState::succeeded, api::JobState::failed, api::JobState::cancelled}) {
    job.state = state;
    EXPECT_TRUE(final(job));
  }
  job.revision = 42;
  EXPECT_EQ(job_etag(job), "\"42\"");
}

TEST(Context, TheTimeThatRemainsGrowsWithTheTimeSoFarAndIsUnknownAtTheBegin) {
  api::Job job;
  job.state = api::JobState::running;
  job.started_at = 1000;
  job.fraction = 0.01;
  EXPECT_FALSE(remaining_seconds(job, 5000));
  job.fraction = 0.25;
  EXPECT_DOUBLE_EQ(remaining_seconds(job, 5000).value(), 12);
  EXPECT_DOUBLE_EQ(remaining_seconds(job, 500).value(), 0);
  job.fraction = 1;
  EXPECT_DOUBLE_EQ(remaining_seconds(job, 5000).value(), 0);
  for (const auto state : {api::JobState::queued, api::JobState::succeeded}) {
    job.state = state;
    EXPECT_FALSE(remaining_seconds(job, 5000));
  }
}

}  // namespace
}  // namespace bahnwerk::server
