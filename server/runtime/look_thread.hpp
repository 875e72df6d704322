#pragma once
/// A thread that looks at something again and again.
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "server/runtime/clock.hpp"

namespace bahnwerk::server {

class LookThread {
 public:
  /// Looks at once, then whenever the time that the last look returned has passed, or notify() was called since that
  /// look began. `look` must not throw.
  explicit LookThread(std::function<std::chrono::milliseconds()> look, const TimeSource& time = system_time());
  ~LookThread() { stop(); }
  LookThread(const LookThread&) = delete;
  LookThread& operator=(const LookThread&) = delete;

  void notify();
  void stop();  ///< waits for the look that is going on; none begins afterwards

 private:
  void loop();

  const std::function<std::chrono::milliseconds()> look_;
  const TimeSource& time_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::uint64_t notifications_ = 0;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
