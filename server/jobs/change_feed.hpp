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
  };
  /// Reports every change from now on. Polls the source every `interval`, on its own thread, if it is shared.
  ChangeFeed(ChangeSource& source, Hooks hooks, std::chrono::milliseconds interval = std::chrono::milliseconds(250));
  ~ChangeFeed();  ///< ends the reports: no hook is called afterwards
  ChangeFeed(const ChangeFeed&) = delete;
  ChangeFeed& operator=(const ChangeFeed&) = delete;

 private:
  void ask();
  void ask_all();

  ChangeSource& source_;
  const Hooks hooks_;
  const std::chrono::milliseconds interval_;
  std::uint64_t seen_ = 0;            ///< number of the last change seen; the polling thread alone uses it
  std::optional<LookThread> thread_;  ///< none if the source is not shared
};

}  // namespace bahnwerk::server
