#pragma once
/// Ends queued jobs when their deadline passes, even if no worker is free, and takes back running ones whose lease runs
/// out. One thread sleeps until the next of both, at most ten seconds, since other processes may have added one.
#include <chrono>
#include <functional>
#include <optional>

#include "server/runtime/look_thread.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

class Deadlines {
 public:
  /// Ends jobs whose deadline passed while no process served, then starts the thread. `looked` is called after every
  /// look at the store that succeeded.
  explicit Deadlines(Store& store, const TimeSource& time = system_time(),
                     std::function<void(const Expired&)> looked = {});

  void notify() { thread_->notify(); }  ///< has to be called when a job was queued

 private:
  std::chrono::milliseconds look();  ///< ends what is due; returns how long to sleep if not notified

  Store& store_;
  const TimeSource& time_;
  const std::function<void(const Expired&)> looked_;
  std::optional<LookThread> thread_;
};

}  // namespace bahnwerk::server
