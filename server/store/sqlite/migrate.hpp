#pragma once
/// Migrations of the schema: numbered SQL files under server/store/migrations, each applied once, in order, in its own
/// transaction.
#include <span>
#include <string_view>

namespace bahnwerk::server {

class SqliteConnection;

struct Migration {
  int number;  ///< 1, 2, …; the database's `user_version` after it
  std::string_view name;
  const char* sql;
};
std::span<const Migration> migrations();

/// Brings the database up to date. Throws StoreError if a newer version wrote it.
void migrate(SqliteConnection& connection);

}  // namespace bahnwerk::server
