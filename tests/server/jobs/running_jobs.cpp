#include "server/jobs/running_jobs.hpp"

#include "tests/server/manual_time.hpp"
#include "tests/server/store/fixture.hpp"

namespace bahnwerk::server {
namespace {

TEST(RunningJobs, AreThoseOfThisProcessAsTheyAreNowWhereNoOtherUsesTheStore) {
  const TempFolder folder;
  SqliteStore store({.path = (folder.path / "a.db").string()});
  ManualTime time;
  LiveJobs live;
  Notifier notifier(time);
  RunningJobs running(store, live, notifier, time);
  EXPECT_TRUE(running.all().empty());
  api::Job job;
  job.id = "one";
  job.revision = 2;
  const auto planned = live.add(job);
  planned->publish(0.5, "stage", "");
  const auto all = running.all();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].id, "one");
  EXPECT_EQ(all[0].revision, planned->revision());
}

}  // namespace
}  // namespace bahnwerk::server
