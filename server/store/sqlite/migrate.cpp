#include "server/store/sqlite/migrate.hpp"

#include <string>

#include "server/store/open.hpp"
#include "server/store/sqlite/commands.hpp"
#include "server/store/sqlite/connection.hpp"
#include "server/store/sqlite/file_lock.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {
namespace {

/// The least version of the program's schema that may use a store with the migrations of this program.
constexpr int min_reader = 11;
constexpr int first_with_min_reader = 11;  ///< the migration that makes the table for it

int known_version() { return static_cast<int>(migrations().size()); }

}  // namespace

int sqlite_version(SqliteConnection& connection) {
  const int version = connection.query("PRAGMA user_version").one_int();
  if (version <= known_version()) return version;
  int least = version;
  if (connection.query("SELECT count(*) FROM sqlite_master WHERE name = 'schema_version'").one_int() > 0) {
    Query row = connection.query("SELECT max(version), max(min_reader) FROM schema_version");
    if (row.step() && row.integer(0) == version) least = static_cast<int>(row.integer(1));
  }
  if (least > known_version())
    throw StoreError("the database has schema version " + std::to_string(version) + ", this program knows only up to " +
                         std::to_string(known_version()) + ": it was written by a newer version",
                     false);
  return version;
}

void migrate(SqliteConnection& connection) {
  const int version = sqlite_version(connection);
  for (const Migration& migration : migrations()) {
    if (migration.number <= version) continue;
    connection.execute("BEGIN IMMEDIATE");
    connection.execute(migration.sql);
    if (migration.number >= first_with_min_reader)
      (connection.query("INSERT INTO schema_version VALUES (?, ?)")
       << std::int64_t{migration.number} << std::int64_t{min_reader})
          .run();
    connection.execute(("PRAGMA user_version = " + std::to_string(migration.number)).c_str());
    connection.execute("COMMIT");
  }
}

void require_up_to_date(SqliteConnection& connection) {
  if (const int version = sqlite_version(connection); version < known_version())
    throw StoreError(not_migrated(version, known_version()), false);
}

namespace sqlite {

int bring_up_to_date(const std::string& url) {
  const std::string path = prepared_path(url);
  const FileLock process(path + ".lock"), file(path, FileLock::Holder::unnamed);
  SqliteConnection connection(path, true);
  migrate(connection);
  return sqlite_version(connection);
}

}  // namespace sqlite
}  // namespace bahnwerk::server
