#pragma once
/// Migrations of the schema: numbered SQL files under server/store/sqlite/migrations, each applied once, in order, in
/// its own transaction.
#include <span>

#include "server/store/migration.hpp"

namespace bahnwerk::server {

class SqliteConnection;

std::span<const Migration> migrations();  ///< the number of the last one is the database's `user_version`

/// Returns the version of the schema; 0: there is none. Throws StoreError where a newer version of the program wrote
/// the database and says that this one cannot use it.
int sqlite_version(SqliteConnection& connection);

/// Brings the database up to date; one that is newer stays as it is. Throws as sqlite_version() does.
void migrate(SqliteConnection& connection);
/// Throws StoreError where migrate() would change something.
void require_up_to_date(SqliteConnection& connection);

}  // namespace bahnwerk::server
