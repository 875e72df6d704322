#include "server/jobs/deadlines.hpp"

#include <gtest/gtest.h>

#include <future>

#include "../manual_time.hpp"
#include "../store/fixture.hpp"
#include "server/jobs/change_feed.hpp"
#include "server/jobs/notifier.hpp"

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

struct DeadlinesTest : StoreTest {
  std::string post(std::int64_t deadline) {
    NewJob job = new_job();
    job.request.deadline = deadline;
    return insert_id(*store, job);
  }
  /// Waits until the job is in that state, 30 s at most.
  void await(const std::string& id, api::JobState state) {
    for (int i = 0; i < 15'000 && store->get(id)->state != state; ++i) std::this_thread::sleep_for(2ms);
    EXPECT_EQ(store->get(id)->state, state);
  }
  ManualTime time;
};

TEST_F(DeadlinesTest, EndsAtOnceWhatPassedBeforeTheStart) {
  const std::string id = post(time.now_ms() - 1);
  const Deadlines deadlines(*store, time);
  EXPECT_EQ(store->get(id)->state, api::JobState::failed) << "before anything else is done";
}

TEST_F(DeadlinesTest, EndsWhatPassesAndTellsWhoWaits) {
  Notifier notifier;
  const ChangeFeed feed(*store, {[&](const std::vector<Changed>& changes) {
                                   for (const Changed& change : changes) notifier.changed(change.id);
                                 },
                                 [] {}});
  Deadlines deadlines(*store, time);
  const std::int64_t start = time.now_ms();
  const std::string late = post(start + 300'000);
  deadlines.notify();
  const std::string id = post(start + 300);  // becomes the next one
  std::promise<void> woken;
  notifier.wait(id, Notifier::Clock::now() + 60s, [&] { woken.set_value(); });
  deadlines.notify();
  time.advance(299ms);
  const std::string first = post(start + 299);
  deadlines.notify();
  await(first, api::JobState::failed);
  EXPECT_EQ(store->get(id)->state, api::JobState::queued) << "1 ms before its deadline";
  time.advance(1ms);
  await(id, api::JobState::failed);
  EXPECT_EQ(woken.get_future().wait_for(30s), std::future_status::ready);
  EXPECT_EQ(store->get(late)->state, api::JobState::queued);
}

TEST_F(DeadlinesTest, TakesBackJobsWhoseLeaseRunsOut) {
  const std::string id = insert_id(*store);
  claim(*store, time.now_ms(), "gone", 200);
  const Deadlines deadlines(*store, time);
  EXPECT_EQ(store->get(id)->state, api::JobState::running);
  time.advance(200ms);
  await(id, api::JobState::queued);
}

TEST_F(DeadlinesTest, EveryLookTellsWhatItFound) {
  const std::string id = insert_id(*store);
  claim(*store, time.now_ms(), "gone", 200);
  std::atomic<int> looks{0}, lost{0};
  const Deadlines deadlines(*store, time, [&](const Expired& expired) {
    lost += static_cast<int>(expired.lost.size());
    ++looks;
  });
  EXPECT_GE(looks, 1) << "before anything else is done";
  time.advance(200ms);
  await(id, api::JobState::queued);
  for (int i = 0; i < 15'000 && lost == 0; ++i) std::this_thread::sleep_for(2ms);
  EXPECT_EQ(lost, 1);
}

}  // namespace
}  // namespace bahnwerk::server
