#include "server/routes/watch.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

int wait_of(const std::string& prefer) {
  Request request;
  request.headers = {{"prefer", prefer}};
  return preferred_wait(request);
}

bool knows(const std::string& tags, std::uint64_t since, std::uint64_t revision) {
  Request request;
  request.headers = {{"if-none-match", tags}};
  api::Job job;
  job.state_revision = since, job.revision = revision;
  return knows_state(request, job);
}

TEST(Watch, AWaitIsASecondToAMinute) {
  EXPECT_EQ(preferred_wait({}), 0);
  EXPECT_EQ(wait_of("wait=7"), 7);
  EXPECT_EQ(wait_of("wait=60"), 60);
  EXPECT_EQ(wait_of("wait=61"), 60);
  EXPECT_EQ(wait_of("wait=99999999999999999999"), 60) << "more than a number takes is long, too";
  for (const char* none : {"", "wait", "wait=", "wait=x", "wait=-5", "wait=-99999999999999999999", "await=5"})
    EXPECT_EQ(wait_of(none), 0) << none;
}

TEST(Watch, AWaitIsFoundAmongOtherPreferences) {
  EXPECT_EQ(wait_of("respond-async, wait=10"), 10);
  EXPECT_EQ(wait_of("respond-async; x=1,\t wait=3; y"), 3);
  EXPECT_EQ(wait_of("Wait=4"), 4) << "names are case-insensitive";
  EXPECT_EQ(wait_of("wait=4, wait=9"), 4) << "the first one counts";
}

TEST(Watch, AnETagSinceTheStateBeganKnowsTheState) {
  EXPECT_TRUE(knows("\"5\"", 5, 9));
  EXPECT_TRUE(knows("\"9\"", 5, 9));
  EXPECT_TRUE(knows("W/\"1\", \"7\"", 5, 9));
  EXPECT_FALSE(knows("\"4\"", 5, 9));
  EXPECT_FALSE(knows("\"10\"", 5, 9)) << "of another store";
  EXPECT_FALSE(knows("*", 5, 9));
  EXPECT_FALSE(knows("\"7x\"", 5, 9));
  EXPECT_FALSE(knows("\"7", 5, 9));
  EXPECT_FALSE(knows("\"7\"", 0, 9)) << "not known since when";
}

}  // namespace
}  // namespace bahnwerk::server
