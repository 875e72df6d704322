/// The keys in a store's file: read by the store, written by commands beside it.
#include <unistd.h>

#include <filesystem>
#include <string>

#include "server/runtime/clock.hpp"
#include "server/store/sqlite/commands.hpp"
#include "server/store/sqlite/file_lock.hpp"
#include "server/store/sqlite/migrate.hpp"
#include "server/store/sqlite/reader.hpp"

namespace bahnwerk::server {
namespace {

std::vector<Key> read_keys(SqliteConnection& connection) {
  std::vector<Key> keys;
  Query rows = connection.query(
      "SELECT id, name, scopes, hash, max_queued, max_planning_ms, created_at, removed_at FROM keys "
      "ORDER BY created_at, id");
  while (rows.step()) {
    Key key;
    key.id = rows.text(0);
    key.name = rows.text(1);
    const auto scopes = parse_scopes(rows.text(2));
    if (!scopes) throw StoreError("store: unknown scopes " + rows.text(2), false);
    key.scopes = *scopes;
    key.hash = rows.text(3);
    key.max_queued = rows.optional_integer(4);
    key.max_planning_ms = rows.optional_integer(5);
    key.created_at = rows.integer(6);
    key.removed_at = rows.optional_integer(7);
    keys.push_back(std::move(key));
  }
  return keys;
}

/// Brings a store that no process uses to this program's schema; one that is in use has to have it.
void bring_up_to_date(SqliteConnection& connection, const std::string& path) {
  if (sqlite_version(connection) >= static_cast<int>(migrations().size())) return;
  try {
    const FileLock lock(path + ".lock");
    migrate(connection);
  } catch (const StoreError& error) {
    throw StoreError(
        "the store is not of this version of the program, and cannot be changed: " + std::string(error.what()), false);
  }
}

/// Opens the store's file for a change, makes it if there is none, and runs `work` in a transaction.
template <class Work>
void change(const std::string& url, Work&& work) {
  const std::string path = prepared_path(url);
  if (!std::filesystem::exists(path)) const FileLock made(path, FileLock::Holder::unnamed);
  SqliteConnection connection(path, true);
  connection.patience(std::chrono::seconds(30));
  bring_up_to_date(connection, path);
  connection.execute("BEGIN IMMEDIATE");
  work(connection);
  connection.execute("COMMIT");
}

}  // namespace

std::optional<Keys> SqliteStore::keys(std::uint64_t known) {
  Reader reader(*this);
  const auto version = [&] {
    return static_cast<std::uint64_t>(reader.query("SELECT version FROM key_version").one_int());
  };
  Keys keys;
  keys.version = version();
  if (keys.version == known) return std::nullopt;
  keys.list = read_keys(reader.connection());  // maybe with later changes: then they are read once more
  return keys;
}

namespace sqlite {

void add_key(const std::string& url, const Key& key) {
  change(url, [&](SqliteConnection& connection) {
    (connection.query("INSERT INTO keys (id, name, scopes, hash, max_queued, max_planning_ms, created_at) "
                      "VALUES (?, ?, ?, ?, ?, ?, ?)")
     << key.id << key.name << to_string(key.scopes) << key.hash << key.max_queued << key.max_planning_ms
     << key.created_at)
        .run();
  });
}

std::vector<Key> remove_keys(const std::string& url, const std::string& name_or_id) {
  std::vector<Key> removed;
  change(url, [&](SqliteConnection& connection) {
    for (Key& key : read_keys(connection)) {
      if (key.removed_at || (key.name != name_or_id && key.id != name_or_id)) continue;
      key.removed_at = now_ms();
      (connection.query("UPDATE keys SET removed_at = ? WHERE id = ?") << key.removed_at << key.id).run();
      removed.push_back(std::move(key));
    }
  });
  return removed;
}

std::vector<Key> list_keys(const std::string& url) {
  check_store(url);
  const std::string path = url.substr(7);
  if (!std::filesystem::exists(path)) return {};
  SqliteConnection connection(path, false);
  constexpr int first_with_keys = 6;
  if (connection.query("PRAGMA user_version").one_int() < first_with_keys) return {};
  return read_keys(connection);
}

}  // namespace sqlite
}  // namespace bahnwerk::server
