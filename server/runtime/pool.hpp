#pragma once
/// Threads for short blocking work (store reads, parsing, compressing), so that the threads that serve sockets never
/// wait on a disk.
#include <chrono>
#include <functional>
#include <memory>

namespace bahnwerk::server {

class Pool {
 public:
  explicit Pool(unsigned threads, int nice = 0);
  ~Pool();  ///< runs the posted work, then joins
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  /// `work` must not throw.
  void post(std::function<void()> work);
  /// Returns true when all posted work has run, false when that takes longer than `patience`.
  bool wait_idle(std::chrono::milliseconds patience);
  void join();  ///< waits for all posted work; nothing may be posted afterwards

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::server
