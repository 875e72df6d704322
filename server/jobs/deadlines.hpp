#pragma once
/// Ends queued jobs when their deadline passes, even if no worker is free, and takes back running ones whose lease runs
/// out. One thread sleeps until the next of both, at most ten seconds, since other processes may have added one.
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "server/runtime/clock.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

class Deadlines {
 public:
  /// Ends jobs whose deadline passed while no process served, then starts the thread. `looked` is called after every
  /// look at the store that succeeded.
  explicit Deadlines(Store& store, const TimeSource& time = system_time(),
                     std::function<void(const Expired&)> looked = {});
  ~Deadlines();
  Deadlines(const Deadlines&) = delete;
  Deadlines& operator=(const Deadlines&) = delete;

  void notify();  ///< has to be called when a job was queued

 private:
  std::int64_t look();  ///< ends what is due; returns how long (ms) to sleep if not notified
  void loop();

  Store& store_;
  const TimeSource& time_;
  const std::function<void(const Expired&)> looked_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::uint64_t notifications_ = 0;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
