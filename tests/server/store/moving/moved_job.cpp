#include "server/store/moving/moved_job.hpp"

#include <gtest/gtest.h>

#include "server/store/rules.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

MovedJob running() {
  MovedJob job;
  job.id = "01890a5d-ac96-774b-bcce-b302099a8057";
  job.kind = "ramp";
  job.state = JobState::running;
  job.attempt = job.token = 2;
  job.fraction = 0.5;
  job.stage = "planning";
  job.started_at = 5;
  job.revision = 7;
  job.callback_receiver = "r";
  return job;
}

TEST(AsMoved, ARunningJobHasLostItsAttempt) {
  const MovedJob job = as_moved(running(), 9);
  EXPECT_EQ(job.state, JobState::queued);
  EXPECT_EQ(job.revision, 7 + lost_leap) << "above all that clients may have seen";
  EXPECT_TRUE(job.suspect);
  EXPECT_EQ(job.attempt, 2) << "the next one has another number";
  EXPECT_EQ(job.token, 2);
  EXPECT_EQ(job.fraction, 0);
  EXPECT_EQ(job.stage, "");
  EXPECT_FALSE(job.started_at);
  EXPECT_FALSE(job.callback_due);
}

TEST(AsMoved, ARunningJobWhoseCancellationWasRequestedIsCancelled) {
  MovedJob asked = running();
  asked.cancel_requested = true;
  const MovedJob job = as_moved(asked, 9);
  EXPECT_EQ(job.state, JobState::cancelled);
  EXPECT_EQ(job.finished_at, 9);
  EXPECT_EQ(job.callback_due, 9);
  EXPECT_EQ(job.error, after_cancel(job.id).error);
}

TEST(AsMoved, OthersStayAsTheyAre) {
  MovedJob job = running();
  for (const auto state : {JobState::queued, JobState::succeeded, JobState::failed, JobState::cancelled}) {
    job.state = state;
    EXPECT_EQ(record_of(as_moved(job, 9)), record_of(job));
  }
}

TEST(RecordOf, TellsValuesApart) {
  const MovedJob job = running();
  MovedJob other = job;
  other.key = 77;
  EXPECT_EQ(record_of(other), record_of(job)) << "the key is the store's own";
  other.name = "";
  EXPECT_NE(record_of(other), record_of(job)) << "none and an empty one";
  other = job;
  other.stage = "", other.message = job.stage;
  EXPECT_NE(record_of(other), record_of(job));
  other = job;
  other.tags = {"a", "b"};
  MovedJob joined = job;
  joined.tags = {"ab"};
  EXPECT_NE(record_of(other), record_of(joined));
  other = job;
  other.idempotency_keys = {{"k", "h"}};
  EXPECT_NE(record_of(other), record_of(job));
}

}  // namespace
}  // namespace bahnwerk::server
