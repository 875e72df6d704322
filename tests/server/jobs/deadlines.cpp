#include "server/jobs/deadlines.hpp"

#include <gtest/gtest.h>

#include <future>

#include "../store/fixture.hpp"
#include "server/jobs/change_feed.hpp"
#include "server/jobs/notifier.hpp"
#include "server/runtime/clock.hpp"

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

struct DeadlinesTest : StoreTest {
  std::string post(std::int64_t deadline) {
    NewJob job = new_job();
    job.request.deadline = deadline;
    return insert_id(*store, job);
  }
  /// Waits until the job ends; ms since `start`.
  std::int64_t await(const std::string& id, std::int64_t start) {
    while (store->get(id)->state == api::JobState::queued && now_ms() < start + 20'000)
      std::this_thread::sleep_for(2ms);
    return now_ms() - start;
  }
};

TEST_F(DeadlinesTest, EndsAtOnceWhatPassedBeforeTheStart) {
  const std::string id = post(now_ms() - 1);
  const Deadlines deadlines(*store);
  EXPECT_EQ(store->get(id)->state, api::JobState::failed) << "before anything else is done";
}

TEST_F(DeadlinesTest, EndsWhatPassesAndTellsWhoWaits) {
  Notifier notifier;
  const ChangeFeed feed(*store, {[&](const std::vector<Changed>& changes) {
                                   for (const Changed& change : changes) notifier.changed(change.id);
                                 },
                                 [] {}});
  Deadlines deadlines(*store);
  const std::int64_t start = now_ms();
  const std::string late = post(start + 300'000);
  deadlines.notify();
  const std::string id = post(start + 300);  // becomes the next one
  std::promise<void> woken;
  notifier.wait(id, Notifier::Clock::now() + 60s, [&] { woken.set_value(); });
  deadlines.notify();
  const auto took = await(id, start);
  EXPECT_GE(took, 300);
  EXPECT_LT(took, 3000);
  EXPECT_EQ(woken.get_future().wait_for(5s), std::future_status::ready);
  EXPECT_EQ(store->get(late)->state, api::JobState::queued);
}

TEST_F(DeadlinesTest, TakesBackJobsWhoseLeaseRunsOut) {
  const std::string id = insert_id(*store);
  claim(*store, now_ms(), "gone", 200);
  const Deadlines deadlines(*store);
  for (int i = 0; i < 2000 && store->get(id)->state == api::JobState::running; ++i) std::this_thread::sleep_for(5ms);
  EXPECT_EQ(store->get(id)->state, api::JobState::queued);
}

}  // namespace
}  // namespace bahnwerk::server
