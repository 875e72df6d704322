#include "server/store/sqlite/migrate.hpp"

#include <string>

#include "server/store/sqlite/connection.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

void migrate(SqliteConnection& connection) {
  const int version = connection.query("PRAGMA user_version").one_int();
  const auto list = migrations();
  if (version > static_cast<int>(list.size()))
    throw StoreError("the database has schema version " + std::to_string(version) + ", this program knows only up to " +
                         std::to_string(list.size()) + ": it was written by a newer version",
                     false);
  for (const Migration& migration : list) {
    if (migration.number <= version) continue;
    connection.execute("BEGIN IMMEDIATE");
    connection.execute(migration.sql);
    connection.execute(("PRAGMA user_version = " + std::to_string(migration.number)).c_str());
    connection.execute("COMMIT");
  }
}

}  // namespace bahnwerk::server
