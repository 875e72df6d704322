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

TEST(Context, ATagIsFoundInAListWeakOrAsAStar) {
  for (const char* tags : {"\"5\"", "W/\"5\"", "\"4\", \"5\"", " \"4\" ,W/\"5\" ", "*"})
    EXPECT_TRUE(matches_etag(asking("if-none-match", tags), "\"5\"")) << tags;
  for (const char* tags : {"\"55\"", "5", "\"4\"", ""})
    EXPECT_FALSE(matches_etag(asking("if-none-match", tags), "\"5\"")) << tags;
  EXPECT_FALSE(matches_etag({}, "\"5\""));
}

TEST(Context, WhatTheClientHasIsNotSentAgain) {
  Response full;
  full.body = "text";
  const Response same = with_etag(asking("if-none-match", "\"a\""), "\"a\"", full),
                 other = with_etag(asking("if-none-match", "\"b\""), "\"a\"", full);
  EXPECT_EQ(same.status, 304);
  EXPECT_EQ(same.body, "");
  EXPECT_EQ(same.header("ETag"), "\"a\"");
  EXPECT_EQ(other.status, 200);
  EXPECT_EQ(other.body, "text");
  EXPECT_EQ(other.header("ETag"), "\"a\"");
}

TEST(Context, WhatTheClientHasIsNotMade) {
  bool made = false;
  const auto make = [&] {
    made = true;
    return Response();
  };
  EXPECT_EQ(unless_known(asking("if-none-match", "\"a\""), "\"a\"", make).status, 304);
  EXPECT_FALSE(made);
  EXPECT_EQ(unless_known(asking("if-none-match", "\"b\""), "\"a\"", make).status, 200);
  EXPECT_TRUE(made);
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
