#pragma once
/// Tells the store once a second of the attempts that run in this process: how far they are, and, where their leases
/// have an end, that they go on. Stops those that were lost or cancelled.
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "server/jobs/live.hpp"
#include "server/runtime/clock.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

class Heartbeat {
 public:
  /// Extends the leases to `lease` from now, each second, and three times within that time at least; nullopt: leases
  /// have no end, and only news is told. `stored` is called with the id of each job whose new progress was stored.
  Heartbeat(Store& store, LiveJobs& live, std::string worker, std::optional<std::chrono::milliseconds> lease,
            std::function<void(const std::string&)> stored, const TimeSource& time = system_time());
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

 private:
  void loop();
  void beat();

  Store& store_;
  LiveJobs& live_;
  const std::string worker_;
  const std::optional<std::chrono::milliseconds> lease_;
  const std::function<void(const std::string&)> stored_;
  const TimeSource& time_;
  const std::chrono::milliseconds interval_;
  TimeSource::Time next_;                      ///< next heartbeat
  std::map<std::string, std::uint64_t> told_;  ///< last revisions stored, of what runs; used by the thread alone
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
