#pragma once
/// Delivers the callbacks of ended jobs. The store is their outbox: it marks a callback as due in the transaction that
/// ends the job, and what is due is tried until a receiver has answered with 2xx, or 24 hours have passed. A delivery
/// whose record was lost with the process is made again.
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "server/callbacks/callback_hosts.hpp"
#include "server/http/message.hpp"
#include "server/runtime/look_thread.hpp"
#include "server/runtime/metrics.hpp"
#include "server/runtime/pool.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

inline constexpr std::int64_t callback_patience_ms =
    86'400'000;  ///< longest time from the end of the job to an attempt
/// Returns the time in ms until the next attempt after `failures` failed ones: 2 s, doubled each time, at most an hour,
/// and of that a share of one half to one, which `jitter` (0 to 1) gives: receivers that come back are not asked by all
/// at the same time.
std::int64_t callback_delay_ms(int failures, double jitter);
/// Returns the header Bahnwerk-Signature of a body: t=UNIX,v1=HEX, the HMAC-SHA-256 of "UNIX.body".
std::string callback_signature(const std::string& secret, std::int64_t unix_time, std::string_view body);

class Callbacks {
 public:
  /// Sends a body to a URL and returns the status of the answer; throws std::exception with a reason. `stop` is asked
  /// meanwhile.
  using Send = std::function<int(const std::string& url, const Pairs& headers, const std::string& body,
                                 const std::function<bool()>& stop)>;
  /// `threads` deliveries run at a time, two of one receiver (its scheme, host and port) at most, and one where the
  /// last one failed; receivers that fail have half of the threads, so that others do not wait for them.
  Callbacks(Store& store, Metrics& metrics, Send send, unsigned threads, const TimeSource& time = system_time());
  ~Callbacks();
  Callbacks(const Callbacks&) = delete;
  Callbacks& operator=(const Callbacks&) = delete;

  void notify() { thread_.notify(); }  ///< has to be called when jobs have ended
  void stop();  ///< begins no more deliveries and ends those that wait for an answer; they are tried again
  /// Returns whether all deliveries have ended, which `stop` has told to, within `patience`.
  bool wait_idle(std::chrono::milliseconds patience) { return pool_.wait_idle(patience); }

 private:
  struct Receiver {
    std::set<std::string> jobs;  ///< jobs whose callbacks are being delivered
    bool failing = false;
  };
  std::chrono::milliseconds look();
  bool begin_one(const std::string& name, std::int64_t now);
  bool may_begin(const Receiver& receiver) const;
  void deliver(const DueCallback& callback);
  void record(const CallbackAttempt& attempt);

  Store& store_;
  Metrics& metrics_;
  const Send send_;
  const unsigned threads_;
  const TimeSource& time_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::map<std::string, Receiver> receivers_;
  unsigned running_ = 0, failing_ = 0;  ///< deliveries, and those to receivers that failed when they were begun
  bool stop_ = false;
  Pool pool_;
  LookThread thread_;
};

/// Returns the Send of the service: HTTP within 10 s, to allowed hosts and addresses alone; redirects are answers like
/// others.
Callbacks::Send http_sender(CallbackHosts hosts);

}  // namespace bahnwerk::server
