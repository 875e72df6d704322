#pragma once
/// A posted job on its way into a PostgreSQL store.
#include <exception>
#include <functional>
#include <string>

#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {

struct PostgresStore::Post {
  NewJob job;
  std::string id, packed;  ///< given before it is stored; its document
  std::function<void(Inserted, std::exception_ptr)> done;
  Inserted outcome = {};
};

}  // namespace bahnwerk::server
