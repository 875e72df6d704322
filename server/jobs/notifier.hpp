#pragma once
/// Calls waiters for a change of a job back once: when it changed, when the time is over, or at the end of service. No
/// thread blocks per waiter: one thread manages the deadlines.
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/runtime/clock.hpp"

namespace bahnwerk::server {

enum class Change { state, progress };

class Notifier {
 public:
  using Token = std::uint64_t;
  using Clock = std::chrono::steady_clock;
  static constexpr std::string_view any_job = "*";  ///< the name under which waiters for any job wait

  explicit Notifier(const TimeSource& time = system_time());
  ~Notifier();  ///< calls all remaining waiters
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  /// A change of state wakes every waiter. Progress alone wakes those with `progress_from`, not before that time: a
  /// waiter that returns at once is called as often as it allows, not as often as the planner reports. `wake` is called
  /// from any thread and must be quick.
  Token wait(const std::string& job, Clock::time_point until, std::function<void()> wake,
             std::optional<Clock::time_point> progress_from = std::nullopt);
  bool watched() const;    ///< whether anybody waits
  void wake(Token token);  ///< calls this one now, unless it was called already
  void changed(const std::string& job, Change change = Change::state);
  void all_changed();
  void release();  ///< calls all, and from now on each new one at once

 private:
  struct Waiter {
    std::string job;
    Clock::time_point until;
    std::function<void()> wake;
    std::optional<Clock::time_point> progress_from;
  };
  using Waiters = std::map<Token, Waiter>;
  void loop();

  const TimeSource& time_;
  mutable std::mutex mutex_;
  std::condition_variable tick_;
  Token next_ = 1;
  Waiters waiters_;
  std::multimap<std::string, Token> by_job_;
  std::multimap<Clock::time_point, Token> by_time_;
  std::vector<std::function<void()>> take_all();         ///< removes and returns all callbacks; needs the lock
  std::function<void()> take(Waiters::iterator waiter);  ///< removes it from all indexes; under the lock
  void advance(Waiters::iterator waiter, Clock::time_point until);  ///< an earlier time for it; under the lock
  bool released_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
