#include "server/jobs/workers.hpp"

#include <cmath>
#include <new>

#include "../manual_time.hpp"
#include "../store/fixture.hpp"
#include "api/planned_job.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/large_pages.hpp"

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
    if (first + rows == count()) ++read_whole;
    for (std::size_t k = first; k < first + rows; ++k) *out++ = std::sin(static_cast<double>(k) * 12345.678);
  }

  static inline std::atomic<int> read_whole{0};  ///< how often all rows have been read

 private:
  std::vector<Column> columns_{{"x", "mm"}};
};

/// What lets a planner go on that waits for it.
std::atomic<bool> latch{false};
/// Whether a plan "latch" has begun, which is some time after its job is running.
std::atomic<bool> at_latch{false};

/// Number of plans that need all memory and have begun; the first one with company finds none.
std::atomic<int> greedy{0};

/// Plans what its spec names: {"do":"succeed"|"fail"|"crash"|"unverified"|"noise"|"loop"|"latch"|"greedy"|"endless"}.
api::PlannedJob stub(const std::string&, const std::string& spec, Progress progress) {
  const std::string what = nlohmann::json::parse(spec).at("do");
  if (what == "latch") at_latch = true;
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
  if (what == "endless") throw std::bad_alloc();
  if (what == "greedy" && ++greedy == 1) {
    latch = true;
    throw std::bad_alloc();
  }
  if (what == "succeed") const LargeVector<double> array(100'000);
  while (what == "loop" || (what == "latch" && !latch)) {
    progress.report("loop", 0.5);
    std::this_thread::sleep_for(2ms);
  }
  return ramp_plan(5000);
}

struct WorkersTest : StoreTest {
  ManualTime time;
  Metrics metrics;
  LiveJobs live;
  Notifier notifier;
  std::unique_ptr<Workers> workers;

  void start(unsigned threads = 2, std::optional<std::chrono::milliseconds> lease = std::nullopt) {
    workers = std::make_unique<Workers>(*store, live, notifier, metrics, stub, WorkersOptions{lease, time});
    workers->start(threads);
  }
  std::string post(const std::string& what, int priority = 0) {
    NewJob job = new_job(priority);
    job.now = time.now_ms();
    job.request.document = nlohmann::json{{"do", what}}.dump();
    const std::string id = insert_id(*store, job);
    if (workers) workers->notify();
    return id;
  }
  /// Whether `condition` has come true, within 30 s.
  template <class Condition>
  static bool soon(Condition condition) {
    for (int i = 0; i < 6000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  }
  api::Job await(const std::string& id, JobState state) {
    if (soon([&] { return store->get(id)->state == state; })) return *store->get(id);
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
  EXPECT_NE(metrics.text().find("\nbahnwerk_claim_seconds_count 50\n"), std::string::npos) << "each job, once";
  // A worker leaves the list after its job has ended in the store.
  EXPECT_TRUE(soon([&] { return live.size() == 0; }));
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
  EXPECT_FALSE(store->result(infeasible));
  // What was planned can be had, with the checks that it fails, but no setpoints.
  ASSERT_TRUE(store->result(unverified));
  EXPECT_EQ(nlohmann::json::parse(*store->result(unverified)), nlohmann::json(ramp_plan(3).result));
  EXPECT_FALSE(store->series(unverified));
}

TEST_F(WorkersTest, APlanForWhichMemoryIsMissingEndsAsBudgetExhausted) {
  start(1);
  const auto id = post("endless"), next = post("succeed");
  await(id, JobState::failed);
  EXPECT_EQ(problem(id), "/problems/budget-exhausted");
  await(next, JobState::succeeded);
}

TEST_F(WorkersTest, MemoryThatNeighboursTakeEndsNoJob) {
  latch = at_latch = false;
  greedy = 0;
  start(2);
  const auto neighbour = post("latch");
  EXPECT_TRUE(soon([] { return at_latch.load(); }));
  const auto id = post("greedy");
  await(id, JobState::succeeded);
  await(neighbour, JobState::succeeded);
  EXPECT_EQ(greedy, 2) << "planned again, alone";
  EXPECT_EQ(store->get(id)->attempt, 1);
}

TEST_F(WorkersTest, ReturnsTheMemoryOfPlansWhenIdle) {
  start(2);
  await(post("succeed"), JobState::succeeded);
  EXPECT_TRUE(soon([] { return large_pages::kept() == 0; }));
}

TEST_F(WorkersTest, LimitsTheTimeOfEveryPlan) {
  workers = std::make_unique<Workers>(*store, live, notifier, metrics, stub, WorkersOptions{.time = time});
  workers->limit_planning(600s);
  workers->start(1);
  const auto id = post("loop");
  await(id, JobState::running);
  EXPECT_TRUE(soon([&] { return live.size() == 1; }));
  EXPECT_TRUE(soon([&] {
    time.advance(600s);
    return store->get(id)->state == JobState::failed;
  }));
  EXPECT_EQ(problem(id), "/problems/budget-exhausted");
}

TEST_F(WorkersTest, CancelsARunningJob) {
  start(1);
  const auto id = post("loop");
  await(id, JobState::running);
  store->cancel(id, time.now_ms());
  live.cancel(id);
  await(id, JobState::cancelled);
  EXPECT_EQ(problem(id), "/problems/cancelled");
}

TEST_F(WorkersTest, HoldsDeadlineAndBudget) {
  start(1);
  NewJob late = new_job();
  late.request.document = R"({"do":"succeed"})";
  late.request.deadline = time.now_ms() - 1;
  NewJob costly = new_job();
  costly.request.document = R"({"do":"loop"})";
  costly.request.time_budget = 50;
  const auto a = insert_id(*store, late), b = insert_id(*store, costly);
  workers->notify();
  await(a, JobState::failed);
  await(b, JobState::running);
  EXPECT_TRUE(soon([&] {
    time.advance(50s);
    return store->get(b)->state == JobState::failed;
  }));
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
  EXPECT_TRUE(workers->wait_idle(30s));
  for (const auto& id : {a, b, waiting}) {
    EXPECT_EQ(store->get(id)->state, JobState::queued);
    EXPECT_EQ(store->get(id)->attempt, 0);
  }
}

TEST_F(WorkersTest, LetsJobsFinishAtTheEnd) {
  start(1);
  latch = false;
  const auto id = post("latch"), late = post("succeed");
  await(id, JobState::running);
  workers->stop_claiming();
  latch = true;
  EXPECT_TRUE(workers->wait_idle(30s));
  EXPECT_EQ(store->get(id)->state, JobState::succeeded);
  EXPECT_EQ(store->get(late)->state, JobState::queued) << "nothing new was begun";
}

TEST_F(WorkersTest, GivesUpAnUnstorableResultWhenCancelled) {
  const auto id = post("noise");
  SqliteOptions options;
  options.max_pages = 40;  // room for the job, not for 400 kB of setpoints
  open(options);
  Noise::read_whole = 0;
  start(1);
  EXPECT_TRUE(soon([] { return Noise::read_whole >= 2; })) << "tries to store it, and tries again";
  EXPECT_EQ(store->get(id)->state, JobState::running) << "waits for space";
  store->cancel(id, time.now_ms());
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
  EXPECT_EQ(woken.get_future().wait_for(30s), std::future_status::ready);
}

TEST_F(WorkersTest, KeepsItsLeaseByHeartbeats) {
  start(1, 6s);
  const auto id = post("loop");
  await(id, JobState::running);
  EXPECT_TRUE(soon([&] { return live.size() == 1; }));
  for (int beat = 1; beat <= 4; ++beat) {
    EXPECT_EQ(store->expire(time.now_ms()).next, time.now_ms() + 6000) << "the lease runs";
    time.advance(2s);
    EXPECT_TRUE(soon([&] { return store->expire(time.now_ms()).next == time.now_ms() + 6000; }))
        << "a heartbeat extends it";
  }
  EXPECT_EQ(store->get(id)->attempt, 1);
}

TEST_F(WorkersTest, StopsWhatWasLost) {
  start(1, 300ms);
  const auto id = post("loop");
  await(id, JobState::running);
  EXPECT_TRUE(soon([&] { return live.size() == 1; }));
  EXPECT_EQ(claim(*store, time.now_ms() + 60'000, "another")->attempt, 2) << "which took this one for dead";
  time.advance(100ms);  // a heartbeat is told
  EXPECT_TRUE(soon([&] { return live.size() == 0; }));
  EXPECT_EQ(store->get(id)->state, JobState::running);
  EXPECT_TRUE(store->end({id, 2}, {JobState::failed, "{}", time.now_ms(), 0})) << "left alone";
}

}  // namespace
}  // namespace bahnwerk::server
