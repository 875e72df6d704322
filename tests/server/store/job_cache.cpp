#include "server/store/sqlite/job_cache.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

api::Job job(const std::string& id, int attempt) {
  api::Job job;
  job.id = id, job.attempt = attempt;
  return job;
}

TEST(JobCache, TheNextCommitEmptiesIt) {
  JobCache cache;
  cache.put(4, job("a", 1));
  cache.put(4, job("b", 2));
  EXPECT_EQ(cache.find(4, "a")->attempt, 1);
  EXPECT_FALSE(cache.find(4, "c"));
  EXPECT_FALSE(cache.find(5, "a")) << "read before the commit";
  cache.put(5, job("b", 3));
  EXPECT_FALSE(cache.find(5, "a"));
  EXPECT_FALSE(cache.find(4, "a"));
  EXPECT_EQ(cache.find(5, "b")->attempt, 3);
}

TEST(JobCache, AReaderThatComesLateChangesNothing) {
  JobCache cache;
  cache.put(5, job("a", 2));
  cache.put(4, job("a", 1));
  EXPECT_EQ(cache.find(5, "a")->attempt, 2);
  EXPECT_FALSE(cache.find(4, "a"));
}

TEST(JobCache, TheLatestOfSeveralReadsCountsAndMemoryIsBounded) {
  JobCache cache;
  cache.put(1, job("a", 1));
  cache.put(1, job("a", 2));
  EXPECT_EQ(cache.find(1, "a")->attempt, 2);
  for (int i = 0; i < 4096; ++i) cache.put(1, job(std::to_string(i), i));
  EXPECT_FALSE(cache.find(1, "a"));
  EXPECT_EQ(cache.find(1, "4095")->attempt, 4095);
}

}  // namespace
}  // namespace bahnwerk::server
