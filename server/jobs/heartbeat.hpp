#pragma once
/// Extends the leases of the attempts that run in this process, and stops those that were lost.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "server/jobs/live.hpp"
#include "server/runtime/clock.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

class Heartbeat {
 public:
  /// Extends the leases to `lease` from now, three times within that time.
  Heartbeat(Store& store, LiveJobs& live, std::string worker, std::chrono::milliseconds lease,
            const TimeSource& time = system_time());
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

 private:
  void loop();
  bool beat();  ///< returns whether the store was reached

  Store& store_;
  LiveJobs& live_;
  const std::string worker_;
  const std::chrono::milliseconds lease_;
  const TimeSource& time_;
  TimeSource::Time next_;  ///< next extension
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
