#include "server/store/open.hpp"

#include <filesystem>

#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {

void check_store(const std::string& url) {
  if (url.starts_with("postgresql:") || url.starts_with("postgres:"))
    throw StoreError("PostgreSQL is not available in this version; use sqlite:PATH", false);
  if (!url.starts_with("sqlite:") || url.size() == 7)
    throw StoreError("unsupported store '" + url + "'; expected sqlite:PATH, for example sqlite:var/bahnwerk.db",
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
                                  std::size_t reserve, const Retention& retention) {
  SqliteOptions options;
  options.path = prepared_path(url);
  options.observer = std::move(observer);
  options.reserve = reserve;
  options.retention = retention;
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

}  // namespace bahnwerk::server
