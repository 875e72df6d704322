#pragma once
/// The planning threads: they claim a job from the store, plan it and store its end. They never use a socket.
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "api/documents/job.hpp"
#include "server/jobs/heartbeat.hpp"
#include "server/jobs/live.hpp"
#include "server/jobs/notifier.hpp"
#include "server/jobs/progress.hpp"
#include "server/jobs/turns.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/metrics.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

/// The planner: api::plan_job in the service, a small function in tests.
using Planner = std::function<api::PlannedJob(const std::string& kind, const std::string& document, Progress progress)>;

/// The check of a document whose check was stopped when it was posted. Throws Problem.
using Checker = std::function<void(const std::string& document, Progress progress)>;

struct WorkersOptions {
  /// Duration of an attempt without a heartbeat of this process; nullopt: until the process ends, for a store that no
  /// other process uses.
  std::optional<std::chrono::milliseconds> lease = std::nullopt;
  const TimeSource& time = system_time();  ///< time of leases, deadlines, budgets and progress
  Checker check = {};                      ///< empty: no check is repeated
};

class Workers {
 public:
  /// Progress is reported to `notifier` here, states by the store's changes.
  Workers(Store& store, LiveJobs& live, Notifier& notifier, Metrics& metrics, Planner planner, WorkersOptions options);
  ~Workers();  ///< interrupts and joins
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Limits the time of every plan; to be called before start().
  void limit_planning(std::chrono::milliseconds time) { most_planning_ = time; }
  /// `nice` is the difference of their priority to that of the answering threads (Linux).
  void start(unsigned threads, int nice = 0);
  void notify(std::size_t jobs = 1);  ///< has to be called when `jobs` jobs were queued or have ended
  void look_for_cancels();            ///< has to be called when changes may have been missed
  void stop_claiming();               ///< running jobs continue, no new ones begin
  bool wait_idle(std::chrono::milliseconds
                     patience);  ///< waits until all threads have ended, after stop_claiming; false if they have not
  void interrupt();              ///< running planners stop at their next report; their jobs go back to the queue

 private:
  Lease lease() const;
  void loop();
  void ask_for_cancel(LiveJob& live);
  void run(const api::Job& job);
  api::PlannedJob plan(const api::JobRequest& request, JobProgress& progress);
  void rest(std::unique_lock<std::mutex>& lock, const std::function<bool()>& due);
  enum class Persisted { yes, no, given_up };
  /// Stores an ending; while the store fails (disk full) it waits and tries again, until interrupted (no) or `give_up`
  /// (given_up).
  Persisted persist(const std::string& id, const std::function<bool()>& write, const std::function<bool()>& give_up);
  void sleep(std::chrono::milliseconds time);

  Store& store_;
  LiveJobs& live_;
  Notifier& notifier_;
  Metrics& metrics_;
  Planner planner_;
  Checker check_;
  std::optional<std::chrono::milliseconds> most_planning_;
  Turns turns_;
  const std::string name_;  ///< name of this process, new at every start
  const std::optional<std::chrono::milliseconds> lease_;
  const TimeSource& time_;  ///< time of leases, deadlines, budgets and progress
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  std::uint64_t notifications_ = 0;
  unsigned active_ = 0, planning_ = 0;  ///< threads, and those of them that have a job
  bool memory_kept_ = false;            ///< whether a job ran since memory was returned
  bool stopping_ = false, interrupted_ = false;
  std::optional<Heartbeat> heartbeat_;  ///< begins when all else is made
  std::vector<std::thread> threads_;
};

}  // namespace bahnwerk::server
