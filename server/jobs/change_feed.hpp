#pragma once
/// Passes changes of the store, once durable, to the parts that act on them: commits of this process at once, those of
/// other processes by polling.
#include <chrono>
#include <functional>
#include <optional>

#include "server/runtime/look_thread.hpp"
#include "server/store/changes.hpp"

namespace bahnwerk::server {

class ChangeFeed {
 public:
  struct Hooks {
    /// Receives changes on any thread; it has to be quick and must not throw. A job's own commits may be reported
    /// twice.
    std::function<void(const std::vector<Changed>&)> changed;
    std::function<void()> all;  ///< changes may have been missed: every job has to be checked
    /// All changes of other processes were known when it was called.
    std::function<void()> caught_up = [] {};
  };
  /// Reports every change from now on. If the source is shared, asks it on a thread of its own: when others signal a
  /// change, and else about every `interval`, half as long at least and half as long again at most. Where the source
  /// was away, every job has to be checked afterwards.
  ChangeFeed(ChangeSource& source, Hooks hooks, std::chrono::milliseconds interval = std::chrono::milliseconds(250));
  ~ChangeFeed();  ///< ends the reports: no hook is called afterwards
  ChangeFeed(const ChangeFeed&) = delete;
  ChangeFeed& operator=(const ChangeFeed&) = delete;

 private:
  void begin();
  void ask();
  void ask_all();

  ChangeSource& source_;
  const Hooks hooks_;
  const std::chrono::milliseconds interval_;
  std::optional<std::uint64_t> seen_;  ///< number of the last change seen; the polling thread alone uses it
  bool away_ = false;                  ///< whether the source failed the last time
  std::optional<LookThread> thread_;   ///< none if the source is not shared
};

}  // namespace bahnwerk::server
