#include "server/store/open.hpp"

#include <filesystem>

#include "server/store/postgres/commands.hpp"
#include "server/store/postgres/postgres_store.hpp"
#include "server/store/sqlite/commands.hpp"
#include "server/store/sqlite/sqlite_store.hpp"
#include "server/store/store_url.hpp"

namespace bahnwerk::server {

void check_store(const std::string& url) {
  if (names_postgres(url)) return;
  if (!url.starts_with("sqlite:") || url.size() == 7)
    throw StoreError("unsupported store '" + without_secrets(url) +
                         "'; expected sqlite:PATH, for example sqlite:var/bahnwerk.db, or "
                         "postgresql://USER@HOST/DATABASE",
                     false);
}

std::string prepared_path(const std::string& url) {
  check_store(url);
  std::string path = url.substr(7);
  std::error_code error;
  // One file has one name here, whatever links lead to it: lock and reserve are beside it.
  if (const auto real = std::filesystem::weakly_canonical(path, error); !error) path = real.string();
  const auto folder = std::filesystem::path(path).parent_path();
  error.clear();
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw StoreError("cannot make the store's directory " + folder.string() + ": " + error.message(), false);
  if (std::filesystem::is_directory(path, error))
    throw StoreError("the store " + path + " is a directory; expected a file", false);
  return path;
}

std::unique_ptr<Store> open_store(const std::string& url, std::function<void(double, std::size_t)> observer,
                                  std::size_t reserve, const Retention& retention, const SharedStoreOptions& shared) {
  check_store(url);
  if (!shared.listen_url.empty() && !(names_postgres(url) && names_postgres(shared.listen_url)))
    throw StoreError("--store-listen-url names a PostgreSQL server, postgresql://…, beside a store there", false);
  if (names_postgres(url)) {
    PostgresOptions options;
    options.url = url;
    options.retention = retention;
    options.connections = shared.connections;
    options.signals = shared.hears();
    options.session = shared.pooled ? PostgresSession::pooled : PostgresSession::own;
    options.listen_url = shared.listen_url;
    options.migrate = shared.migrate;
    options.planned_by = shared.planned_by;
    options.refused = shared.refused;
    options.lost = shared.lost;
    if (observer) options.observer = std::move(observer);
    return std::make_unique<PostgresStore>(std::move(options));
  }
  SqliteOptions options;
  options.path = prepared_path(url);
  options.observer = std::move(observer);
  options.reserve = reserve;
  options.retention = retention;
  options.migrate = shared.migrate;
  options.planned_by = shared.planned_by;
  std::error_code error;
  const auto folder = std::filesystem::path(options.path).parent_path();
  const auto disk = std::filesystem::space(folder.empty() ? "." : folder, error);
  if (!error && disk.capacity > 0 && reserve >= disk.capacity)
    throw StoreError("the reserve of " + std::to_string(reserve) +
                         " bytes does not fit on the store's disk, which has " + std::to_string(disk.capacity) +
                         "; choose a smaller --store-reserve",
                     false);
  return std::make_unique<SqliteStore>(std::move(options));
}

BackUp back_up(const std::string& url, const std::string& file) {
  if (names_postgres(url))
    throw StoreError(
        "a PostgreSQL store is backed up by PostgreSQL's own tools: pg_basebackup with an archive, or pg_dump", false);
  return sqlite::back_up(url, file);
}

int migrate_store(const std::string& url) {
  check_store(url);
  return names_postgres(url) ? postgres::bring_up_to_date(url) : sqlite::bring_up_to_date(url);
}

std::vector<std::string> inspect(const std::string& url) {
  return names_postgres(url) ? postgres::inspect(url) : sqlite::inspect(url);
}

void add_key(const std::string& url, const Key& key) {
  names_postgres(url) ? postgres::add_key(url, key) : sqlite::add_key(url, key);
}

std::vector<Key> remove_keys(const std::string& url, const std::string& name_or_id) {
  return names_postgres(url) ? postgres::remove_keys(url, name_or_id) : sqlite::remove_keys(url, name_or_id);
}

std::vector<Key> list_keys(const std::string& url, bool pooled) {
  return names_postgres(url) ? postgres::list_keys(url, pooled) : sqlite::list_keys(url);
}

}  // namespace bahnwerk::server
