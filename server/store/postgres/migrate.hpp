#pragma once
/// The schema `bahnwerk` of a PostgreSQL store, brought up to date by numbered SQL files under
/// server/store/postgres/migrations. Several processes may try at once, and others may use the store meanwhile. A file
/// is one transaction, or one statement CREATE INDEX CONCURRENTLY, which makes an index that has the name of the file
/// behind its number, on a table named with its schema.
#include <span>

#include "server/store/migration.hpp"

namespace bahnwerk::server {

class PostgresConnection;

/// Returns the migrations; `schema_version` has a row for each one that was applied.
std::span<const Migration> postgres_migrations();

/// Returns the version of the schema; 0: there is none. Throws StoreRefused where a newer version of the program wrote
/// the store and says that this one cannot use it.
int postgres_version(PostgresConnection& connection);

/// Applies what is missing, step by step. Tries again where others are in the way of a step; throws StoreError, which
/// leaves the steps before it, where they are for a minute. An index may take as long as it takes.
void migrate(PostgresConnection& connection, std::span<const Migration> migrations = postgres_migrations());
/// Throws StoreRefused where migrate() would change something.
void require_up_to_date(PostgresConnection& connection);

}  // namespace bahnwerk::server
