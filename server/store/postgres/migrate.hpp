#pragma once
/// The schema `bahnwerk` of a PostgreSQL store, brought up to date by numbered SQL files under
/// server/store/postgres/migrations. Several processes may try at once.
#include <span>

#include "server/store/migration.hpp"

namespace bahnwerk::server {

class PostgresConnection;

/// Returns the migrations; `schema_version` has a row for each one that was applied.
std::span<const Migration> postgres_migrations();

/// Returns the version of the schema; 0: there is none.
int postgres_version(PostgresConnection& connection);

/// Applies what is missing, in one transaction. Throws StoreRefused where a newer version of the program wrote the
/// store and says that this one cannot use it, StoreError where another process holds the migration for a minute.
void migrate(PostgresConnection& connection);
/// Throws StoreRefused where migrate() would change something.
void require_up_to_date(PostgresConnection& connection);

}  // namespace bahnwerk::server
