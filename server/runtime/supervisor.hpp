#pragma once
/// Tells a service manager how the process is, by datagrams to the socket that NOTIFY_SOCKET names [sd_notify(3)].
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk::server {

class Supervisor {
 public:
  /// `socket`: a path, or @name in the abstract namespace; empty: there is no service manager, nothing is told.
  /// `watchdog`: how long the manager lets pass between two signs of life, 0: it expects none.
  explicit Supervisor(std::string_view socket, std::chrono::microseconds watchdog = {});
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Whether messages have a place to go to.
  bool present() const { return descriptor_ >= 0; }
  /// How often to call alive(): half of what the manager lets pass; without a value it expects no call.
  std::optional<std::chrono::milliseconds> heartbeat() const;

  // Each may be called from any thread, never blocks, and returns whether the message was handed over.
  bool ready(std::string_view status) const;
  /// The end has begun and may take `within`.
  bool stopping(std::string_view status, std::chrono::milliseconds within) const;
  bool alive() const;

 private:
  bool send(const std::string& message) const;
  std::string address_;  ///< a sockaddr_un as bytes
  int descriptor_ = -1;
  std::chrono::microseconds watchdog_;
};

/// What the manager lets pass between signs of life of process `pid`, from the values of WATCHDOG_USEC and WATCHDOG_PID
/// (null: not set); 0 where it expects none, or expects them of another process.
std::chrono::microseconds watchdog_interval(const char* usec, const char* watched, int pid);

}  // namespace bahnwerk::server
