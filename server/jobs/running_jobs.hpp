#pragma once
/// The jobs that run, with the revisions of their progress that clients may see. Where processes share the store, these
/// are the stored jobs of all processes; else they are the jobs of this process, as they are now.
#include <mutex>
#include <optional>
#include <vector>

#include "server/jobs/live.hpp"
#include "server/jobs/notifier.hpp"
#include "server/runtime/look_thread.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

class RunningJobs {
 public:
  /// With a store that is shared, looks once a second as long as anybody waits with `notifier`, and reports progress.
  RunningJobs(Store& store, const LiveJobs& live, Notifier& notifier, const TimeSource& time = system_time());

  /// Returns the jobs that run, at most a second old. May read the store; throws StoreError.
  std::vector<Running> all();
  void changed();  ///< has to be called when a job's state has changed: the next call of all() looks again

 private:
  std::vector<Running> look();
  void report();

  Store& store_;
  const LiveJobs& live_;
  Notifier& notifier_;
  const TimeSource& time_;
  std::mutex mutex_;
  std::optional<TimeSource::Time> looked_;
  std::vector<Running> seen_;
  std::vector<Running> reported_;     ///< used by the thread alone
  std::optional<LookThread> thread_;  ///< none if the store is not shared
};

}  // namespace bahnwerk::server
