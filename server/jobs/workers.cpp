#include "server/jobs/workers.hpp"

#include <nlohmann/json.hpp>

#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "server/jobs/progress.hpp"
#include "server/runtime/jitter.hpp"
#include "server/runtime/log.hpp"
#include "server/runtime/memory.hpp"
#include "server/runtime/priority.hpp"
#include "server/runtime/uuid7.hpp"
#include "server/store/failure.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::chrono::seconds idle_time{1}, longest_rest{5};

}  // namespace

Workers::Workers(Store& store, LiveJobs& live, Notifier& notifier, Metrics& metrics, Planner planner,
                 WorkersOptions options)
    : store_(store),
      live_(live),
      notifier_(notifier),
      metrics_(metrics),
      planner_(std::move(planner)),
      check_(std::move(options.check)),
      name_(Uuid7().next(options.time.now_ms())),
      lease_(options.lease),
      time_(options.time) {
  heartbeat_.emplace(
      store_, live_, name_, lease_,
      [this](const std::string& id) {
        if (store_.shared()) notifier_.changed(id, Change::progress);  // clients see what is stored
      },
      time_);
}

Workers::~Workers() {
  stop_claiming();
  interrupt();
  for (auto& thread : threads_) thread.join();
}

void Workers::start(unsigned threads, int nice) {
  {
    const std::lock_guard lock(mutex_);
    active_ = threads;
  }
  for (unsigned i = 0; i < threads; ++i) {
    threads_.emplace_back([this, nice] {
      lower_priority(nice);
      loop();
    });
  }
}

void Workers::notify(std::size_t jobs) {
  {
    const std::lock_guard lock(mutex_);
    ++notifications_;
  }
  jobs > 1 ? wake_.notify_all() : wake_.notify_one();
}

Lease Workers::lease() const {
  const std::int64_t now = time_.now_ms();
  return {name_, now, lease_ ? now + lease_->count() : Lease::forever};
}

void Workers::stop_claiming() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
}

bool Workers::wait_idle(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  return idle_.wait_for(lock, patience, [&] { return active_ == 0; });
}

void Workers::interrupt() {
  {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
  }
  wake_.notify_all();
  live_.interrupt_all();
}

void Workers::sleep(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, time, [&] { return interrupted_; });
}

void Workers::loop() {
  for (;;) {
    std::uint64_t seen = 0;
    {
      const std::lock_guard lock(mutex_);
      if (stopping_) break;
      seen = notifications_;
    }
    std::optional<api::Job> job;
    try {
      const auto asked = std::chrono::steady_clock::now();
      job = store_.claim(lease());
      if (job) metrics_.claimed(seconds_since(asked));
    } catch (const std::exception& error) {
      log_failure("claim_failed", error);
      // Workers of many processes must not come back together.
      sleep(jittered(std::chrono::seconds(1)));
      continue;
    }
    if (job) {
      {
        const std::lock_guard lock(mutex_);
        ++planning_;
        memory_kept_ = true;
      }
      const bool large = job->request.document.size() >= worth_giving_back;
      run(*job);
      job.reset();
      if (large) give_back_memory();
      const std::lock_guard lock(mutex_);
      --planning_;
      continue;
    }
    std::unique_lock lock(mutex_);
    rest(lock, [&] { return stopping_ || notifications_ != seen; });
  }
  const std::lock_guard lock(mutex_);
  --active_;
  idle_.notify_all();
}

/// Waits. When no job has run for a second, the memory of the last ones is returned to the system.
void Workers::rest(std::unique_lock<std::mutex>& lock, const std::function<bool()>& due) {
  if (memory_kept_ && !wake_.wait_for(lock, idle_time, due) && planning_ == 0) {
    memory_kept_ = false;
    lock.unlock();
    give_back_planning_memory();
    lock.lock();
  }
  // Where processes share the store, the job that was looked for may have been in another's hand.
  if (lease_)
    wake_.wait_for(lock, longest_rest, due);
  else
    wake_.wait(lock, due);
}

/// Plans, after the rest of a check that was stopped at POST.
api::PlannedJob Workers::plan(const api::JobRequest& request, JobProgress& progress) {
  close_memory_reserve();
  api::PlannedJob planned;
  turns_.run(
      [&] {
        const MemoryUse use;
        if (!request.checked && check_) check_(request.document, progress);
        planned = planner_(request.kind, request.document, progress);
      },
      [&] { progress.report("waiting for memory", 0); },
      [] {
        give_back_planning_memory();
        close_memory_reserve();
      });
  return planned;
}

Workers::Persisted Workers::persist(const std::string& id, const std::function<bool()>& write,
                                    const std::function<bool()>& give_up) {
  int tries_without_memory = 5;
  for (;;) {
    try {
      if (!write()) log::warn("job_ending_ignored", {{"job", id}, {"detail", "the attempt was over already"}});
      return Persisted::yes;
    } catch (const StoreError& error) {
      log_failure("store_failed", error, {{"job", id}});
    } catch (const std::bad_alloc&) {  // other jobs may have all of it for the moment
      if (--tries_without_memory == 0) throw;
      log::error("store_failed", {{"job", id}, {"detail", "no memory"}});
    }
    {
      const std::lock_guard lock(mutex_);
      if (interrupted_) return Persisted::no;  // still `running` in the store: the next start takes it up again
    }
    for (int i = 0; i < 10; ++i) {
      if (give_up()) return Persisted::given_up;
      sleep(std::chrono::milliseconds(100));
    }
  }
}

void Workers::ask_for_cancel(LiveJob& live) {
  try {
    if (store_.cancel_requested(live.id())) live.cancel = true;
  } catch (const StoreError& error) {  // a store that comes back has it looked for again
    log_failure("cancel_not_read", error, {{"job", live.id()}});
  }
}

void Workers::look_for_cancels() {
  for (const auto& live : live_.all()) ask_for_cancel(*live);
}

void Workers::run(const api::Job& job) {
  const auto start = std::chrono::steady_clock::now();
  const std::string& id = job.id;
  const auto live = live_.add(job);
  {
    const std::lock_guard lock(mutex_);
    if (interrupted_) live->interrupt = true;
  }
  // Deadlines are times of the store's clock. Where it is not this machine's, it has said when it gave the job.
  const auto given = time_.now();
  const auto time_of_store = [&] {
    if (!store_.shared() || !job.started_at) return time_.now_ms();
    return *job.started_at + std::chrono::duration_cast<std::chrono::milliseconds>(time_.now() - given).count();
  };
  log::info("job_started", {{"job", id}, {"kind", job.request.kind}, {"attempt", job.attempt}});
  JobProgress progress(job, live, most_planning_,
                       {.publish =
                            [&] {
                              if (!store_.shared()) notifier_.changed(id, Change::progress);
                            },
                        .now_ms = [&] { return time_of_store(); },
                        .now = [&] { return time_.now(); }});
  const auto never = [] { return false; };
  std::string outcome;
  std::optional<api::PlannedJob> planned;
  std::optional<api::Problem> problem;
  std::string unverified;  // result of a plan that failed its verification
  try {
    ask_for_cancel(*live);  // one was requested between the claim and now
    progress.report("planning", 0);
    planned = plan(job.request, progress);
    if (!planned->verified) {
      unverified = api::result_text(*planned, progress);
      throw api::Problem("verification-failed",
                         planned->failure.empty() ? "The plan was not verified against its limits." : planned->failure);
    }
  } catch (...) {
    planned.reset();
    problem = api::problem_from_current_exception("/spec");
  }
  close_memory_reserve();
  bool given_up = false;
  if (planned) {
    outcome = "succeeded";
    try {
      const auto kept = persist(
          id,
          [&] {
            return store_.succeed(
                live->attempt(), *planned, time_.now_ms(), [&] { return live->revision(); }, progress);
          },
          [&] { return live->cancel.load(); });
      if (kept == Persisted::given_up) {
        given_up = true;
        problem.emplace("cancelled", "The job was cancelled while its result could not be stored.");
      }
    } catch (...) {  // the store works: the planner was stopped, or the plan's own setpoints could not be computed
      problem = api::problem_from_current_exception("/spec");
    }
  }
  if (problem && progress.stopped() == JobProgress::Stop::lost) {
    outcome = "lost";  // the store has given the job to another attempt, or ended it
  } else if (problem && progress.stopped() == JobProgress::Stop::interrupted) {
    outcome = "queued";
    persist(
        id, [&] { return store_.requeue(live->attempt(), time_.now_ms(), live->revision()); }, never);
  } else if (problem) {
    Ending ending;
    const bool cancelled = given_up || progress.stopped() == JobProgress::Stop::cancelled;
    ending.state = cancelled ? api::JobState::cancelled : api::JobState::failed;
    ending.error = problem->document("/v1/jobs/" + id).dump();
    if (!cancelled) ending.result = std::move(unverified);
    outcome = api::to_string(ending.state);
    persist(
        id,
        [&] {
          ending.now = time_.now_ms();
          ending.revision = live->revision();
          return store_.end(live->attempt(), ending);
        },
        never);
  }
  live_.remove(*live);
  const double seconds = seconds_since(start);
  metrics_.planned(job.request.kind, outcome, seconds);
  log::Fields line{{"job", id},
                   {"kind", job.request.kind},
                   {"state", outcome},
                   {"seconds", seconds},
                   {"reports", progress.reports()}};
  if (problem) line.push_back({"problem", problem->type().slug});
  if (progress.stopped() != JobProgress::Stop::none)
    line.push_back({"reports_after_stop", progress.reports_after_stop()});
  log::info("job_ended", line);
}

}  // namespace bahnwerk::server
