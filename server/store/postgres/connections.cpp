#include "server/store/postgres/connections.hpp"

namespace bahnwerk::server {

std::unique_ptr<PostgresConnection> PostgresConnections::take() {
  {
    std::unique_lock lock(mutex_);
    if (!given_back_.wait_for(lock, patience_.lengthy, [this] { return used_ < most_; }))
      throw StoreError("the store is busy: all its connections are in use", false, true);
    ++used_;
    while (!free_.empty()) {
      auto connection = std::move(free_.back());
      free_.pop_back();
      if (connection->idle()) return connection;
      lost();
    }
  }
  try {
    return make();
  } catch (...) {
    lost();
    const std::lock_guard lock(mutex_);
    --used_;
    given_back_.notify_one();
    throw;
  }
}

void PostgresConnections::give(std::unique_ptr<PostgresConnection> connection) {
  connection->rollback();
  const bool good = connection->idle();
  if (!good) lost();
  const std::lock_guard lock(mutex_);
  --used_;
  if (good) free_.push_back(std::move(connection));
  given_back_.notify_one();
}

std::chrono::milliseconds PostgresConnections::unbroken() const {
  const std::chrono::steady_clock::time_point since{std::chrono::steady_clock::duration(unbroken_since_.load())};
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - since);
}

void PostgresConnections::lost() { unbroken_since_ = std::chrono::steady_clock::now().time_since_epoch().count(); }

}  // namespace bahnwerk::server
