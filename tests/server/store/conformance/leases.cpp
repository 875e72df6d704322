#include <functional>
#include <mutex>
#include <set>
#include <thread>

#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct Leases : Conformance<S> {};
TYPED_TEST_SUITE(Leases, Stores, StoreNames);

TYPED_TEST(Leases, GiveTheJobToAnotherWhenTheyRunOut) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  EXPECT_EQ(claim(*store, 1000, "a", 500)->attempt, 1);
  const auto revision = store->get(id)->revision;
  EXPECT_FALSE(claim(*this->other, 1499, "b", 500)) << "not yet";
  const auto again = claim(*this->other, 1500, "b", 500);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->id, id);
  EXPECT_EQ(again->attempt, 2);
  EXPECT_EQ(again->started_at, 1500);
  EXPECT_GT(again->revision, revision + 1000) << "clients may have seen revisions that were never stored";
  EXPECT_FALSE(store->succeed({id, 1}, ramp_plan(10), 1600, nothing_seen, this->silent)) << "its attempt is over";
  EXPECT_FALSE(store->end({id, 1}, {JobState::failed, "{}", 1600, 0}));
  EXPECT_FALSE(store->requeue({id, 1}, 1600, 0));
  EXPECT_EQ(over(*store, {"a", 1600, 2100}, {{id, 1}}).size(), 1U);
  EXPECT_EQ(store->get(id)->state, JobState::running);
  EXPECT_TRUE(this->other->succeed({id, 2}, ramp_plan(10), 1700, nothing_seen, this->silent));
}

TYPED_TEST(Leases, AreNotTakenOfJobsThatNeedPlannersOfALaterVersion) {
  this->restart(api::engine_level + 1);
  NewJob urgent = new_job(1);
  const std::string later = insert_id(*this->here, urgent);
  EXPECT_EQ(this->here->status().beyond_engine, 0U);
  this->restart();
  const std::string own = insert_id(*this->here);
  EXPECT_EQ(this->here->status().beyond_engine, 1U);
  EXPECT_EQ(claim(*this->here, 1, "a")->id, own) << "behind it in the queue";
  EXPECT_TRUE(this->here->end({own, 1}, {JobState::failed, "{}", 2, 0}));
  EXPECT_FALSE(claim(*this->other, 3, "b"));
  EXPECT_EQ(this->here->get(later)->state, JobState::queued);
  EXPECT_EQ(this->here->counts().at(JobState::queued), 1U);
  this->restart(api::engine_level + 1);
  EXPECT_EQ(claim(*this->other, 4, "c")->id, later);
  EXPECT_EQ(this->here->status().beyond_engine, 0U);
  this->restart(api::engine_level + 2);
  EXPECT_FALSE(insert_id(*this->here).empty());
  this->restart();
  EXPECT_EQ(this->here->cancel(this->here->queue(10).back(), 5)->state, JobState::cancelled) << "clients may end it";
}

TYPED_TEST(Leases, AreExtendedByAHeartbeat) {
  auto& store = this->here;
  this->queue(2);
  const std::string kept = claim(*store, 1000, "a", 500)->id, left = claim(*store, 1000, "a", 500)->id;
  EXPECT_TRUE(over(*store, {"a", 1400, 1900}, {{kept, 1}}).empty());
  EXPECT_EQ(over(*store, {"b", 1400, 9000}, {{kept, 1}}).size(), 1U) << "of another worker";
  EXPECT_EQ(over(*store, {"a", 1400, 9000}, {{kept, 2}}).size(), 1U) << "another attempt";
  EXPECT_EQ(over(*store, {"a", 1400, 9000}, {{"none", 1}}).size(), 1U);
  EXPECT_TRUE(over(*store, {"a", 1400, 9000}, {}).empty());
  EXPECT_EQ(claim(*this->other, 1600, "b", 500)->id, left);
  EXPECT_FALSE(claim(*this->other, 1899, "b", 500));
  EXPECT_TRUE(over(*store, {"a", 1950, 2500}, {{kept, 1}}).empty()) << "late, but nobody had noticed";
  EXPECT_FALSE(store->expire(2050).lost == std::vector{kept});
  EXPECT_TRUE(store->end({kept, 1}, {JobState::failed, "{}", 2600, 0})) << "its attempt is still the one";
}

TYPED_TEST(Leases, OfAJobThatRanAloneAreLostThreeTimesAtMost) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  for (int attempt = 1; attempt <= 3; ++attempt) {
    EXPECT_EQ(claim(*store, 1000 * attempt, "a", 500)->attempt, attempt);
    const Expired early = store->expire(1000 * attempt + 499);
    EXPECT_TRUE(early.lost.empty());
    EXPECT_EQ(early.next, 1000 * attempt + 500);
    const Expired expired = this->other->expire(1000 * attempt + 500);
    EXPECT_EQ(expired.lost, std::vector{id});
    EXPECT_TRUE(expired.ids.empty());
    EXPECT_FALSE(expired.next);
    const auto job = store->get(id);
    EXPECT_EQ(job->state, attempt < 3 ? JobState::queued : JobState::failed);
    EXPECT_EQ(job->attempt, attempt);
    EXPECT_EQ(job->fraction, 0);
  }
  EXPECT_EQ(nlohmann::json::parse(*store->get(id)->error)["type"], "/problems/worker-lost");
  EXPECT_EQ(store->get(id)->finished_at, 3500);
  EXPECT_FALSE(claim(*store, 9000));
}

TYPED_TEST(Leases, LostByWorkersThatTurnOutToLiveAreNotCounted) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  const auto lose = [&] {
    const std::int64_t token = claim(*store, 1000, "a", 500)->token;
    EXPECT_EQ(this->other->expire(1500).lost, std::vector{id});
    return Attempt{id, token};
  };
  const std::vector<std::function<void(const Attempt&)>> calls{
      [&](const Attempt& lost) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(over(*store, {"a", 1600, 2100}, {lost}).size(), 1U) << "it is taken once";
      },
      [&](const Attempt& lost) { EXPECT_FALSE(store->succeed(lost, ramp_plan(10), 1600, nothing_seen, this->silent)); },
      [&](const Attempt& lost) { EXPECT_FALSE(store->succeed(lost, ramp_plan(0), 1600, nothing_seen, this->silent)); },
      [&](const Attempt& lost) {
        EXPECT_FALSE(store->end(lost, {JobState::failed, "{}", 1600, 0}));
      },
      [&](const Attempt& lost) { EXPECT_FALSE(store->requeue(lost, 1600, 0)); }};
  lose();  // by a worker of which nothing is heard
  for (const auto& call : calls) {
    call(lose());
    EXPECT_EQ(store->get(id)->state, JobState::queued);
  }
  const Attempt paused = lose();
  const Attempt later{id, claim(*this->other, 2000, "b", 500)->token};
  EXPECT_EQ(over(*store, {"a", 2000, 2500}, {paused}).size(), 1U) << "while another one plans the job";
  EXPECT_EQ(store->expire(2500).lost, std::vector{id});
  EXPECT_EQ(store->get(id)->state, JobState::queued);
  lose();
  EXPECT_EQ(store->get(id)->state, JobState::failed) << "three have told nothing";
  const auto revision = store->get(id)->revision;
  EXPECT_EQ(over(*this->other, {"b", 2600, 3100}, {later}).size(), 1U);
  EXPECT_EQ(store->get(id)->revision, revision) << "too late";
}

TYPED_TEST(Leases, LostByJobsThatRanTogetherAreCountedAgainstNone) {
  auto& store = this->here;
  this->queue(2);
  claim(*store, 1000, "a", 500);
  claim(*store, 1000, "a", 500);
  EXPECT_EQ(store->expire(1500).lost.size(), 2U);
  // From here on each runs alone, and its losses count.
  for (int loss = 0; loss < 2; ++loss) {
    const auto alone = claim(*store, 2000, "a", 500);
    ASSERT_TRUE(alone);
    EXPECT_FALSE(claim(*store, 2000, "a", 500)) << "the other suspect waits";
    EXPECT_EQ(store->expire(2500).lost, std::vector{alone->id});
    EXPECT_EQ(store->get(alone->id)->state, JobState::queued);
  }
  const auto third = claim(*store, 2000, "a", 500);
  EXPECT_EQ(store->expire(2500).lost, std::vector{third->id});
  EXPECT_EQ(store->get(third->id)->state, JobState::failed) << "the third loss alone";
}

TYPED_TEST(Leases, OfSuspectsAreNotSharedWithInnocents) {
  auto& store = this->here;
  const std::string suspect = insert_id(*store);
  claim(*store, 1000, "a", 500);
  store->expire(1500);
  const std::string early = insert_id(*store, new_job(1));
  EXPECT_EQ(claim(*store, 2000, "a", 500)->id, early);
  insert_id(*store);
  EXPECT_FALSE(claim(*store, 2000, "a", 500)) << "the suspect is next, and something runs";
  EXPECT_TRUE(store->end({early, 1}, {JobState::failed, "{}", 2100, 0}));
  EXPECT_EQ(claim(*store, 2100, "a", 500)->id, suspect);
  EXPECT_FALSE(claim(*store, 2100, "a", 500)) << "nothing begins beside it";
  EXPECT_TRUE(store->succeed({suspect, 2}, ramp_plan(10), 2200, nothing_seen, this->silent));
  EXPECT_TRUE(claim(*store, 2200, "a", 500));
}

TYPED_TEST(Leases, DoNotForgetACancellation) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  claim(*store, 1000, "a", 500);
  EXPECT_EQ(this->other->cancel(id, 1100)->state, JobState::running);
  EXPECT_EQ(store->expire(1500).lost, std::vector{id});
  EXPECT_EQ(store->get(id)->state, JobState::cancelled);
  EXPECT_EQ(nlohmann::json::parse(*store->get(id)->error)["type"], "/problems/cancelled");
}

TYPED_TEST(Leases, AreNotLostByARequeue) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  claim(*store, 1000, "a", 500);
  store->expire(1500);
  for (int i = 0; i < 3; ++i) {  // one attempt was lost; what is put back is not counted
    const auto job = claim(*store, 2000, "b", 500);
    EXPECT_EQ(job->attempt, 2);
    EXPECT_TRUE(store->requeue({id, job->token}, 2100, 0));
  }
}

TYPED_TEST(Leases, WithoutAnEndHoldUntilTheRestart) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  claim(*store, 1000);
  EXPECT_FALSE(store->expire(Lease::forever - 1).next);
  EXPECT_FALSE(claim(*store, Lease::forever - 1));
  this->restart();
  EXPECT_EQ(store->get(id)->state, TypeParam::restart_ends_leases ? JobState::queued : JobState::running);
}

TYPED_TEST(Leases, GiveEveryJobToOneOfManyThreads) {
  auto& store = this->here;
  constexpr std::size_t jobs = 300, threads = 8;
  for (std::size_t i = 0; i < jobs; ++i) insert_id(*store, new_job(static_cast<int>(i % 3)));
  std::mutex mutex;
  std::multiset<std::string> claimed;
  std::vector<std::thread> list;
  for (std::size_t t = 0; t < threads; ++t)
    list.emplace_back([&, t] {
      Store& mine = t % 2 ? *this->other : *store;
      while (const auto job = claim(mine, 1000, "worker " + std::to_string(t), 60'000)) {
        EXPECT_EQ(job->attempt, 1);
        {
          const std::lock_guard lock(mutex);
          claimed.insert(job->id);
        }
        EXPECT_TRUE(mine.end({job->id, 1}, {JobState::failed, "{}", 2000, 0}));
      }
    });
  for (auto& thread : list) thread.join();
  EXPECT_EQ(claimed.size(), jobs);
  EXPECT_EQ(std::set<std::string>(claimed.begin(), claimed.end()).size(), jobs);
  EXPECT_EQ(store->counts()[JobState::failed], jobs);
}

}  // namespace
}  // namespace bahnwerk::server
