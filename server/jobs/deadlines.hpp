#pragma once
/// Ends queued jobs when their deadline passes, whether or not a worker is free. One thread, asleep until the next
/// deadline of the queue; without one it sleeps until a job is posted.
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include "server/jobs/notifier.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

class Deadlines {
 public:
  /// Ends what passed while nobody served, then starts the thread.
  Deadlines(Store& store, Notifier& notifier);
  ~Deadlines();
  Deadlines(const Deadlines&) = delete;
  Deadlines& operator=(const Deadlines&) = delete;

  void poke();  ///< a job with a deadline was queued

 private:
  /// Ends what is due; the time (ms since 1970 UTC) to look again, nullopt: when poked.
  std::optional<std::int64_t> look();
  void loop();

  Store& store_;
  Notifier& notifier_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::uint64_t pokes_ = 0;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
