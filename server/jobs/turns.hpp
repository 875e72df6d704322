#pragma once
/// The order in which planners share the memory of the process: side by side, and one alone whose memory ran out beside
/// others. A plan therefore depends on its document and on the limit of memory, not on its neighbours.
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>

namespace bahnwerk::server {

class Turns {
 public:
  /// Runs `work`. If it throws std::bad_alloc and any other work ran meanwhile, it is run again when no other does,
  /// after `before_alone`; what is begun later waits until then. `ask` is called about every 50 ms of waiting; what it
  /// throws ends the wait.
  void run(const std::function<void()>& work, const std::function<void()>& ask,
           const std::function<void()>& before_alone);

 private:
  enum class Turn { beside, alone };
  class Hold;
  void wait(std::unique_lock<std::mutex>& lock, const std::function<void()>& ask, const std::function<bool()>& due);
  std::mutex mutex_;
  std::condition_variable changed_;
  unsigned running_ = 0, waiting_alone_ = 0;
  bool alone_ = false;
  std::uint64_t begun_ = 0;  ///< works begun so far
};

}  // namespace bahnwerk::server
