#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct Attempts : Conformance<S> {};
TYPED_TEST_SUITE(Attempts, Stores, StoreNames);

TYPED_TEST(Attempts, ClaimsByPriorityThenInOrder) {
  auto& store = this->here;
  const std::string first = insert_id(*store, new_job(0)), second = insert_id(*store, new_job(0)),
                    urgent = insert_id(*store, new_job(5)), late = insert_id(*store, new_job(-1));
  for (const auto& expected : {urgent, first, second, late}) {
    const auto job = claim(*store, 1);
    ASSERT_TRUE(job);
    EXPECT_EQ(job->id, expected);
    EXPECT_EQ(job->state, JobState::running);
    EXPECT_EQ(job->attempt, 1);
    EXPECT_EQ(job->request.document, R"({"n":1})");
  }
  EXPECT_FALSE(claim(*store, 1));
}

/// Progress that clients see at once, with a revision of its own each.
struct SeenProgress final : ProgressSink {
  void report(std::string_view, double, std::string_view) override { ++revision; }
  std::uint64_t revision = 7;
};

TYPED_TEST(Attempts, AResultComesAfterTheProgressOfStoringIt) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  claim(*store, 1);
  SeenProgress progress;
  const auto seen = [&] { return progress.revision; };
  ASSERT_TRUE(store->succeed({id, 1}, ramp_plan(100'000), 2, seen, progress));
  EXPECT_GT(progress.revision, 7U) << "storing tells its progress";
  EXPECT_GT(store->get(id)->revision, progress.revision) << "who has seen that must learn of the end";
}

TYPED_TEST(Attempts, TakesAResultOnceAndFromTheRightAttempt) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  EXPECT_FALSE(store->succeed({id, 1}, ramp_plan(10), 2, nothing_seen, this->silent)) << "not running yet";
  claim(*store, 1);
  EXPECT_FALSE(store->succeed({id, 2}, ramp_plan(10), 2, nothing_seen, this->silent)) << "another attempt";
  EXPECT_FALSE(store->result(id));
  EXPECT_TRUE(store->succeed(
      {id, 1}, ramp_plan(10), 2, [] { return std::uint64_t{40}; }, this->silent));
  EXPECT_FALSE(store->end({id, 1}, {JobState::failed, "{}", 3, 0}));
  EXPECT_FALSE(store->requeue({id, 1}, 3, 0));
  const auto job = store->get(id);
  EXPECT_EQ(job->state, JobState::succeeded);
  EXPECT_EQ(job->finished_at, 2);
  EXPECT_EQ(job->revision, 41U);
  EXPECT_EQ(store->result(id), R"({"kind":"ramp","rows":10})");
  EXPECT_EQ(store->series(id)->count, 10U);
}

TYPED_TEST(Attempts, EndOnceHoweverOftenTheirEndIsTold) {
  auto& store = this->here;
  const std::string succeeded = insert_id(*store), failed = insert_id(*store);
  for (const std::string& id : {succeeded, failed}) EXPECT_EQ(claim(*store, 1, "a", 500)->id, id);
  const Ending ending{JobState::failed, "{}", 2, 9};
  EXPECT_TRUE(store->succeed({succeeded, 1}, ramp_plan(10), 2, nothing_seen, this->silent));
  EXPECT_TRUE(store->end({failed, 1}, ending));
  const auto revision = [&](const std::string& id) { return store->get(id)->revision; };
  const auto first = revision(succeeded), second = revision(failed);
  EXPECT_TRUE(store->succeed({succeeded, 1}, ramp_plan(10), 3, nothing_seen, this->silent));
  EXPECT_TRUE(this->other->succeed({succeeded, 1}, ramp_plan(0), 3, nothing_seen, this->silent));
  EXPECT_TRUE(this->other->end({failed, 1}, ending));
  EXPECT_EQ(store->get(succeeded)->finished_at, 2);
  EXPECT_EQ(store->series(succeeded)->count, 10U);
  EXPECT_EQ(revision(succeeded), first) << "nothing has changed";
  EXPECT_EQ(revision(failed), second);
  EXPECT_FALSE(store->end({succeeded, 1}, ending)) << "another end";
  EXPECT_FALSE(store->end({failed, 1}, {JobState::cancelled, "{}", 3, 0}));
  EXPECT_FALSE(store->end({failed, 2}, ending)) << "another attempt";
  EXPECT_FALSE(store->succeed({failed, 1}, ramp_plan(10), 3, nothing_seen, this->silent));
}

TYPED_TEST(Attempts, ThatWereNotTheEndOfAJobAreNotToldThatTheyWere) {
  auto& store = this->here;
  const std::string cancelled = insert_id(*store);
  claim(*store, 1, "a", 500);
  EXPECT_TRUE(store->requeue({cancelled, 1}, 2, 0));
  EXPECT_EQ(store->cancel(cancelled, 3)->state, JobState::cancelled) << "while it waits, with the token of the attempt";
  EXPECT_FALSE(store->end({cancelled, 1}, {JobState::cancelled, "{}", 4, 0}));
  const std::string deadly = insert_id(*store);
  std::int64_t token = 0;
  for (int loss = 0; loss < max_losses_alone; ++loss) {
    token = claim(*store, 1000, "a", 500)->token;
    store->expire(1500);
  }
  EXPECT_EQ(store->get(deadly)->state, JobState::failed);
  EXPECT_FALSE(store->end({deadly, token}, {JobState::failed, "{}", 1600, 0}));
  EXPECT_NE(store->get(deadly)->error->find("worker-lost"), std::string::npos);
}

TYPED_TEST(Attempts, LeaveTheVersionThatPlanned) {
  auto& store = this->here;
  const std::string succeeded = insert_id(*store), failed = insert_id(*store), cancelled = insert_id(*store);
  for (int k = 0; k < 3; ++k) claim(*store, 1, "a", 500);
  EXPECT_FALSE(store->get(succeeded)->planned_by) << "before its end";
  EXPECT_TRUE(store->succeed({succeeded, 1}, ramp_plan(10), 2, nothing_seen, this->silent));
  EXPECT_TRUE(store->end({failed, 1}, {.error = "{}", .now = 2, .result = "{}"}));
  EXPECT_TRUE(store->requeue({cancelled, 1}, 2, 0));
  store->cancel(cancelled, 3);
  for (const api::Job& job : store->list({}))
    EXPECT_EQ(job.planned_by, job.id == cancelled ? std::nullopt : std::optional<std::string>("7.1"));
}

TYPED_TEST(Attempts, RequeuesWithoutCountingTheAttempt) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  for (int i = 1; i <= 5; ++i) {
    const auto job = claim(*store, 1);
    EXPECT_EQ(job->attempt, 1);
    EXPECT_EQ(job->token, i);
    EXPECT_TRUE(store->requeue({id, i}, 2, 0));
  }
  claim(*store, 1);
  store->cancel(id, 2);
  EXPECT_TRUE(store->requeue({id, 6}, 2, 0));
  EXPECT_EQ(store->get(id)->state, JobState::cancelled) << "the wish to cancel is not forgotten";
}

TYPED_TEST(Attempts, TakesNothingFromAPlannerWhoseJobWasPutBackAndClaimedAgain) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  const Attempt stuck{id, claim(*store, 1, "a", 500)->token};
  EXPECT_TRUE(store->requeue(stuck, 2, 0)) << "by the end of its service, which thinks it stuck";
  const auto again = claim(*this->other, 3, "b", 500);
  EXPECT_EQ(again->attempt, 1) << "the number returns to use";
  const Attempt later{id, again->token};
  EXPECT_FALSE(store->succeed(stuck, ramp_plan(10), 4, nothing_seen, this->silent));
  EXPECT_FALSE(store->end(stuck, {JobState::failed, "{}", 4, 0}));
  EXPECT_FALSE(store->requeue(stuck, 4, 0));
  for (const char* const worker : {"a", "b"})
    EXPECT_TRUE(store->heartbeat({worker, 4, 600}, {{stuck, 0.5, "half", "", 9}}).empty());
  EXPECT_EQ(store->get(id)->fraction, 0);
  EXPECT_EQ(store->get(id)->state, JobState::running);
  EXPECT_TRUE(this->other->succeed(later, ramp_plan(20), 5, nothing_seen, this->silent));
  EXPECT_EQ(store->series(id)->count, 20U);
}

TYPED_TEST(Attempts, AreToldOfTogetherByOneHeartbeat) {
  auto& store = this->here;
  this->queue(3);
  std::vector<Attempt> attempts;
  for (int k = 0; k < 3; ++k) attempts.push_back({claim(*store, 1000, "a", 500)->id, 1});
  this->other->cancel(attempts[2].id, 1100);
  const auto held = store->heartbeat(
      {"a", 1200, 1700}, {{attempts[0], 0.25, "grid", "x", 20}, {{attempts[1].id, 2}}, {attempts[2], 0.5, "", "", 30}});
  ASSERT_EQ(held.size(), 2U) << "one is another attempt";
  for (const Held& each : held) {
    const bool first = each.attempt == attempts[0];
    EXPECT_TRUE(first || each.attempt == attempts[2]);
    EXPECT_EQ(each.revision, first ? 20U : 30U);
    EXPECT_EQ(each.cancel_requested, !first);
  }
  const auto job = this->other->get(attempts[0].id);
  EXPECT_EQ(job->fraction, 0.25);
  EXPECT_EQ(job->stage, "grid");
  EXPECT_EQ(job->message, "x");
  EXPECT_EQ(job->revision, 20U);
  const auto late = store->heartbeat({"a", 1300, 1800}, {{attempts[0], 0.125, "late", "", 19}});
  ASSERT_EQ(late.size(), 1U);
  EXPECT_EQ(late[0].revision, 20U) << "the stored one is ahead";
  EXPECT_EQ(store->get(attempts[0].id)->stage, "grid") << "what is older is not stored, but the lease is extended";
  EXPECT_EQ(this->other->expire(1750).lost.size(), 2U);
  EXPECT_EQ(store->get(attempts[0].id)->state, JobState::running);
}

TYPED_TEST(Attempts, FollowTheQueueWhateverComesBeforeTheLastClaim) {
  auto& store = this->here;
  this->queue(5);
  const std::string first = claim(*store, 1)->id, second = claim(*store, 1)->id;
  EXPECT_TRUE(store->requeue({first, 1}, 2, 0));
  EXPECT_EQ(claim(*store, 3)->id, first) << "put back, it is the first again";
  const std::string urgent = insert_id(*store, new_job(5));
  EXPECT_EQ(claim(*store, 4)->id, urgent);
  EXPECT_TRUE(this->other->requeue({second, 1}, 5, 0));
  store->changes_since(0, 100);  // of which the process hears
  EXPECT_EQ(claim(*store, 6)->id, second);
  std::size_t more = 0;
  while (claim(*store, 7)) ++more;
  EXPECT_EQ(more, 3U);
  EXPECT_TRUE(this->other->requeue({second, 2}, 8, 0));
  EXPECT_EQ(claim(*store, 9)->id, second) << "nothing is left behind unheard";
}

TYPED_TEST(Attempts, Cancels) {
  auto& store = this->here;
  const std::string queued = insert_id(*store), running = insert_id(*store, new_job(1));
  claim(*store, 1);
  EXPECT_EQ(store->cancel(queued, 5)->state, JobState::cancelled);
  EXPECT_EQ(store->get(queued)->finished_at, 5);
  const auto revision = store->get(queued)->revision;
  EXPECT_EQ(store->cancel(queued, 6)->revision, revision) << "again changes nothing";
  EXPECT_EQ(store->cancel(running, 5)->state, JobState::running);
  EXPECT_TRUE(store->cancel_requested(running));
  EXPECT_FALSE(store->cancel_requested(queued));
  EXPECT_FALSE(store->cancel("none", 5));
  EXPECT_TRUE(store->end({running, 1}, {JobState::cancelled, "{}", 6, 0}));
  EXPECT_EQ(store->cancel(running, 7)->finished_at, 6) << "ended already";
}

TYPED_TEST(Attempts, EndsQueuedJobsWhoseDeadlinePassed) {
  auto& store = this->here;
  EXPECT_FALSE(store->expire(1000).next);
  const auto with_deadline = [&](std::optional<std::int64_t> deadline) {
    NewJob job = new_job();
    job.request.deadline = deadline;
    return insert_id(*store, job);
  };
  const std::string running = with_deadline(500);
  claim(*store, 1);
  const std::string never = with_deadline(std::nullopt), late = with_deadline(3000), due = with_deadline(1000);
  EXPECT_EQ(store->expire(999).next, 1000);
  const auto revision = store->get(due)->revision;
  const Expired expired = store->expire(1000);
  EXPECT_EQ(expired.ids, std::vector<std::string>{due});
  EXPECT_EQ(expired.next, 3000);
  const auto job = store->get(due);
  EXPECT_EQ(job->state, JobState::failed);
  EXPECT_EQ(job->finished_at, 1000);
  EXPECT_EQ(job->attempt, 0);
  EXPECT_GT(job->revision, revision);
  EXPECT_NE(job->error->find("/problems/deadline-exceeded"), std::string::npos);
  EXPECT_NE(job->error->find("/v1/jobs/" + due), std::string::npos);
  for (const auto& id : {never, late}) EXPECT_EQ(store->get(id)->state, JobState::queued);
  EXPECT_EQ(store->get(running)->state, JobState::running) << "its planner holds the deadline";
  EXPECT_EQ(store->counts()[JobState::failed], 1U);
  for (int i = 0; i < 600; ++i) with_deadline(2000 + i % 2);
  std::size_t ended = 0;
  for (Expired part = store->expire(2001); !part.ids.empty(); part = store->expire(2001)) ended += part.ids.size();
  EXPECT_EQ(ended, 600U);
}

}  // namespace
}  // namespace bahnwerk::server
