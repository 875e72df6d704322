#pragma once
/// Migrations of the schema: numbered SQL files under server/store/sqlite/migrations, each applied once, in order, in
/// its own transaction.
#include <span>

#include "server/store/migration.hpp"

namespace bahnwerk::server {

class SqliteConnection;

std::span<const Migration> migrations();  ///< the number of the last one is the database's `user_version`

/// Brings the database up to date. Throws StoreError if a newer version wrote it.
void migrate(SqliteConnection& connection);

}  // namespace bahnwerk::server
