#pragma once
/// Tells the other processes that share a PostgreSQL store of changes, and hears of theirs, by NOTIFY and LISTEN on a
/// connection of its own. A signal says that something changed, not what: one that is lost costs time alone.
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "server/store/postgres/connections.hpp"

namespace bahnwerk::server {

class PostgresSignals {
 public:
  /// `process` names this process: its own signals are not passed on.
  PostgresSignals(const PostgresConnections& connections, std::string process);
  ~PostgresSignals();
  PostgresSignals(const PostgresSignals&) = delete;
  PostgresSignals& operator=(const PostgresSignals&) = delete;

  /// Has to be called after a commit. The signal is sent outside of transactions, since it locks the whole server until
  /// its own is over: at once, but at most 50 times a second, and four times more at once after a rest.
  void tell();
  /// `call` is called after signals of others and after each connection; see ChangeSource::listen_to_others.
  void listen(std::function<void()> call);

 private:
  void loop();
  void serve(PostgresConnection& connection);
  void call();
  void rest(std::chrono::milliseconds time) const;  ///< waits, unless the end comes first

  const PostgresConnections& connections_;
  const std::string process_;
  const int wake_;  ///< descriptor that can be read when there is something to tell, or the end has come
  std::mutex mutex_;
  bool due_ = false, stop_ = false;
  std::mutex listener_mutex_;
  std::function<void()> listener_;
  std::thread thread_;
};

}  // namespace bahnwerk::server
