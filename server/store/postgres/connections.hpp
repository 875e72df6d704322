#pragma once
/// The connections of a process to its PostgreSQL server: made when they are needed, at most so many, and given to one
/// caller at a time.
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/store/postgres/connection.hpp"

namespace bahnwerk::server {

class PostgresConnections {
 public:
  PostgresConnections(std::string url, PostgresPatience patience, std::size_t most)
      : url_(std::move(url)), patience_(patience), most_(most) {}

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

  /// Returns a connection of its own, which does not count. Throws StoreAway, StoreError.
  std::unique_ptr<PostgresConnection> make() const { return std::make_unique<PostgresConnection>(url_, patience_); }

  /// Returns how long no connection has been lost: what other processes hear of this one may be older otherwise.
  std::chrono::milliseconds unbroken() const;
  void lost();  ///< a connection was lost, this one's or one of its own

 private:
  std::unique_ptr<PostgresConnection> take();
  void give(std::unique_ptr<PostgresConnection> connection);

  const std::string url_;
  const PostgresPatience patience_;
  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable given_back_;
  std::vector<std::unique_ptr<PostgresConnection>> free_;
  std::size_t used_ = 0;
  std::atomic<std::chrono::steady_clock::rep> unbroken_since_ =
      std::chrono::steady_clock::now().time_since_epoch().count();
};

}  // namespace bahnwerk::server
