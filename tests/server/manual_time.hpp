#pragma once
/// A time that stands still until the test moves it.
#include <atomic>

#include "server/runtime/clock.hpp"

namespace bahnwerk::server {

class ManualTime final : public TimeSource {
 public:
  Time now() const override { return start_ + std::chrono::milliseconds(elapsed_); }
  std::int64_t now_ms() const override { return start_ms_ + elapsed_ + set_; }
  /// Looks at the time again after a moment, so that nobody needs to be told that it has moved.
  void wait_until(std::unique_lock<std::mutex>& lock, std::condition_variable& signal, Time) const override {
    signal.wait_for(lock, std::chrono::milliseconds(1));
  }
  void advance(std::chrono::milliseconds by) { elapsed_ += by.count(); }
  /// Sets the time of day, and no steady clock, as an administrator or a time server does.
  void set_clock(std::chrono::milliseconds by) { set_ += by.count(); }

 private:
  const Time start_ = std::chrono::steady_clock::now();
  const std::int64_t start_ms_ = server::now_ms();
  std::atomic<std::int64_t> elapsed_{0}, set_{0};
};

}  // namespace bahnwerk::server
