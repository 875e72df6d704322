#pragma once
/// What a process knows of its PostgreSQL server: whether it answers, since when, and when to connect again. Shared by
/// all connections of the process; its methods may be called from any thread.
#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "server/store/values.hpp"

namespace bahnwerk::server {

/// Returns how long to wait before the next attempt to connect after so many failures: up to 0.1 s after the first and
/// 10 s after many, drawn evenly, so that processes do not come back together. `share` is from 0 to 1.
std::chrono::milliseconds reconnection_delay(int failures, double share);

class PostgresServerState {
 public:
  /// `silence`: see PostgresPatience.
  /// What is logged begins with `name`.
  explicit PostgresServerState(std::chrono::milliseconds silence, std::string name = "store")
      : silence_(silence), name_(std::move(name)) {}
  StoreState now() const;
  /// Has to be called before a connection is made. While the server is away, throws StoreAway until the delay has
  /// passed, and while another thread tries.
  void begin_attempt();
  void connected(bool read_only);       ///< a connection was made
  void failed(const std::string& why);  ///< none could be made; logged once a second at most
  void read_only(bool value);           ///< the server has said so over a connection
  /// Returns whether to look for a server that can be written, where this one can only be read: for one caller, once
  /// a second.
  bool search();
  void lost();      ///< a connection was lost
  void answered();  ///< a call was answered; where none was for longer than `silence`, that was an outage

  /// Returns how long the server has been there for this process, to be written, without a gap.
  std::chrono::milliseconds unbroken() const;
  /// Returns the time since the end of the last outage; nullopt if the process has seen none. Its start is none.
  std::optional<std::chrono::milliseconds> since_outage() const;

 private:
  using Clock = std::chrono::steady_clock;
  void enter(StoreState state);
  void outage(Clock::time_point now);
  const std::chrono::milliseconds silence_;
  const std::string name_;
  mutable std::mutex mutex_;
  StoreState state_ = StoreState::away;
  int failures_ = 0;
  bool outage_ = false;  ///< whether there was one
  Clock::time_point next_attempt_{}, searched_{}, logged_{}, unbroken_since_ = Clock::now(), answered_{};
};

}  // namespace bahnwerk::server
