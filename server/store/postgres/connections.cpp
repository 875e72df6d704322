#include "server/store/postgres/connections.hpp"

namespace bahnwerk::server {

std::unique_ptr<PostgresConnection> PostgresConnections::make() const {
  state_.begin_attempt();
  try {
    auto connection = std::make_unique<PostgresConnection>(url_, patience_, session_);
    state_.connected(connection->read_only());
    return connection;
  } catch (const std::exception& error) {
    state_.failed(error.what());
    throw;
  }
}

StoreConnections PostgresConnections::counts() const {
  const std::lock_guard lock(mutex_);
  return {.busy = used_, .idle = free_.size(), .most = most_};
}

std::unique_ptr<PostgresConnection> PostgresConnections::take() {
  {
    std::unique_lock lock(mutex_);
    if (!given_back_.wait_for(lock, patience_.lengthy, [this] { return used_ < most_; }))
      throw StoreError("the store is busy: all its connections are in use", false, true);
    ++used_;
    while (!free_.empty()) {
      auto connection = std::move(free_.back());
      free_.pop_back();
      if (!connection->idle()) {
        state_.lost();
        continue;
      }
      if (!connection->stopgap()) return connection;
      if (state_.search()) break;  // this caller looks for one that can be written
      if (state_.now() != StoreState::up) return connection;
    }
  }
  try {
    return make();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    --used_;
    given_back_.notify_one();
    throw;
  }
}

void PostgresConnections::give(std::unique_ptr<PostgresConnection> connection) {
  connection->rollback();
  // Once there is a server that can be written, those that can only be read are left.
  const bool left = connection->stopgap() && state_.now() == StoreState::up;
  const bool good = !left && connection->idle();
  if (good) {
    state_.read_only(connection->read_only());
    state_.answered();
  } else if (!left) {
    state_.lost();
  }
  const std::lock_guard lock(mutex_);
  --used_;
  if (good) free_.push_back(std::move(connection));
  given_back_.notify_one();
}

}  // namespace bahnwerk::server
