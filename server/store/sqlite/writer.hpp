#pragma once
/// Group commit: one thread owns the writing connection; whatever waits when it comes round shares one transaction.
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "server/store/sqlite/connection.hpp"

namespace bahnwerk::server {

class Writer {
 public:
  /// May run more than once: when a group fails, each of its works is tried alone, in a transaction of its own.
  using Work = std::function<void(Connection&)>;
  /// Called once after the commit (nullptr) or with what went wrong; on the writer's thread, so it must be quick.
  using Done = std::function<void(std::exception_ptr)>;
  /// Told of every commit: seconds, works in it.
  using Observer = std::function<void(double, std::size_t)>;

  Writer(Connection& connection, Observer observer);
  ~Writer();  ///< does what was posted, then ends
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void post(Work work, Done done);
  void run(const Work& work);  ///< posts and waits; rethrows

 private:
  struct Item {
    Work work;
    Done done;
  };
  void loop();
  void commit(std::deque<Item>& group);

  Connection& connection_;
  Observer observer_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Item> waiting_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
