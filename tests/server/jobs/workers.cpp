#include "server/jobs/workers.hpp"

#include <cmath>

#include "../store/fixture.hpp"
#include "api/planned_job.hpp"
#include "core/base/errors.hpp"
#include "server/runtime/clock.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;
using namespace std::chrono_literals;

/// Rows that do not compress.
class Noise final : public SetpointSource {
 public:
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return 50'000; }
  double cycle_time() const override { return 0.001; }
  double duration() const override { return 49.999; }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k) *out++ = std::sin(static_cast<double>(k) * 12345.678);
  }

 private:
  std::vector<Column> columns_{{"x", "mm"}};
};

/// Plans what its spec names: {"do":"succeed"|"fail"|"crash"|"unverified"|"noise"|"loop"}.
api::PlannedJob stub(const std::string&, const std::string& spec, Progress& progress) {
  const std::string what = nlohmann::json::parse(spec).at("do");
  if (what == "fail") throw Infeasible("no motion");
  if (what == "crash") throw std::logic_error("a bug");
  if (what == "unverified") {
    auto planned = ramp_plan(3);
    planned.verified = false;
    return planned;
  }
  if (what == "noise") {
    auto planned = ramp_plan(0);
    planned.setpoints = std::make_unique<Noise>();
    return planned;
  }
  while (what == "loop") {
    progress.report("loop", 0.5);
    std::this_thread::sleep_for(2ms);
  }
  return ramp_plan(5000);
}

struct WorkersTest : StoreTest {
  Metrics metrics;
  LiveJobs live;
  Notifier notifier;
  std::unique_ptr<Workers> workers;

  void start(unsigned threads = 2, std::optional<std::chrono::milliseconds> lease = std::nullopt) {
    workers = std::make_unique<Workers>(*store, live, notifier, metrics, stub, lease);
    workers->start(threads);
  }
  std::string post(const std::string& what, int priority = 0) {
    NewJob job = new_job(priority);
    job.now = now_ms();
    job.request.document = nlohmann::json{{"do", what}}.dump();
    const std::string id = insert_id(*store, job);
    if (workers) workers->notify();
    return id;
  }
  api::Job await(const std::string& id, JobState state) {
    for (int i = 0; i < 3000; ++i) {
      const auto job = store->get(id);
      if (job->state == state) return *job;
      std::this_thread::sleep_for(5ms);
    }
    ADD_FAILURE() << id << " did not become " << api::to_string(state);
    return *store->get(id);
  }
  std::string problem(const std::string& id) { return nlohmann::json::parse(store->get(id)->error.value())["type"]; }
};

TEST_F(WorkersTest, PlansAndStores) {
  start();
  std::vector<std::string> ids;
  for (int i = 0; i < 50; ++i) ids.push_back(post("succeed"));
  for (const auto& id : ids) {
    const auto job = await(id, JobState::succeeded);
    EXPECT_EQ(job.attempt, 1);
    EXPECT_EQ(job.fraction, 1);
    EXPECT_EQ(store->series(id)->count, 5000U);
  }
  // A worker leaves the list after its job has ended in the store.
  for (int i = 0; i < 3000 && live.size() > 0; ++i) std::this_thread::sleep_for(5ms);
  EXPECT_EQ(live.size(), 0U);
}

TEST_F(WorkersTest, FailsForGood) {
  start();
  const auto infeasible = post("fail"), bug = post("crash"), unverified = post("unverified");
  await(infeasible, JobState::failed);
  await(bug, JobState::failed);
  await(unverified, JobState::failed);
  EXPECT_EQ(problem(infeasible), "/problems/infeasible");
  EXPECT_EQ(problem(bug), "/problems/internal");
  EXPECT_EQ(problem(unverified), "/problems/verification-failed");
  EXPECT_EQ(store->get(bug)->attempt, 1);
  EXPECT_FALSE(store->result(unverified));
}

TEST_F(WorkersTest, CancelsARunningJob) {
  start(1);
  const auto id = post("loop");
  await(id, JobState::running);
  store->cancel(id, now_ms());
  live.cancel(id);
  await(id, JobState::cancelled);
  EXPECT_EQ(problem(id), "/problems/cancelled");
}

TEST_F(WorkersTest, HoldsDeadlineAndBudget) {
  start(1);
  NewJob late = new_job();
  late.request.document = R"({"do":"succeed"})";
  late.request.deadline = now_ms() - 1;
  NewJob costly = new_job();
  costly.request.document = R"({"do":"loop"})";
  costly.request.time_budget = 0.05;
  const auto a = insert_id(*store, late), b = insert_id(*store, costly);
  workers->notify();
  await(a, JobState::failed);
  await(b, JobState::failed);
  EXPECT_EQ(problem(a), "/problems/deadline-exceeded");
  EXPECT_EQ(problem(b), "/problems/budget-exhausted");
}

TEST_F(WorkersTest, PutsJobsBackAtTheEnd) {
  start(2);
  const auto a = post("loop"), b = post("loop"), waiting = post("succeed");
  await(a, JobState::running);
  await(b, JobState::running);
  workers->stop_claiming();
  EXPECT_FALSE(workers->wait_idle(50ms));
  workers->interrupt();
  EXPECT_TRUE(workers->wait_idle(5s));
  for (const auto& id : {a, b, waiting}) {
    EXPECT_EQ(store->get(id)->state, JobState::queued);
    EXPECT_EQ(store->get(id)->attempt, 0);
  }
}

TEST_F(WorkersTest, LetsJobsFinishAtTheEnd) {
  start(1);
  const auto id = post("succeed");
  await(id, JobState::succeeded);
  workers->stop_claiming();
  EXPECT_TRUE(workers->wait_idle(5s));
  const auto late = post("succeed");
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(store->get(late)->state, JobState::queued);
}

TEST_F(WorkersTest, GivesUpAnUnstorableResultWhenCancelled) {
  const auto id = post("noise");
  SqliteOptions options;
  options.max_pages = 40;  // room for the job, not for 400 kB of setpoints
  open(options);
  start(1);
  await(id, JobState::running);
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(store->get(id)->state, JobState::running) << "waits for space";
  store->cancel(id, now_ms());
  live.cancel(id);
  await(id, JobState::cancelled);
  EXPECT_FALSE(store->result(id));
}

TEST_F(WorkersTest, TellsWhoWaitsOfProgress) {
  const auto id = post("loop");
  std::promise<void> woken;
  notifier.wait(
      id, Notifier::Clock::now() + 1h, [&] { woken.set_value(); }, Notifier::Clock::now());
  start(1);
  EXPECT_EQ(woken.get_future().wait_for(10s), std::future_status::ready);
}

TEST_F(WorkersTest, KeepsItsLeaseByHeartbeats) {
  start(1, 6s);  // long enough for a busy machine to be late
  const auto id = post("loop");
  await(id, JobState::running);
  const auto first = store->expire(now_ms()).next;
  ASSERT_TRUE(first) << "the lease runs";
  auto next = first;
  for (int i = 0; i < 1000 && next == first; ++i) {
    std::this_thread::sleep_for(10ms);
    const Expired expired = store->expire(now_ms());
    EXPECT_TRUE(expired.lost.empty());
    next = expired.next;
  }
  ASSERT_TRUE(next);
  EXPECT_GT(*next, *first) << "a heartbeat extends it";
  EXPECT_EQ(store->get(id)->attempt, 1);
}

TEST_F(WorkersTest, StopsWhatWasLost) {
  start(1, 300ms);
  const auto id = post("loop");
  await(id, JobState::running);
  for (int i = 0; i < 1000 && live.size() == 0; ++i) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(claim(*store, now_ms() + 60'000, "another")->attempt, 2) << "which took this one for dead";
  for (int i = 0; i < 3000 && live.size() > 0; ++i) std::this_thread::sleep_for(5ms);
  EXPECT_EQ(live.size(), 0U);
  EXPECT_EQ(store->get(id)->state, JobState::running);
  EXPECT_TRUE(store->end(id, 2, {JobState::failed, "{}", now_ms(), 0})) << "left alone";
}

}  // namespace
}  // namespace bahnwerk::server
