#pragma once
/// A reading connection borrowed from the store: taken by the constructor, returned by the destructor.
#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {

class SqliteStore::Reader {
 public:
  explicit Reader(SqliteStore& store) : store_(store) {
    {
      const std::lock_guard lock(store_.readers_mutex_);
      if (!store_.readers_.empty()) {
        connection_ = std::move(store_.readers_.back());
        store_.readers_.pop_back();
      }
    }
    if (!connection_) connection_ = std::make_unique<SqliteConnection>(store_.options_.path, false);
  }
  ~Reader() {
    const std::lock_guard lock(store_.readers_mutex_);
    store_.readers_.push_back(std::move(connection_));
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  SqliteConnection& connection() { return *connection_; }
  Query query(std::string_view sql) { return connection_->query(sql); }

 private:
  SqliteStore& store_;
  std::unique_ptr<SqliteConnection> connection_;
};

}  // namespace bahnwerk::server
