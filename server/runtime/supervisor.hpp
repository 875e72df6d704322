#pragma once
/// Reports the state of the process to a service manager, by datagrams to the socket that NOTIFY_SOCKET names
/// [sd_notify(3)].
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk::server {

class Supervisor {
 public:
  /// `socket` is a path, or @name in the abstract namespace; empty: there is no service manager, and nothing is sent.
  /// `watchdog` is the manager's longest interval between two signs of life; 0: none.
  explicit Supervisor(std::string_view socket, std::chrono::microseconds watchdog = {});
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Tells whether there is a service manager.
  bool present() const { return descriptor_ >= 0; }
  /// Returns the interval for calls of alive(): half of the manager's interval; without a value no call is expected.
  std::optional<std::chrono::milliseconds> heartbeat() const;

  // The following functions may be called from any thread, never block, and return whether the message was sent.
  bool ready(std::string_view status) const;
  /// Tells the manager that the end has begun and may take `within`.
  bool stopping(std::string_view status, std::chrono::milliseconds within) const;
  bool alive() const;

 private:
  bool send(const std::string& message) const;
  std::string address_;  ///< a sockaddr_un as bytes
  int descriptor_ = -1;
  std::chrono::microseconds watchdog_;
};

/// Returns the manager's interval between signs of life of process `pid`, from the values of WATCHDOG_USEC and
/// WATCHDOG_PID (null: not set); 0 if it expects none, or expects them of another process.
std::chrono::microseconds watchdog_interval(const char* usec, const char* watched, int pid);

}  // namespace bahnwerk::server
