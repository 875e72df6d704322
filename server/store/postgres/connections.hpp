#pragma once
/// The connections of a process to its PostgreSQL server: made when they are needed, at most so many, and given to one
/// caller at a time.
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/store/postgres/connection.hpp"
#include "server/store/postgres/server_state.hpp"

namespace bahnwerk::server {

class PostgresConnections {
 public:
  PostgresConnections(std::string url, PostgresPatience patience, std::size_t most, PostgresServerState& state,
                      PostgresSession session = PostgresSession::own)
      : url_(std::move(url)), patience_(patience), session_(session), most_(most), state_(state) {}

  /// A connection in use; given back by the destructor.
  class Borrowed {
   public:
    explicit Borrowed(PostgresConnections& home) : home_(home), connection_(home.take()) {}
    ~Borrowed() { home_.give(std::move(connection_)); }
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    PostgresConnection* operator->() { return connection_.get(); }
    PostgresConnection& operator*() { return *connection_; }

   private:
    PostgresConnections& home_;
    std::unique_ptr<PostgresConnection> connection_;
  };

  /// Returns a connection of its own, which does not count. Throws StoreAway, StoreRefused.
  std::unique_ptr<PostgresConnection> make() const;
  StoreConnections counts() const;

 private:
  std::unique_ptr<PostgresConnection> take();
  void give(std::unique_ptr<PostgresConnection> connection);

  const std::string url_;
  const PostgresPatience patience_;
  const PostgresSession session_;
  const std::size_t most_;
  PostgresServerState& state_;
  mutable std::mutex mutex_;
  std::condition_variable given_back_;
  std::vector<std::unique_ptr<PostgresConnection>> free_;
  std::size_t used_ = 0;
};

}  // namespace bahnwerk::server
