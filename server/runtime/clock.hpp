#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace bahnwerk::server {

/// Returns milliseconds since 1970 UTC.
inline std::int64_t now_ms() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

/// Returns the seconds since `start` on the steady clock.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The source of time of waits, deadlines, leases and progress: the machine's clocks, or in a test a time that stands
/// still until the test moves it.
class TimeSource {
 public:
  using Time = std::chrono::steady_clock::time_point;
  virtual ~TimeSource() = default;
  virtual Time now() const { return std::chrono::steady_clock::now(); }  ///< steady clock
  virtual std::int64_t now_ms() const { return server::now_ms(); }       ///< time of day
  /// Sleeps until `until` or until `signal` is notified. It may return earlier: the caller checks again.
  virtual void wait_until(std::unique_lock<std::mutex>& lock, std::condition_variable& signal, Time until) const {
    signal.wait_until(lock, until);
  }
};

/// Returns the machine's clocks.
inline const TimeSource& system_time() {
  static const TimeSource time;
  return time;
}

}  // namespace bahnwerk::server
