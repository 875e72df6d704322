#pragma once
/// Brings what changed in the store to those who act on it, once it is durable: at once what this process commits, by
/// asking what other processes do.
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "server/store/changes.hpp"

namespace bahnwerk::server {

class ChangeFeed {
 public:
  struct Hooks {
    /// From any thread, quick, without exceptions. A job's own commits may come twice, as every look is harmless.
    std::function<void(const std::vector<Changed>&)> changed;
    std::function<void()> all;  ///< changes may have been missed: everybody has to look
  };
  /// Tells of every change from now on. Asks the source every `interval`, with a thread of its own, where it is shared.
  ChangeFeed(ChangeSource& source, Hooks hooks, std::chrono::milliseconds interval = std::chrono::milliseconds(250));
  ~ChangeFeed();  ///< no hook is called any more
  ChangeFeed(const ChangeFeed&) = delete;
  ChangeFeed& operator=(const ChangeFeed&) = delete;

 private:
  void loop();
  void ask();

  ChangeSource& source_;
  const Hooks hooks_;
  const std::chrono::milliseconds interval_;
  std::uint64_t seen_ = 0;  ///< the asking thread's
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
