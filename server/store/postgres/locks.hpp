#pragma once
/// Locks that a transaction holds until its end, so that one process at a time does what all could do. They are only
/// tried, never waited for.
#include <cstdint>

#include "server/store/postgres/connection.hpp"

namespace bahnwerk::server {

enum class PostgresLock : std::int64_t { migration = 0x6261686e77657201, maintenance, sweeping, retention, none };

inline bool try_lock(PostgresConnection& connection, PostgresLock lock) {
  return connection.run("SELECT pg_try_advisory_xact_lock($1)", PostgresParameters() << static_cast<std::int64_t>(lock))
      .flag(0, 0);
}

}  // namespace bahnwerk::server
